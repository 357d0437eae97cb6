// Meshes and rays for the tests of bvh/.
#pragma once

#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "bvh/bvh.hpp"
#include "bvh/reference.hpp"

namespace macula::bvh::test {

struct Soup {
    std::vector<float> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint8_t> masked;

    Geometry geometry() const { return {positions, triangles, masked}; }
    std::uint32_t add_vertex(float x, float y, float z) {
        positions.insert(positions.end(), {x, y, z});
        return static_cast<std::uint32_t>(positions.size() / 3 - 1);
    }
    void add(const std::array<float, 9>& p) {
        const std::uint32_t a = add_vertex(p[0], p[1], p[2]);
        const std::uint32_t b = add_vertex(p[3], p[4], p[5]);
        const std::uint32_t c = add_vertex(p[6], p[7], p[8]);
        triangles.push_back({a, b, c});
    }
};

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float operator()(float lo, float hi) {
        return lo + (hi - lo) * (static_cast<float>(engine_() >> 8) * 0x1p-24f);
    }
    std::uint32_t below(std::uint32_t n) { return engine_() % n; }

  private:
    std::mt19937 engine_;
};

// Triangles of edges up to `size` in the cube of +-1.
inline Soup random_soup(std::uint32_t count, float size, std::uint32_t seed) {
    Random random(seed);
    Soup soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float x = random(-1, 1), y = random(-1, 1), z = random(-1, 1);
        const auto near = [&](float c) { return c + random(-size, size); };
        soup.add({x, y, z, near(x), near(y), near(z), near(x), near(y), near(z)});
    }
    return soup;
}

// Long thin triangles across the cube: what spatial splits are for.
inline Soup needles(std::uint32_t count, std::uint32_t seed) {
    Random random(seed);
    Soup soup;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::array<float, 9> p{};
        for (int c = 0; c < 6; ++c)
            p[static_cast<std::size_t>(c)] = random(-1, 1);
        for (std::size_t c = 0; c < 3; ++c)
            p[6 + c] = p[c] + random(-0.02f, 0.02f);
        soup.add(p);
    }
    return soup;
}

inline Ray ray_between(const std::array<float, 3>& from, const std::array<float, 3>& to,
                       float t_max = 1e30f) {
    Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = from[axis];
        ray.direction[axis] = to[axis] - from[axis];
    }
    ray.t_max = t_max;
    return ray;
}

inline Ray random_ray(Random& random, float reach = 2.0f) {
    return ray_between({random(-reach, reach), random(-reach, reach), random(-reach, reach)},
                       {random(-1, 1), random(-1, 1), random(-1, 1)});
}

// One mesh, placed once with the identity, laid out for the reference traversal.
struct OneMesh {
    Tree tree;
    LaidOut laid_out;
    shared::Instance instance{};
    std::vector<shared::BinaryNode> upper;
    Geometry mesh;
    shared::MaskTables masks{};

    explicit OneMesh(const Geometry& geometry, const BuildOptions& options = {})
        : tree(build(geometry, options)), laid_out(lay_out(tree, geometry, Layout::binary)),
          mesh(geometry) {
        for (int row = 0; row < 3; ++row)
            instance.world_from_object[row][row] = 1.0f;
        instance.root = laid_out.root;
        instance.triangle_count = static_cast<std::uint32_t>(geometry.triangles.size());
        place(instance, laid_out.box);
        upper = build_upper({&instance, 1});
    }
    ReferenceScene scene() const {
        return {{reinterpret_cast<const shared::BinaryNode*>(laid_out.nodes.data()),
                 laid_out.node_count},
                {reinterpret_cast<const shared::Triangle*>(laid_out.triangles.data()),
                 laid_out.triangle_entries},
                {&instance, 1},
                upper,
                masks};
    }
    shared::TraceHit by_tree(const Ray& ray) const { return closest(ray, scene()); }
    shared::TraceHit by_brute_force(const Ray& ray) const {
        return closest_by_brute_force(ray, {&mesh, 1}, {&instance, 1}, masks);
    }
};

inline bool same_bits(const shared::TraceHit& a, const shared::TraceHit& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

} // namespace macula::bvh::test
