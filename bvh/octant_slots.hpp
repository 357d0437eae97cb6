// Which of eight slots a child of a quantised node takes.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/layout_formats.hpp"

namespace macula::bvh {

// Bit a of a slot says on which side of the node's centre, along axis a, its child should lie: a
// ray of octant o that visits slots in the order of s ^ o then goes roughly front to back (Ylitie,
// Karras and Laine 2017, section 3.3; theirs is an optimal assignment by auction, ours a greedy
// one). At most eight children; the slots are different.
std::array<std::uint8_t, 8> octant_slots(const Box& node, std::span<const Child> children);

} // namespace macula::bvh
