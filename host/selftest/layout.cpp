#include "host/selftest/selftest.hpp"

#include "selftest/struct_list.h"

#include <cstddef>

#include <fmt/format.h>

namespace macula::selftest {
namespace {

struct Entry {
    const char* name;
    std::uint32_t value; // size or offset on the host
};

#define MACULA_SIZE_ENTRY(type) {"sizeof " #type, sizeof(shared::type)},
#define MACULA_OFFSET_ENTRY(type, member) {#type "." #member, offsetof(shared::type, member)},

constexpr Entry kEntries[] = {MACULA_STRUCT_LIST(MACULA_SIZE_ENTRY, MACULA_OFFSET_ENTRY)};

} // namespace

Outcome check_layout(const compute::Device& device, kernel::Library& library) {
    constexpr std::size_t count = std::size(kEntries);
    compute::Buffer out = device.allocate_array<std::uint32_t>(count, "layout probe");
    library.kernel(kernel::VariantKey("selftest/layout"), "layout", device)
        .set(out)
        .launch("layout probe", {1});
    const auto found = out.map_read<std::uint32_t>();
    for (std::size_t i = 0; i < count; ++i) {
        if (found[i] != kEntries[i].value) {
            return {"struct layout", false,
                    fmt::format("{} is {} on the device, {} on the host", kEntries[i].name,
                                found[i], kEntries[i].value)};
        }
    }
    return {"struct layout", true, fmt::format("{} sizes and offsets", count)};
}

} // namespace macula::selftest
