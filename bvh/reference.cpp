#include "bvh/reference.hpp"

#include <array>

namespace macula::bvh {
namespace {

using shared::TraceHit, shared::TraceRay;

TraceRay world_ray(const Ray& ray) {
    return shared::make_trace_ray(ray.origin[0], ray.origin[1], ray.origin[2], ray.direction[0],
                                  ray.direction[1], ray.direction[2], ray.t_min, ray.t_max);
}

// One instance as a ray meets it.
struct Visit {
    const shared::Instance& instance;
    const shared::MaskTables& masks;
    TraceRay ray; // in object space
    shared::InstanceSpan span{};

    Visit(const Ray& world, const shared::Instance& placed, const shared::MaskTables& tables)
        : instance(placed), masks(tables),
          ray(shared::transform_ray(&placed, world.origin[0], world.origin[1], world.origin[2],
                                    world.direction[0], world.direction[1], world.direction[2],
                                    world.t_min, world.t_max)) {}

    // True when the triangle is hit closer than `best`, which it then becomes.
    bool test(const float* v0, const float* v1, const float* v2, std::uint32_t stored_id,
              TraceHit& best) const {
        TraceHit hit;
        if (!shared::intersect_triangle(&ray, v0[0], v0[1], v0[2], v1[0], v1[1], v1[2], v2[0],
                                        v2[1], v2[2], &hit.t, &hit.u, &hit.v) ||
            !shared::clamp_to_span(&span, &hit.t))
            return false;
        const std::uint32_t id = stored_id & MACULA_ID_MASK;
        hit.triangle = instance.first_triangle + id;
        if (!shared::is_closer(hit.t, hit.triangle, &best))
            return false;
        if ((stored_id & MACULA_MASKED_BIT) != 0 &&
            !shared::mask_is_solid(&masks, instance.mesh_triangle + id, hit.u, hit.v))
            return false;
        best = hit;
        return true;
    }
};

using Stack = std::array<int, MACULA_MAX_DEPTH + 2>;

// Visits the leaves that the ray enters no later than at best_t, nearer child first; stops when
// `leaf` (first, count) returns true.
template <typename Leaf>
bool traverse(std::span<const shared::BinaryNode> nodes, int root, const TraceRay& ray,
              const float& best_t, const Leaf& leaf) {
    Stack stack;
    std::size_t depth = 0;
    stack[depth++] = root;
    while (depth > 0) {
        const int reference = stack[--depth];
        if (reference < 0) {
            const auto bits = static_cast<std::uint32_t>(~reference);
            if (leaf(bits >> MACULA_LEAF_COUNT_BITS, bits & MACULA_LEAF_MAX))
                return true;
            continue;
        }
        const shared::BinaryNode& node = nodes[static_cast<std::size_t>(reference)];
        float near[2], far;
        bool enter[2];
        for (int i = 0; i < 2; ++i) {
            const auto& box = node.box[i];
            shared::box_interval(&ray, box[0][0], box[1][0], box[2][0], box[0][1], box[1][1],
                                 box[2][1], &near[i], &far);
            enter[i] = near[i] <= far && near[i] <= best_t;
        }
        const int first = near[1] < near[0] ? 1 : 0;
        if (enter[1 - first])
            stack[depth++] = node.child[1 - first];
        if (enter[first])
            stack[depth++] = node.child[first];
    }
    return false;
}

// True when the query is answered: at the first hit if `any`.
TraceHit result_of(TraceHit hit) {
    hit.t = shared::unsigned_zero(hit.t);
    hit.u = shared::unsigned_zero(hit.u);
    hit.v = shared::unsigned_zero(hit.v);
    return hit;
}

bool trace(const Ray& ray, const ReferenceScene& scene, bool any, TraceHit& best) {
    if (!shared::ray_is_active(ray.t_min, ray.t_max))
        return false;
    const TraceRay world = world_ray(ray);
    return traverse(scene.upper_nodes, 0, world, best.t, [&](std::uint32_t first, std::uint32_t n) {
        if (n == 0)
            return false;
        Visit visit(ray, scene.instances[first], scene.masks);
        if (!shared::enter_instance(&world, &visit.instance, &visit.span))
            return false;
        const auto test_leaf = [&](std::uint32_t begin, std::uint32_t count) {
            for (std::uint32_t i = begin; i < begin + count; ++i) {
                const shared::Triangle& t = scene.triangles[i];
                if (visit.test(t.v0, t.v1, t.v2, t.id, best) && any)
                    return true;
            }
            return false;
        };
        return traverse(scene.nodes, visit.instance.root, visit.ray, best.t, test_leaf);
    });
}

} // namespace

TraceHit closest_by_brute_force(const Ray& ray, std::span<const Geometry> geometry,
                                std::span<const shared::Instance> instances,
                                const shared::MaskTables& masks) {
    TraceHit best = shared::no_hit(ray.t_max);
    if (!shared::ray_is_active(ray.t_min, ray.t_max))
        return result_of(best);
    const TraceRay world = world_ray(ray);
    for (const shared::Instance& instance : instances) {
        Visit visit(ray, instance, masks);
        if (!shared::enter_instance(&world, &instance, &visit.span))
            continue;
        const Geometry& mesh = geometry[instance.mesh];
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            const auto corner = [&](int c) {
                return mesh.positions.data() + std::size_t{3} * mesh.triangles[i][c];
            };
            const bool masked = !mesh.masked.empty() && mesh.masked[i] != 0;
            visit.test(corner(0), corner(1), corner(2), masked ? i | MACULA_MASKED_BIT : i, best);
        }
    }
    return result_of(best);
}

TraceHit closest(const Ray& ray, const ReferenceScene& scene) {
    TraceHit best = shared::no_hit(ray.t_max);
    trace(ray, scene, false, best);
    return result_of(best);
}

bool occluded(const Ray& ray, const ReferenceScene& scene) {
    TraceHit best = shared::no_hit(ray.t_max);
    return trace(ray, scene, true, best);
}

} // namespace macula::bvh
