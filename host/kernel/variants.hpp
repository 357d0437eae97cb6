// The registry of traversal variants: an ordered list, the reference last. A variant is one file
// kernels/traverse/<name>.cl and one entry here (docs/variants.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bvh/bvh.hpp"

namespace macula::compute {
class Device;
}

namespace macula::kernel {

// What the caller knows of a queue's rays, and all that the choice of a variant may depend on.
enum class RayClass : std::uint8_t {
    primary,           // a full grid of camera rays, in 4 x 4 packets inside 32 x 32 tiles
    shadow,            // towards one point, ordered as the primary hits
    ambient_occlusion, // short, cosine-distributed, any hit
    diffuse,           // cosine-distributed, closest hit
    random,            // no order at all
    sparse,            // a foveated list of camera rays: coherent, with gaps
};
inline constexpr std::array kRayClasses = {
    RayClass::primary, RayClass::shadow, RayClass::ambient_occlusion,
    RayClass::diffuse, RayClass::random, RayClass::sparse};
// "primary", "shadow", "ao", "diffuse", "random", "sparse".
const char* name(RayClass ray_class);
std::optional<RayClass> parse_ray_class(std::string_view text);

// A set of ray classes: bits 1 << RayClass.
using RayClassSet = std::uint8_t;
constexpr RayClassSet set_of(RayClass ray_class) {
    return static_cast<RayClassSet>(1u << static_cast<unsigned>(ray_class));
}
constexpr bool contains(RayClassSet set, RayClass ray_class) {
    return (set & set_of(ray_class)) != 0;
}

// What the registry needs to know of a device; a plain struct, so that a test can make one up.
struct DeviceTraits {
    bool gpu = false;
    std::uint32_t compute_units = 1;
    std::uint32_t max_work_group = 1; // work-items
};
DeviceTraits traits_of(const compute::Device& device);

enum class ParameterUse : std::uint8_t {
    launch,  // only the launch depends on it
    literal, // the kernel is compiled with it, as MACULA_<NAME>
};

// A tunable number of a variant. Three names mean the same everywhere: `work_group`, the
// work-items of a group; `rays_per_item`, which replaces Variant::rays_per_item; and
// `groups_per_unit`, the resident work-groups on each compute unit of a persistent launch.
struct Parameter {
    const char* name; // lower case with underscores
    std::uint32_t minimum, maximum, standard;
    bool power_of_two;
    ParameterUse use;
    const char* meaning; // with the unit
};

// Values by parameter name; a parameter without a value takes its standard one.
using ParameterValues = std::map<std::string, std::uint32_t>;

// How the launch covers a queue.
enum class Launch : std::uint8_t {
    one_pass,   // ceil(capacity / rays_per_item) work-items
    persistent, // compute units * groups_per_unit work-groups that fetch work until none is left
};

struct Variant {
    const char* name;  // of kernels/traverse/<name>.cl
    const char* paper; // author, year, section
    bvh::Layout layout;
    std::uint32_t rays_per_item; // of a one_pass launch, standard value
    Launch launch;
    std::span<const Parameter> parameters;
    // `unsafe`: the variant may take unboundedly longer than the others on these rays and does not
    // apply to them. `preferred`: the default for these rays on that type of device.
    RayClassSet unsafe, preferred_on_cpu, preferred_on_gpu;
    // Bytes of private memory that a work-item's stacks and queues take. GPUs have few.
    std::uint32_t private_bytes;
};

// Private memory beyond which a variant does not apply to a GPU, in bytes a work-item.
inline constexpr std::uint32_t kMostPrivateBytesOnGpu = 4096;

// All variants, in order of the list; the last one is the reference.
std::span<const Variant> variants();
const Variant& reference_variant();
// Throws std::invalid_argument that lists the known names.
const Variant& find_variant(std::string_view name);

// Empty when the variant can run rays of this class on this device; otherwise the reason, a
// sentence without a full stop.
std::string why_not(const Variant& variant, const DeviceTraits& device, RayClass ray_class);

// The default: the first variant of the list that is preferred for the class on the device's type
// and applies; else the first that applies.
const Variant& default_variant(const DeviceTraits& device, RayClass ray_class);

// The value of a parameter: given, else standard. Throws std::invalid_argument when the variant
// has no such parameter.
std::uint32_t parameter(const Variant& variant, const ParameterValues& values,
                        std::string_view parameter_name);
// Throws std::invalid_argument when a value is unknown, out of range or no power of two as needed.
void check_parameters(const Variant& variant, const ParameterValues& values);

// A variant with all that decides its program and launch.
struct Choice {
    const Variant* variant = nullptr;
    ParameterValues parameters;
};

// The table of `macula variants`: for each variant its layout and paper, the ray classes it is
// `chosen` for (one choice for each class, in the order of kRayClasses) with its tuned parameters,
// and why it does not apply to a class where it does not.
std::string list_variants(const DeviceTraits& device, std::span<const Choice> chosen);

} // namespace macula::kernel
