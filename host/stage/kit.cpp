#include "host/stage/kit.hpp"

#include "lib/camera.h"

namespace macula::stage {

std::uint32_t Kit::slots() const {
    return shared::slot_count(width, height);
}

frame::Resource per_slot(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.slots()};
}

frame::Resource per_pixel(const Kit& kit, const std::string& name, std::uint32_t element_bytes) {
    return {name, element_bytes, kit.pixels()};
}

} // namespace macula::stage
