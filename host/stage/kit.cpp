#include "host/stage/kit.hpp"

#include <algorithm>

#include "lib/camera.h"

namespace macula::stage {

std::uint32_t Kit::slots() const {
    const std::uint32_t of_pixels = shared::slot_count(width, height);
    return primary() ? of_pixels : kRaysOfHit * of_pixels;
}

std::uint32_t Kit::launched() const {
    if (!used_slots)
        return slots();
    const std::uint32_t doublings = std::min(level + (of_layers ? 1 : 0), 2u);
    return static_cast<std::uint32_t>(
        std::min(std::uint64_t{*used_slots} << doublings, std::uint64_t{slots()}));
}

Kit Kit::at_level(std::uint32_t of_rays) const {
    Kit kit = *this;
    kit.level = of_rays;
    return kit;
}

Kit Kit::at_layers() const {
    return {device,
            library,
            blended->geometry,
            blended->surfaces,
            tracer,
            width,
            height,
            lights,
            ambient_occlusion_samples,
            highlights,
            ray_totals,
            lanes,
            target_width,
            target_height,
            depth,
            level,
            layers,
            blended,
            true,
            used_slots};
}

std::string Kit::named(const std::string& what) const {
    const std::string of_what = of_layers ? "layer " + what : what;
    return level == 0 ? of_what : "bounce " + std::to_string(level) + " " + of_what;
}

std::string Kit::rays() const {
    return primary() ? "primary rays" : named("rays");
}

compute::Kernel Kit::lane_kernel(const char* program, const char* entry) const {
    return library.kernel(kernel::VariantKey(program).parameter("lanes", lanes), entry, device);
}

compute::Range Kit::lane_group() const {
    return {kGroup / lanes};
}

compute::Range Kit::strips(std::uint32_t of_width, std::uint32_t of_height) const {
    const std::uint64_t across = (of_width + lanes - 1) / lanes;
    return {compute::Range::cover(across * of_height, kStripGroup)};
}

std::uint32_t lanes_for(const compute::Device& device) {
    return device.facts().type == compute::DeviceType::cpu ? 16 : 1;
}

frame::Resource per_slot(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.slots()};
}

frame::Resource of_level(const Kit& kit, const std::string& what, std::uint32_t element_bytes) {
    return {kit.named(what), element_bytes, kit.slots(), kit.primary() ? "" : "bounce " + what};
}

frame::Resource of_list(const Kit& kit, const std::string& what, std::uint32_t element_bytes,
                        std::uint32_t per) {
    const char* turn = kit.of_layers        ? "layer list "
                       : kit.level % 2 == 0 ? "even bounce "
                                            : "odd bounce ";
    return {kit.named(what), element_bytes, kit.slots() / per, turn + what};
}

frame::Resource per_pixel(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.pixels()};
}

} // namespace macula::stage
