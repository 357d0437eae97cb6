// The build over any set of boxes: triangles, or instances for the upper level.
#pragma once

#include "bvh/bvh.hpp"
#include "bvh/geometry.hpp"

namespace macula::bvh {

// With `geometry`, spatial splits may divide references into the spare room behind them, up to
// `capacity` in all.
Tree build_tree(ReferenceSet references, std::uint32_t capacity, const Geometry* geometry,
                const BuildOptions& options);

} // namespace macula::bvh
