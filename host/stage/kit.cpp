#include "host/stage/kit.hpp"

#include "lib/camera.h"

namespace macula::stage {

std::uint32_t Kit::slots() const {
    return shared::slot_count(width, height);
}

compute::Kernel Kit::lane_kernel(const char* program, const char* entry) const {
    return library.kernel(kernel::VariantKey(program).parameter("lanes", lanes), entry, device);
}

compute::Range Kit::lane_group() const {
    return {kGroup / lanes};
}

std::uint32_t lanes_for(const compute::Device& device) {
    return device.facts().type == compute::DeviceType::cpu ? 16 : 1;
}

frame::Resource per_slot(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.slots()};
}

frame::Resource per_pixel(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.pixels()};
}

} // namespace macula::stage
