// The vector variants (packet16, packet_stream, stream) against the CPU reference, bit for bit:
// every query kind, with and without instances and masks.
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/ray_blocks.hpp"
#include "host/cl/device.hpp"
#include "host/frame/geometry.hpp"
#include "host/kernel/library.hpp"
#include "host/selftest/scene.hpp"
#include "host/stage/trace.hpp"

namespace {
using namespace macula;
using bvh::Ray;
using glm::vec3;

constexpr float kFar = 1e30f;

class Random {
  public:
    float next(float lo, float hi) {
        return lo + (hi - lo) * static_cast<float>(engine_() >> 8) * 0x1p-24f;
    }
    vec3 point(float size) { return {next(-size, size), next(-size, size), next(-size, size)}; }

  private:
    std::mt19937 engine_{17};
};

Ray ray(const vec3& origin, const vec3& direction, float t_min = 0.0f, float t_max = kFar) {
    return {{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, t_min, t_max};
}

void add_triangle(scene::Mesh& mesh, const vec3& a, const vec3& b, const vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const vec3& p : {a, b, c}) {
        mesh.positions.push_back(p);
        mesh.uvs.emplace_back(p.x, p.y + p.z);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangle_material.push_back(0);
}

scene::Scene scene_of(scene::Mesh mesh) {
    scene::Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({0, {}, "all"});
    return scene;
}

scene::Scene soup(std::uint32_t triangles) {
    scene::Mesh mesh;
    Random random;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const vec3 at = random.point(10.0f);
        const float size = i % 50 == 0 ? 8.0f : 0.8f;
        add_triangle(mesh, at, at + random.point(size), at + random.point(size));
    }
    return scene_of(std::move(mesh));
}

// A bumpy floor of integer coordinates, whose vertices and edges rays can meet exactly.
scene::Scene floor_grid() {
    scene::Mesh mesh;
    const auto corner = [](int x, int z) {
        return vec3(static_cast<float>(x), static_cast<float>((x * 7 + z * 3) % 4),
                    static_cast<float>(z));
    };
    for (int z = -20; z < 20; ++z) {
        for (int x = -20; x < 20; ++x) {
            add_triangle(mesh, corner(x, z), corner(x + 1, z), corner(x, z + 1));
            add_triangle(mesh, corner(x + 1, z), corner(x + 1, z + 1), corner(x, z + 1));
        }
    }
    return scene_of(std::move(mesh));
}

scene::Scene without_masks(scene::Scene scene) {
    for (scene::Material& material : scene.materials)
        material.alpha_mode = scene::AlphaMode::opaque;
    return scene;
}

// The masks of the self-test's scene on a soup in one identity instance.
scene::Scene masked_soup() {
    scene::Scene scene = soup(1500);
    scene.textures = selftest::make_scene().textures;
    scene.materials[0].alpha_mode = scene::AlphaMode::mask;
    scene.materials[0].diffuse_texture = 0;
    return scene;
}

// A pinhole image of 4 x 4 packets; its axis is along z, so that packets at the centre have
// directions of both signs.
std::vector<Ray> camera(const vec3& eye, std::uint32_t packets_across, float tangent,
                        const vec3& forward = {0, 0, 1}) {
    const vec3 right = glm::normalize(glm::cross(forward, vec3(0.1f, 1, 0)));
    const vec3 up = glm::cross(right, forward);
    std::vector<Ray> rays;
    const std::uint32_t count = packets_across * packets_across * 16;
    const auto size = static_cast<float>(packets_across * 4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t packet = i / 16, lane = i % 16;
        const auto x = static_cast<float>(packet % packets_across * 4 + lane % 4);
        const auto y = static_cast<float>(packet / packets_across * 4 + lane / 4);
        rays.push_back(ray(eye, forward + right * ((2 * x + 1) / size - 1) * tangent +
                                    up * (1 - (2 * y + 1) / size) * tangent));
    }
    return rays;
}

std::vector<Ray> incoherent(std::uint32_t count) {
    Random random;
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec3 from = random.point(12.0f);
        rays.push_back(ray(from, random.point(12.0f) - from, i % 5 == 0 ? 0.3f : 0.0f,
                           i % 3 == 0 ? 1.0f : kFar));
    }
    return rays;
}

// From points close together towards one light, and the other way around.
std::vector<Ray> shadow(std::uint32_t count) {
    Random random;
    std::vector<Ray> rays;
    const vec3 light(3, 40, -5);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto at = static_cast<float>(i / 16);
        const vec3 from = vec3(at * 0.1f - 10, -10.0f + 0.2f * at, 3) + random.point(0.2f);
        rays.push_back(ray(from, light - from, 0.0f, i % 16 == 3 ? 0.4f : 0.999f));
    }
    return rays;
}

std::vector<Ray> axis_parallel() {
    std::vector<Ray> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign = -1; sign < 2; sign += 2) {
            for (int i = 0; i < 32; ++i) {
                vec3 origin(0.25f * static_cast<float>(i) - 4, 1, 0.5f * static_cast<float>(i) - 8);
                vec3 direction(0.0f);
                direction[axis] = static_cast<float>(sign);
                origin[axis] = -30.0f * static_cast<float>(sign);
                rays.push_back(ray(origin, direction));
            }
        }
    }
    return rays;
}

// From one eye through vertices and middles of edges of the first triangles.
std::vector<Ray> through_features(const scene::Scene& scene) {
    const scene::Mesh& mesh = scene.meshes.front();
    const vec3 eye(0.5f, 25, -3);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < 200 && i < mesh.triangles.size(); ++i) {
        const vec3 a = mesh.positions[mesh.triangles[i].x], b = mesh.positions[mesh.triangles[i].y];
        rays.push_back(ray(eye, a - eye));
        rays.push_back(ray(eye, 0.5f * (a + b) - eye));
        rays.push_back(ray(a + vec3(0, 9, 0), {0, -1, 0}));
    }
    return rays;
}

// Every third ray of each kind of inactivity, some with origins that are no places.
std::vector<Ray> with_inactive(std::vector<Ray> rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i % 3 == 0 && i % 2 == 0)
            rays[i].origin[i / 6 % 3] = std::nanf("");
        if (i % 3 == 0)
            rays[i].t_max = -1.0f;
        else if (i % 7 == 0)
            rays[i].t_min = 2 * kFar;
        else if (i % 11 == 0)
            rays[i].t_min = -1.0f;
        if (i / 16 % 4 == 1)
            rays[i].t_max = std::nanf("");
    }
    return rays;
}

std::vector<shared::RayBlock> full_blocks_of(std::vector<Ray> rays, std::size_t blocks) {
    // Lanes beyond the count hold rays that would hit, and must not be traced.
    rays.resize(blocks * 16, Ray{{}, {1, 0, 0}, 0.0f, kFar});
    return bvh::blocks_of(rays, rays.size());
}

std::string text(float t, float u, float v, std::uint32_t triangle) {
    // The bits of a NaN, given as t_max and so returned, may change on the way.
    const auto bits = [](float x) {
        return std::isnan(x) ? "NaN" : std::to_string(std::bit_cast<std::uint32_t>(x));
    };
    return bits(t) + " " + bits(u) + " " + bits(v) + " " + std::to_string(triangle);
}

class SimdVariants : public testing::TestWithParam<const char*> {
  protected:
    void open(const scene::Scene& scene) {
        geometry_.emplace(device_, scene);
        reference_ = geometry_->reference();
        stage::VariantTable table;
        table.fill({&kernel::find_variant(GetParam()), {}});
        tracer_.emplace(device_, library_, *geometry_, table);
    }

    void check(const std::string& what, const std::vector<Ray>& rays) {
        SCOPED_TRACE(what);
        const std::size_t block_count = (rays.size() + 15) / 16 + 1;
        const auto capacity = static_cast<std::uint32_t>(block_count * 16);
        const auto count = static_cast<std::uint32_t>(rays.size());
        const std::vector<shared::RayBlock> host_blocks = full_blocks_of(rays, block_count);
        const auto blocks = device_.upload(std::span(host_blocks), "rays");
        const auto counter = device_.upload(std::span(&count, 1), "ray count");
        auto hits = device_.allocate_array<shared::HitBlock>(block_count, "hits");
        auto occluded = device_.allocate_array<std::uint32_t>(capacity, "occluded");
        const auto ray_class = kernel::RayClass::random;
        tracer_->closest(ray_class, blocks, counter, capacity, hits, "closest");
        tracer_->any(ray_class, blocks, counter, capacity, occluded, "any");
        const auto found = hits.map_read<shared::HitBlock>();
        const auto shadowed = occluded.map_read<std::uint32_t>();
        int wrong = 0;
        for (std::size_t i = 0; i < rays.size() && wrong < 5; ++i) {
            const shared::TraceHit hit = bvh::closest(rays[i], reference_);
            const shared::HitBlock& b = found[i / 16];
            const std::size_t lane = i % 16;
            const std::string ours = text(b.t[lane], b.u[lane], b.v[lane], b.triangle[lane]);
            const bool same = ours == text(hit.t, hit.u, hit.v, hit.triangle);
            const bool same_any = (shadowed[i] == 1) == bvh::occluded(rays[i], reference_);
            wrong += same && same_any && shadowed[i] < 2 ? 0 : 1;
            EXPECT_EQ(ours, text(hit.t, hit.u, hit.v, hit.triangle)) << "closest, ray " << i;
            EXPECT_TRUE(same_any) << "any, ray " << i;
        }
    }

    void check_all(const scene::Scene& scene) {
        open(scene);
        check("camera", camera({0.3f, 6, -25}, 12, 0.6f));
        check("wide camera", camera({0, 4, 0}, 12, 3.0f, glm::normalize(vec3(1, -0.4f, 0.2f))));
        check("incoherent", incoherent(1000));
        check("shadow", shadow(1000));
        check("axis parallel", axis_parallel());
        check("vertices and edges", through_features(scene));
        check("inactive", with_inactive(camera({0.3f, 6, -25}, 10, 0.6f)));
        check("inactive and incoherent", with_inactive(incoherent(500)));
    }

    compute::Device device_ = compute::open();
    kernel::Library library_;
    std::optional<frame::DeviceGeometry> geometry_;
    bvh::ReferenceScene reference_;
    std::optional<stage::Tracer> tracer_;
};

TEST_P(SimdVariants, RandomSoup) {
    check_all(soup(2000));
}

TEST_P(SimdVariants, GridOfSharedVerticesAndEdges) {
    check_all(floor_grid());
}

TEST_P(SimdVariants, AlphaMasks) {
    check_all(masked_soup());
}

TEST_P(SimdVariants, RotatedAndScaledInstances) {
    check_all(without_masks(selftest::make_scene()));
}

TEST_P(SimdVariants, InstancesWithAlphaMasks) {
    check_all(selftest::make_scene());
}

TEST_P(SimdVariants, CoincidentTrianglesGoToTheLowestId) {
    scene::Mesh mesh;
    for (int copy = 0; copy < 40; ++copy) {
        for (int i = 0; i < 4; ++i) {
            const auto x = static_cast<float>(i) * 2 - 4;
            add_triangle(mesh, {x, -2, 5}, {x + 3, -2, 5}, {x, 3, 6});
        }
    }
    open(scene_of(std::move(mesh)));
    check("camera", camera({0, 0, -6}, 12, 0.6f));
    check("incoherent", incoherent(1000));
}

TEST_P(SimdVariants, OneTriangle) {
    scene::Mesh mesh;
    add_triangle(mesh, {-3, -3, 4}, {3, -3, 4}, {0, 3, 4});
    open(scene_of(std::move(mesh)));
    check("camera", camera({0, 0, -6}, 6, 0.6f));
    check("incoherent", incoherent(100));
}

TEST_P(SimdVariants, AnyNumberOfRays) {
    open(soup(500));
    const std::vector<Ray> rays = camera({0, 0, -25}, 9, 0.5f);
    for (const std::size_t count : {0, 1, 15, 16, 17, 255, 257, 1000, 1025})
        check(std::to_string(count) + " rays", {rays.begin(), rays.begin() + count});
}

TEST_P(SimdVariants, FarFromTheOrigin) {
    scene::Scene scene = soup(500);
    for (vec3& p : scene.meshes[0].positions)
        p += vec3(3000, -2000, 5000);
    open(scene);
    check("camera", camera({3000, -2000, 4975}, 10, 0.6f));
}

// Around the sizes from which on, and the determinants from which down, boxes of triangles are
// tested (kernels/lib/plain_hit.h).
TEST_P(SimdVariants, TinyAndHugeScenes) {
    for (const int exponent : {-45, -30, -20, 26, 27, 40, 48}) {
        const float size = std::ldexp(1.0f, exponent);
        scene::Scene scene = soup(500);
        for (vec3& p : scene.meshes[0].positions)
            p *= size;
        open(scene);
        for (const int faster : {-20, 0, 31}) {
            std::vector<Ray> rays = camera({0.3f, 6, -25}, 10, 0.6f);
            const std::vector<Ray> others = incoherent(300);
            rays.insert(rays.end(), others.begin(), others.end());
            for (Ray& r : rays) {
                for (int axis = 0; axis < 3; ++axis) {
                    r.origin[axis] *= size;
                    r.direction[axis] = std::ldexp(r.direction[axis], faster);
                }
            }
            check("size 2^" + std::to_string(exponent) + ", direction 2^" + std::to_string(faster),
                  rays);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Variants, SimdVariants,
                         testing::Values("packet16", "packet_stream", "stream"),
                         [](const auto& param) { return std::string(param.param); });
} // namespace
