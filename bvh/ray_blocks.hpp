// Rays as they lie in a queue of the device.
#pragma once

#include <cstdint>
#include <vector>

#include "bvh/reference.hpp"
#include "shared/ray.h"

namespace macula::bvh {

// `capacity` rays in blocks; those beyond `rays` and the last block's rest are inactive
// (t_min > t_max). capacity: at least the number of rays.
inline std::vector<shared::RayBlock> blocks_of(const std::vector<Ray>& rays, std::size_t capacity) {
    std::vector<shared::RayBlock> blocks((capacity + MACULA_RAY_BLOCK - 1) / MACULA_RAY_BLOCK);
    for (std::size_t i = 0; i < blocks.size() * MACULA_RAY_BLOCK; ++i) {
        shared::RayBlock& block = blocks[i / MACULA_RAY_BLOCK];
        const std::size_t lane = i % MACULA_RAY_BLOCK;
        const Ray ray = i < rays.size() ? rays[i] : Ray{{}, {0, 0, 1}, 1.0f, 0.0f};
        block.origin_x[lane] = ray.origin[0];
        block.origin_y[lane] = ray.origin[1];
        block.origin_z[lane] = ray.origin[2];
        block.direction_x[lane] = ray.direction[0];
        block.direction_y[lane] = ray.direction[1];
        block.direction_z[lane] = ray.direction[2];
        block.t_min[lane] = ray.t_min;
        block.t_max[lane] = ray.t_max;
    }
    return blocks;
}

} // namespace macula::bvh
