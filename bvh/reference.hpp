// The CPU reference: brute force and a plain traversal, in the very arithmetic of the kernels
// (kernels/lib compiled as C++). Slow and simple on purpose: it is what the variants are held to.
#pragma once

#include <span>

#include "bvh/bvh.hpp"
#include "lib/instance.h"
#include "lib/mask.h"
#include "lib/triangle.h"
#include "shared/ray.h"

namespace macula::bvh {

// A scene as the kernels see it: meshes laid out as Layout::binary and concatenated.
struct ReferenceScene {
    std::span<const shared::BinaryNode> nodes;
    std::span<const shared::Triangle> triangles;
    std::span<const shared::Instance> instances;
    std::span<const shared::BinaryNode> upper_nodes;
    shared::MaskTables masks{};
};

struct Ray {
    float origin[3], direction[3];
    float t_min = 0.0f, t_max = 0.0f;
};

// Tests every triangle of every instance. `geometry[m]` is mesh m in object space; its `masked`
// says which triangles look into `masks`.
shared::TraceHit closest_by_brute_force(const Ray& ray, std::span<const Geometry> geometry,
                                        std::span<const shared::Instance> instances,
                                        const shared::MaskTables& masks);
shared::TraceHit closest(const Ray& ray, const ReferenceScene& scene);
bool occluded(const Ray& ray, const ReferenceScene& scene);

} // namespace macula::bvh
