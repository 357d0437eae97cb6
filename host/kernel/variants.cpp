// The manifest: one entry for each file of kernels/traverse (docs/variants.md). What is decided
// from it stands in variant_choice.cpp.
#include "host/kernel/variants.hpp"

namespace macula::kernel {
namespace {

constexpr RayClassSet kNone = 0;
constexpr RayClassSet kAll = (1u << kRayClasses.size()) - 1u;

constexpr Parameter work_group(std::uint32_t standard) {
    return {"work_group", 1, 1024, standard, true, ParameterUse::launch, "work-items of a group"};
}

constexpr std::array kOneRay = {work_group(64)};
constexpr std::array kOnePacket = {work_group(1)};
// PoCL hands out work-groups by the hundred while there are more than a thousand, and then some
// cores have nothing left to do: fewer, larger groups.
constexpr std::array kPacketStream = {
    work_group(4),
    Parameter{"rays_per_item", 32, 512, 512, true, ParameterUse::literal,
              "rays that a work-item takes through the tree together"},
};
constexpr std::uint32_t kChunksInTurn = 8;
constexpr std::array kStream = {
    work_group(1),
    Parameter{"rays_per_item", 64, 8192, 2048, true, ParameterUse::literal,
              "rays that a work-item sorts"},
    Parameter{"chunk", 4, 32, 32, true, ParameterUse::literal, "rays that share a traversal"},
    Parameter{"chunks_in_turn", 1, 16, kChunksInTurn, false, ParameterUse::literal,
              "chunks that a work-item advances in turn"},
};
constexpr std::array kPersistent = {
    work_group(32),
    Parameter{"groups_per_unit", 1, 256, 32, false, ParameterUse::launch,
              "resident work-groups on each compute unit"},
    Parameter{"rays_per_fetch", 1, 64, 2, false, ParameterUse::literal,
              "rays a work-item that a group takes from the counter at once"},
};

// Stacks, from the kernels: four bytes an entry, and four more where a distance is kept.
constexpr std::uint32_t kBinaryStack = 2 * (MACULA_MAX_DEPTH + 1) * 4; // and the upper level's
constexpr std::uint32_t kWide8Stack = (7 * MACULA_MAX_DEPTH + 8) * 8 + kBinaryStack / 2;
constexpr std::uint32_t kQuantizedStack = MACULA_MAX_DEPTH * 5 + kBinaryStack / 2;

// A packet's rays, frustum and results, in bytes: about 22 vectors of 64.
constexpr std::uint32_t kPacket = 22 * 64;
// A ray of a stream: its row and class among those that are sorted, and its best hit in its chunk,
// whose stack has three words an entry.
constexpr std::uint32_t kSortedRay = 65;
constexpr std::uint32_t kStreamChunk = 32 * 20 + (7 * MACULA_MAX_DEPTH + 16) * 12;

constexpr RayClassSet bit(RayClass ray_class) {
    return 1u << static_cast<unsigned>(ray_class);
}

// In order of preference; the reference is the last.
constexpr Variant kVariants[] = {
    {
        .name = "packet_stream",
        .paper = "Wald, Boulos and Shirley 2007, section 4; Tsakok 2009",
        .layout = bvh::Layout::wide8_single,
        .rays_per_item = 512,
        .launch = Launch::one_pass,
        .parameters = kPacketStream,
        .unsafe = kNone,
        .preferred_on_cpu = bit(RayClass::primary) | bit(RayClass::shadow) | bit(RayClass::sparse),
        .preferred_on_gpu = kNone,
        .private_bytes = 32 * kPacket + kWide8Stack,
    },
    {
        .name = "packet16",
        .paper = "Wald, Boulos and Shirley 2007, section 4",
        .layout = bvh::Layout::wide8_single,
        .rays_per_item = 16,
        .launch = Launch::one_pass,
        .parameters = kOnePacket,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kNone,
        .private_bytes = kPacket + kWide8Stack,
    },
    {
        .name = "stream",
        .paper = "Tsakok 2009, section 3",
        .layout = bvh::Layout::wide8_block,
        .rays_per_item = 2048,
        .launch = Launch::one_pass,
        .parameters = kStream,
        .unsafe = kNone,
        .preferred_on_cpu =
            bit(RayClass::ambient_occlusion) | bit(RayClass::diffuse) | bit(RayClass::random),
        .preferred_on_gpu = kNone,
        .private_bytes = 2048 * kSortedRay + kChunksInTurn * kStreamChunk,
    },
    {
        .name = "wide8_quantized",
        .paper = "Ylitie, Karras and Laine 2017, sections 3 and 4",
        .layout = bvh::Layout::quantized8,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kAll,
        .private_bytes = kQuantizedStack,
    },
    {
        .name = "wide8",
        .paper = "Wald, Benthin and Boulos 2008, section 3",
        .layout = bvh::Layout::wide8_block,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kAll,
        .preferred_on_gpu = kNone,
        .private_bytes = kWide8Stack,
    },
    {
        .name = "persistent",
        .paper = "Aila and Laine 2009, section 5; Aila, Laine and Karras 2012",
        .layout = bvh::Layout::binary,
        .rays_per_item = 1,
        .launch = Launch::persistent,
        .parameters = kPersistent,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kAll,
        .private_bytes = kBinaryStack,
    },
    {
        .name = "speculative_while_while",
        .paper = "Aila and Laine 2009, section 4",
        .layout = bvh::Layout::binary,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kNone,
        .private_bytes = kBinaryStack,
    },
    {
        .name = "if_if",
        .paper = "Aila and Laine 2009, section 4",
        .layout = bvh::Layout::binary,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kNone,
        .private_bytes = kBinaryStack,
    },
    {
        .name = "escape_index",
        .paper = "Thrane and Simonsen 2005, section 4; Smith et al. 2014",
        .layout = bvh::Layout::skip,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kNone,
        .private_bytes = kBinaryStack / 2,
    },
    {
        .name = "while_while",
        .paper = "Aila and Laine 2009, section 4",
        .layout = bvh::Layout::binary,
        .rays_per_item = 1,
        .launch = Launch::one_pass,
        .parameters = kOneRay,
        .unsafe = kNone,
        .preferred_on_cpu = kNone,
        .preferred_on_gpu = kNone,
        .private_bytes = kBinaryStack,
    },
};

} // namespace

std::span<const Variant> variants() {
    return kVariants;
}

} // namespace macula::kernel
