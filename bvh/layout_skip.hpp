// The stackless layout (Thrane and Simonsen 2005): depth-first order and skip pointers.
#pragma once

#include "bvh/bvh.hpp"
#include "bvh/collapse.hpp"

namespace macula::bvh {

LaidOut lay_out_skip(const Tree& tree, const Geometry& geometry, const CollapseOptions& options);

} // namespace macula::bvh
