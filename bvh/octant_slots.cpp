#include "bvh/octant_slots.hpp"

#include <limits>

namespace macula::bvh {

std::array<std::uint8_t, 8> octant_slots(const Box& node, std::span<const Child> children) {
    // gain[i][s]: how far child i lies from the centre towards the corner of slot s.
    std::array<std::array<float, 8>, 8> gain{};
    for (std::size_t i = 0; i < children.size(); ++i) {
        float offset[3];
        for (int axis = 0; axis < 3; ++axis)
            offset[axis] = (children[i].box.lo[axis] - node.lo[axis]) +
                           (children[i].box.hi[axis] - node.hi[axis]);
        for (std::size_t slot = 0; slot < 8; ++slot)
            gain[i][slot] = ((slot & 1) != 0 ? offset[0] : -offset[0]) +
                            ((slot & 2) != 0 ? offset[1] : -offset[1]) +
                            ((slot & 4) != 0 ? offset[2] : -offset[2]);
    }
    std::array<std::uint8_t, 8> slots{};
    unsigned placed = 0, taken = 0;
    for (std::size_t round = 0; round < children.size(); ++round) {
        std::size_t child = 0, slot = 0;
        float most = -std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < children.size(); ++i) {
            for (std::size_t s = 0; s < 8 && (placed >> i & 1) == 0; ++s) {
                if ((taken >> s & 1) == 0 && gain[i][s] > most) {
                    most = gain[i][s];
                    child = i;
                    slot = s;
                }
            }
        }
        slots[child] = static_cast<std::uint8_t>(slot);
        placed |= 1u << child;
        taken |= 1u << slot;
    }
    return slots;
}

} // namespace macula::bvh
