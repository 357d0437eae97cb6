// What is decided from the manifest of variants.cpp.
#include <algorithm>
#include <bit>
#include <stdexcept>

#include "host/cl/device.hpp"
#include "host/kernel/variants.hpp"

namespace macula::kernel {
namespace {

constexpr std::array kNames = {"primary", "shadow", "ao", "diffuse", "random", "sparse"};
static_assert(kNames.size() == kRayClasses.size());

const Parameter* find_parameter(const Variant& variant, std::string_view parameter_name) {
    const auto found =
        std::ranges::find(variant.parameters, parameter_name,
                          [](const Parameter& p) { return std::string_view(p.name); });
    return found == variant.parameters.end() ? nullptr : &*found;
}

const Parameter& existing_parameter(const Variant& variant, std::string_view parameter_name) {
    if (const Parameter* found = find_parameter(variant, parameter_name))
        return *found;
    std::string known;
    for (const Parameter& parameter : variant.parameters)
        known += std::string(known.empty() ? "" : ", ") + parameter.name;
    throw std::invalid_argument(std::string("variant ") + variant.name + " has no parameter \"" +
                                std::string(parameter_name) + "\"; it has: " + known);
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size() + 1, width), ' ');
    return text;
}

// " (chunk 16, work_group 1)", empty for standard values.
std::string described(const ParameterValues& values) {
    std::string text;
    for (const auto& [key, value] : values)
        text += (text.empty() ? " (" : ", ") + key + " " + std::to_string(value);
    return text.empty() ? text : text + ")";
}

} // namespace

const char* name(RayClass ray_class) {
    return kNames[static_cast<std::size_t>(ray_class)];
}

std::optional<RayClass> parse_ray_class(std::string_view text) {
    const auto found = std::ranges::find(kNames, text);
    if (found == kNames.end())
        return std::nullopt;
    return static_cast<RayClass>(found - kNames.begin());
}

DeviceTraits traits_of(const compute::Device& device) {
    const compute::DeviceFacts& facts = device.facts();
    return {.gpu = facts.type == compute::DeviceType::gpu,
            .compute_units = std::max(facts.compute_units, 1u),
            .max_work_group = static_cast<std::uint32_t>(
                std::clamp<std::size_t>(facts.max_work_group_size, 1, 0xffffffffu))};
}

const Variant& reference_variant() {
    return variants().back();
}

const Variant& find_variant(std::string_view variant_name) {
    std::string known;
    for (const Variant& variant : variants()) {
        if (variant.name == variant_name)
            return variant;
        known += std::string(known.empty() ? "" : ", ") + variant.name;
    }
    throw std::invalid_argument("there is no traversal variant \"" + std::string(variant_name) +
                                "\"; known are: " + known);
}

std::string why_not(const Variant& variant, const DeviceTraits& device, RayClass ray_class) {
    if (contains(variant.unsafe, ray_class))
        return std::string("may take unboundedly long on ") + name(ray_class) + " rays";
    if (device.gpu && variant.private_bytes > kMostPrivateBytesOnGpu)
        return "needs " + std::to_string(variant.private_bytes) +
               " bytes of private memory a work-item, and more than " +
               std::to_string(kMostPrivateBytesOnGpu) + " starve a GPU";
    return "";
}

const Variant& default_variant(const DeviceTraits& device, RayClass ray_class) {
    const Variant* fallback = nullptr;
    for (const Variant& variant : variants()) {
        if (!why_not(variant, device, ray_class).empty())
            continue;
        if (contains(device.gpu ? variant.preferred_on_gpu : variant.preferred_on_cpu, ray_class))
            return variant;
        if (fallback == nullptr)
            fallback = &variant;
    }
    return fallback != nullptr ? *fallback : reference_variant();
}

std::uint32_t parameter(const Variant& variant, const ParameterValues& values,
                        std::string_view parameter_name) {
    const Parameter& found = existing_parameter(variant, parameter_name);
    const auto given = values.find(found.name);
    return given == values.end() ? found.standard : given->second;
}

void check_parameters(const Variant& variant, const ParameterValues& values) {
    for (const auto& [key, value] : values) {
        const Parameter& known = existing_parameter(variant, key);
        if (value < known.minimum || value > known.maximum)
            throw std::invalid_argument(std::string("variant ") + variant.name + ": " + key +
                                        " is " + std::to_string(value) + ", but must be in " +
                                        std::to_string(known.minimum) + " .. " +
                                        std::to_string(known.maximum));
        if (known.power_of_two && !std::has_single_bit(value))
            throw std::invalid_argument(std::string("variant ") + variant.name + ": " + key +
                                        " is " + std::to_string(value) +
                                        ", but must be a power of two");
    }
}

std::string list_variants(const DeviceTraits& device, std::span<const Choice> chosen) {
    if (chosen.size() != kRayClasses.size())
        throw std::invalid_argument("listing the variants: a choice for each class is needed");
    std::string text;
    for (const Variant& variant : variants()) {
        text += padded(variant.name, 25) + padded(bvh::name(variant.layout), 14) + variant.paper +
                (&variant == &reference_variant() ? "; the reference" : "") + "\n";
        std::string reasons;
        for (const RayClass ray_class : kRayClasses) {
            const Choice& choice = chosen[static_cast<std::size_t>(ray_class)];
            const std::string reason = why_not(variant, device, ray_class);
            if (choice.variant == &variant)
                text += std::string("    chosen for ") + name(ray_class) + " rays" +
                        described(choice.parameters) + "\n";
            if (!reason.empty())
                reasons +=
                    std::string("    not for ") + name(ray_class) + " rays: " + reason + "\n";
        }
        text += reasons;
    }
    return text;
}

} // namespace macula::kernel
