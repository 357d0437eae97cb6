// Two levels and masks: instances under any affine transform, found by the tree as by brute force.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

using Rows = float[3][4];

void set_identity(Rows& m) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column)
            m[row][column] = row == column ? 1.0f : 0.0f;
    }
}

// Rotation about a random axis, then a scale for each axis, then a translation.
void set_random(Rows& m, Random& random, float scale_lo, float scale_hi) {
    float axis[3], length = 0.0f;
    for (float& x : axis) {
        x = random(-1, 1);
        length += x * x;
    }
    for (float& x : axis)
        x /= std::sqrt(length);
    const float angle = random(0, 6.28f), c = std::cos(angle), s = std::sin(angle);
    for (int i = 0; i < 3; ++i) {
        const float scale = random(scale_lo, scale_hi);
        for (int j = 0; j < 3; ++j) {
            const int k = 3 - i - j;
            const float sign = (j - i + 3) % 3 == 1 ? -1.0f : 1.0f;
            const float turn = i == j ? c : sign * s * axis[k];
            m[i][j] = scale * (axis[i] * axis[j] * (1 - c) + turn);
        }
        m[i][3] = random(-4, 4);
    }
}

// Meshes in one node and one triangle array, and instances of them.
struct World {
    std::vector<Geometry> meshes;
    std::vector<shared::BinaryNode> nodes;
    std::vector<shared::Triangle> triangles;
    std::vector<Box> boxes;
    std::vector<int> roots;
    std::vector<std::uint32_t> mesh_triangles;
    std::vector<shared::Instance> instances;
    std::vector<shared::BinaryNode> upper;
    shared::MaskTables masks{};
    std::uint32_t scene_triangles = 0, table_triangles = 0;

    void add_mesh(const Geometry& geometry) {
        LaidOut mesh = lay_out(build(geometry), geometry, Layout::binary);
        rebase(mesh, static_cast<std::uint32_t>(nodes.size()),
               static_cast<std::uint32_t>(triangles.size()));
        const auto* n = reinterpret_cast<const shared::BinaryNode*>(mesh.nodes.data());
        const auto* t = reinterpret_cast<const shared::Triangle*>(mesh.triangles.data());
        nodes.insert(nodes.end(), n, n + mesh.node_count);
        triangles.insert(triangles.end(), t, t + mesh.triangle_entries);
        meshes.push_back(geometry);
        boxes.push_back(mesh.box);
        roots.push_back(mesh.root);
        mesh_triangles.push_back(table_triangles);
        table_triangles += static_cast<std::uint32_t>(geometry.triangles.size());
    }
    shared::Instance& add_instance(std::uint32_t mesh) {
        shared::Instance instance{};
        set_identity(instance.world_from_object);
        instance.mesh = mesh;
        instance.root = roots[mesh];
        instance.mesh_triangle = mesh_triangles[mesh];
        instance.first_triangle = scene_triangles;
        instance.triangle_count = static_cast<std::uint32_t>(meshes[mesh].triangles.size());
        scene_triangles += instance.triangle_count;
        return instances.emplace_back(instance);
    }
    void finish() {
        for (shared::Instance& instance : instances)
            place(instance, boxes[instance.mesh]);
        upper = build_upper(instances);
    }
    ReferenceScene scene() const { return {nodes, triangles, instances, upper, masks}; }
    void expect_agreement(int rays, std::uint32_t seed, int least_hits) const {
        Random random(seed);
        int hits = 0, mismatches = 0;
        for (int i = 0; i < rays; ++i) {
            const Ray ray = ray_between({random(-8, 8), random(-8, 8), random(-8, 8)},
                                        {random(-4, 4), random(-4, 4), random(-4, 4)});
            const shared::TraceHit brute = closest_by_brute_force(ray, meshes, instances, masks);
            hits += brute.triangle != MACULA_NO_TRIANGLE ? 1 : 0;
            mismatches += same_bits(closest(ray, scene()), brute) ? 0 : 1;
            EXPECT_EQ(occluded(ray, scene()), brute.triangle != MACULA_NO_TRIANGLE);
        }
        EXPECT_EQ(mismatches, 0);
        EXPECT_GT(hits, least_hits);
    }
};

TEST(BvhInstances, RotatedAndScaled) {
    const Soup a = random_soup(150, 0.4f, 1), b = needles(100, 2);
    World world;
    world.add_mesh(a.geometry());
    world.add_mesh(b.geometry());
    Random random(3);
    for (std::uint32_t i = 0; i < 20; ++i)
        set_random(world.add_instance(i % 2).world_from_object, random, 0.3f, 2.0f);
    world.finish();
    world.expect_agreement(3000, 4, 1000);
}

TEST(BvhInstances, MirroredAndFlattened) {
    const Soup a = random_soup(150, 0.4f, 5);
    World world;
    world.add_mesh(a.geometry());
    Random random(6);
    for (std::uint32_t i = 0; i < 10; ++i)
        set_random(world.add_instance(0).world_from_object, random, i % 2 == 0 ? -2.0f : 0.01f,
                   i % 2 == 0 ? -0.5f : 0.1f);
    world.finish();
    world.expect_agreement(3000, 7, 500);
}

// The same instance twice: equal t everywhere, so the lower scene-wide id must win.
TEST(BvhInstances, CoincidentInstancesGiveTheLowerId) {
    const Soup a = random_soup(150, 0.4f, 8);
    World world;
    world.add_mesh(a.geometry());
    Random random(9);
    Rows place_both;
    set_random(place_both, random, 2.0f, 3.0f);
    for (int i = 0; i < 3; ++i)
        std::memcpy(world.add_instance(0).world_from_object, place_both, sizeof place_both);
    world.finish();
    world.expect_agreement(3000, 10, 200);
    Random rays(11);
    for (int i = 0; i < 500; ++i) {
        const shared::TraceHit hit = closest(random_ray(rays, 8.0f), world.scene());
        EXPECT_TRUE(hit.triangle == MACULA_NO_TRIANGLE || hit.triangle < 150);
    }
}

TEST(BvhInstances, TheIdentityEqualsTheMeshItself) {
    const Soup a = needles(300, 12);
    World world;
    world.add_mesh(a.geometry());
    world.add_instance(0);
    world.finish();
    EXPECT_EQ(world.instances[0].identity, 1u);
    const OneMesh mesh(a.geometry());
    Random random(13);
    for (int i = 0; i < 3000; ++i) {
        const Ray ray = random_ray(random);
        EXPECT_TRUE(same_bits(closest(ray, world.scene()), mesh.by_tree(ray)));
    }
}

TEST(BvhInstances, EmptyMeshesAndNoInstances) {
    World world;
    world.add_mesh(Geometry{});
    world.add_instance(0);
    Random random(14);
    set_random(world.add_instance(0).world_from_object, random, 1.0f, 2.0f);
    world.finish();
    world.expect_agreement(20, 15, -1);
    world.instances.clear();
    world.finish();
    EXPECT_EQ(world.upper.size(), 1u);
    world.expect_agreement(20, 16, -1);
}

TEST(BvhInstances, UpperLevelOfManyInstancesIsWithinTheDepthBound) {
    std::vector<shared::Instance> instances(20000);
    Random random(17);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            instances[i].lo[axis] = i % 2 == 0 ? 0.0f : random(-1, 1);
            instances[i].hi[axis] = instances[i].lo[axis] + 0.01f;
        }
    }
    const auto nodes = build_upper(instances);
    EXPECT_EQ(nodes.size(), instances.size() - 1);
    std::vector<int> depth(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].child) {
            if (child >= 0)
                depth[static_cast<std::size_t>(child)] = depth[i] + 1;
        }
        EXPECT_LT(depth[i], MACULA_MAX_DEPTH);
    }
}

TEST(BvhInstances, SingularTransformsAreRefused) {
    shared::Instance instance{};
    const Box box = {{-1, -1, -1}, {1, 1, 1}};
    EXPECT_THROW(place(instance, box), std::invalid_argument);
    set_identity(instance.world_from_object);
    instance.world_from_object[1][1] = NAN;
    EXPECT_THROW(place(instance, box), std::invalid_argument);
    set_identity(instance.world_from_object);
    instance.world_from_object[2][3] = INFINITY;
    EXPECT_THROW(place(instance, box), std::invalid_argument);
}

TEST(BvhInstances, MasksLetRaysThroughTheirHoles) {
    Soup soup = random_soup(200, 0.6f, 18);
    soup.masked.assign(200, 0);
    for (std::size_t i = 0; i < 200; i += 2)
        soup.masked[i] = 1;
    World world;
    world.add_mesh(soup.geometry());
    Random random(19);
    std::vector<shared::uint> slots(200, 0xffffffffu); // read for masked triangles only
    std::vector<shared::MaskTriangle> mask_triangles;
    for (std::uint32_t i = 0; i < 200; i += 2) {
        slots[i] = static_cast<shared::uint>(mask_triangles.size());
        shared::MaskTriangle triangle{};
        for (auto& uv : triangle.uv) {
            uv[0] = random(-3, 3);
            uv[1] = random(-3, 3);
        }
        triangle.texture = random.below(3);
        mask_triangles.push_back(triangle);
    }
    const std::vector<shared::MaskTexture> textures = {
        {0, 40, 7, MACULA_WRAP_REPEAT | MACULA_WRAP_REPEAT << 2},
        {14, 5, 9, MACULA_WRAP_MIRROR | MACULA_WRAP_CLAMP << 2},
        {23, 1, 1, MACULA_WRAP_CLAMP | MACULA_WRAP_MIRROR << 2}};
    std::vector<shared::uint> words(24);
    for (auto& word : words)
        word = random.below(0xffffffffu);
    world.masks = {slots.data(), mask_triangles.data(), textures.data(), words.data()};
    world.add_instance(0);
    set_random(world.add_instance(0).world_from_object, random, 1.0f, 2.0f);
    world.finish();
    world.expect_agreement(3000, 20, 500);
}

} // namespace
} // namespace macula::bvh::test
