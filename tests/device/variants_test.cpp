// Every variant of the registry against the CPU reference, bit for bit, closest and any hit.
#include <gtest/gtest.h>

#include "host/frame/geometry.hpp"
#include "host/kernel/library.hpp"
#include "host/stage/trace.hpp"
#include "tests/support/trace_rays.hpp"

namespace {
using namespace macula;
using kernel::RayClass;

constexpr std::uint32_t kUnwritten = 0x5a5a5a5au;

struct Traced {
    std::vector<shared::HitBlock> hits;
    std::vector<std::uint32_t> occluded;
};

class Variants : public testing::TestWithParam<std::string> {
  protected:
    // `count` rays in a queue with room for `capacity`.
    Traced trace(frame::DeviceGeometry& geometry, const std::vector<bvh::Ray>& rays,
                 std::uint32_t count, std::uint32_t capacity) {
        stage::VariantTable table;
        table.fill({&kernel::find_variant(GetParam()), {}});
        stage::Tracer tracer(device_, library_, geometry, table);
        const auto blocks = bvh::blocks_of(rays, capacity);
        const compute::Buffer ray_buffer = device_.upload(std::span(blocks), "rays");
        const compute::Buffer counter =
            device_.upload(std::span<const std::uint32_t>(&count, 1), "ray count");
        auto hits = device_.allocate_array<shared::HitBlock>(blocks.size(), "hits");
        auto occluded = device_.allocate_array<std::uint32_t>(blocks.size() * 16, "occluded");
        hits.fill(kUnwritten);
        occluded.fill(kUnwritten);
        tracer.closest(RayClass::primary, ray_buffer, counter, capacity, hits, "closest");
        tracer.any(RayClass::shadow, ray_buffer, counter, capacity, occluded, "any");
        const auto h = hits.map_read<shared::HitBlock>();
        const auto o = occluded.map_read<std::uint32_t>();
        return {{h.begin(), h.end()}, {o.begin(), o.end()}};
    }

    void expect_reference(frame::DeviceGeometry& geometry, const std::vector<bvh::Ray>& rays,
                          std::uint32_t count, std::uint32_t capacity) {
        const bvh::ReferenceScene reference = geometry.reference();
        const Traced traced = trace(geometry, rays, count, capacity);
        std::uint32_t wrong = 0, hit = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const shared::TraceHit expected = bvh::closest(rays[i], reference);
            const bool occluded = bvh::occluded(rays[i], reference);
            hit += occluded ? 1 : 0;
            const bool same = same_hit(traced.hits[i / 16], i % 16, expected) &&
                              traced.occluded[i] == (occluded ? 1u : 0u);
            wrong += same ? 0 : 1;
            if (!same && wrong < 4)
                ADD_FAILURE() << describe(rays[i], i) << ": expected t " << expected.t
                              << " triangle " << expected.triangle << " occluded " << occluded
                              << ", found t " << traced.hits[i / 16].t[i % 16] << " triangle "
                              << traced.hits[i / 16].triangle[i % 16] << " occluded "
                              << traced.occluded[i];
        }
        EXPECT_EQ(wrong, 0u) << "of " << count;
        if (count >= 1000) { // the scene and the rays are meant to meet
            EXPECT_GT(hit, count / 20);
        }
    }

    void expect_reference(const scene::Scene& scene, const std::vector<bvh::Ray>& rays) {
        frame::DeviceGeometry geometry(device_, scene);
        const auto count = static_cast<std::uint32_t>(rays.size());
        expect_reference(geometry, rays, count, count);
    }

    static bool same_hit(const shared::HitBlock& block, std::uint32_t lane,
                         const shared::TraceHit& hit) {
        const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
        return block.triangle[lane] == hit.triangle && same_t(block.t[lane], hit.t) &&
               bits(block.u[lane]) == bits(hit.u) && bits(block.v[lane]) == bits(hit.v);
    }
    // The bits of a NaN, given as t_max and so returned, may change on the way.
    static bool same_t(float a, float b) {
        return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
               (std::isnan(a) && std::isnan(b));
    }

    static std::string describe(const bvh::Ray& r, std::uint32_t i) {
        std::ostringstream text;
        text << "ray " << i << " from " << r.origin[0] << ' ' << r.origin[1] << ' ' << r.origin[2]
             << " along " << r.direction[0] << ' ' << r.direction[1] << ' ' << r.direction[2]
             << " in " << r.t_min << " .. " << r.t_max;
        return text.str();
    }

    compute::Device device_ = compute::open();
    kernel::Library library_;
};

TEST_P(Variants, CoherentRaysInASoup) {
    expect_reference(test::soup_scene(),
                     test::coherent_rays(4000, {0.3f, 0.4f, -3.0f}, {0, 0, 0}, 0.8f));
}

TEST_P(Variants, RandomRaysInASoup) {
    expect_reference(test::soup_scene(), test::random_rays(2000, 1.5f, 1));
}

TEST_P(Variants, WhittedScene) {
    const scene::Scene scene = test::whitted_scene();
    const scene::Camera& camera = scene.cameras.at(0);
    auto rays = test::coherent_rays(2000, camera.eye, camera.target, 1.0f);
    expect_reference(scene, rays);
}

TEST_P(Variants, MaskedSurfaces) {
    auto rays = test::coherent_rays(2000, {2.0f, 1.0f, -2.0f}, {0, 0, 0}, 1.0f);
    const auto more = test::random_rays(1000, 1.5f, 2);
    rays.insert(rays.end(), more.begin(), more.end());
    expect_reference(test::masked_scene(), rays);
}

TEST_P(Variants, InstancesRotatedMirroredFlatAndCoincident) {
    auto rays = test::coherent_rays(2000, {6.0f, 2.0f, -6.0f}, {0, 0, 0}, 1.0f);
    const auto more = test::random_rays(1000, 4.0f, 3);
    rays.insert(rays.end(), more.begin(), more.end());
    expect_reference(test::instanced_scene(), rays);
}

TEST_P(Variants, MaskedInstances) {
    auto rays = test::coherent_rays(1000, {6.0f, 2.0f, -6.0f}, {0, 0, 0}, 1.0f);
    const auto more = test::random_rays(1000, 4.0f, 4);
    rays.insert(rays.end(), more.begin(), more.end());
    expect_reference(test::masked_instances_scene(), rays);
}

TEST_P(Variants, RaysInPlanesAlongEdgesThroughVertices) {
    expect_reference(test::lattice_scene(), test::lattice_rays());
}

TEST_P(Variants, OddRaysDoNotDisturbTheirNeighbours) {
    expect_reference(test::lattice_scene(), test::odd_rays());
    expect_reference(test::instanced_scene(), test::odd_rays());
}

TEST_P(Variants, CoincidentTriangles) {
    expect_reference(test::coincident_scene(),
                     test::coherent_rays(1000, {0.3f, 0.4f, -3.0f}, {0, 0, 0}, 0.8f));
}

TEST_P(Variants, CountsBelowTheCapacity) {
    frame::DeviceGeometry geometry(device_, test::soup_scene());
    const auto rays = test::coherent_rays(1024, {0.3f, 0.4f, -3.0f}, {0, 0, 0}, 0.8f);
    for (const std::uint32_t count : {0u, 1u, 17u, 1000u}) {
        SCOPED_TRACE(count);
        expect_reference(geometry, rays, count, 1024);
    }
}

TEST_P(Variants, MovedInstances) {
    scene::Scene scene = test::instanced_scene();
    frame::DeviceGeometry geometry(device_, scene);
    const auto rays = test::random_rays(1000, 4.0f, 5);
    expect_reference(geometry, rays, 1000, 1000);
    test::Random random(11);
    std::vector<scene::Transform> moved;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        moved.push_back(i == 0 ? scene::Transform{} : test::random_transform(random));
    geometry.set_transforms(moved);
    expect_reference(geometry, rays, 1000, 1000);
}

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const kernel::Variant& variant : kernel::variants())
        names.emplace_back(variant.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Registry, Variants, testing::ValuesIn(all_names()),
                         [](const auto& info) { return info.param; });

} // namespace
