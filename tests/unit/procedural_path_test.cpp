// No fly-through comes near a surface, and no default camera stands in one.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <unordered_map>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/camera_path.hpp"
#include "scenes/procedural/registry.hpp"
#include "tests/support/sanitized.hpp"

namespace macula::scene::procedural {
namespace {

// Square of the distance from p to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
float distance_squared(glm::vec3 p, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto to_segment = [&](glm::vec3 from, glm::vec3 to) {
        const glm::vec3 d = to - from;
        const float t = std::clamp(glm::dot(p - from, d) / glm::dot(d, d), 0.0f, 1.0f);
        const glm::vec3 rest = p - (from + t * d);
        return glm::dot(rest, rest);
    };
    const glm::vec3 n = glm::cross(b - a, c - a);
    const auto inside = [&](glm::vec3 from, glm::vec3 to) {
        return glm::dot(glm::cross(to - from, p - from), n) >= 0.0f;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) {
        const float height = glm::dot(p - a, n);
        return height * height / glm::dot(n, n);
    }
    return std::min(to_segment(a, b), std::min(to_segment(b, c), to_segment(c, a)));
}

// Viewpoints in a hash of cells, to find those near a triangle.
class Viewpoints {
  public:
    explicit Viewpoints(float cell) : cell_(cell) {}

    void add(glm::vec3 p) {
        cells_[key(glm::ivec3(glm::floor(p / cell_)))].push_back(points_.size());
        points_.push_back(p);
        nearest_.push_back(cell_);
    }

    void approach(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const glm::vec3 lo = glm::min(a, glm::min(b, c)) - cell_;
        const glm::vec3 hi = glm::max(a, glm::max(b, c)) + cell_;
        const glm::ivec3 first(glm::floor(lo / cell_)), last(glm::floor(hi / cell_));
        const glm::vec3 extent(last - first + 1);
        if (extent.x * extent.y * extent.z > static_cast<float>(points_.size())) {
            for (std::size_t i = 0; i < points_.size(); ++i)
                measure(i, a, b, c);
            return;
        }
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const auto found = cells_.find(key({x, y, z}));
                    if (found != cells_.end())
                        for (const std::size_t i : found->second)
                            measure(i, a, b, c);
                }
    }

    // Distance of the viewpoint with the nearest surface; at most the cell's size.
    std::pair<float, std::size_t> least() const {
        const auto at = std::min_element(nearest_.begin(), nearest_.end());
        return {*at, static_cast<std::size_t>(at - nearest_.begin())};
    }

  private:
    static std::uint64_t key(glm::ivec3 c) {
        const auto bits = [](int v) { return static_cast<std::uint64_t>(v) + (1u << 20); };
        return bits(c.x) | bits(c.y) << 21 | bits(c.z) << 42;
    }
    void measure(std::size_t i, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        nearest_[i] = std::min(nearest_[i], std::sqrt(distance_squared(points_[i], a, b, c)));
    }

    float cell_;
    std::vector<glm::vec3> points_;
    std::vector<float> nearest_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

void approach_all(Viewpoints& views, const Scene& scene) {
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        std::vector<glm::vec3> world;
        for (const glm::vec3& p : mesh.positions)
            world.push_back(instance.world_from_object.apply(p));
        for (const glm::uvec3& t : mesh.triangles)
            views.approach(world[t.x], world[t.y], world[t.z]);
    }
}

void keeps_clear_of_all_surfaces(const Scene& scene, float clearance) {
    Viewpoints views(2.0f * clearance);
    // Dense enough that no surface fits between two of them unseen.
    glm::vec3 last = view_at(scene.path, 0.0f).eye;
    float longest_step = 0.0f;
    constexpr int kSubsteps = 4;
    for (int i = 0; i <= 1000 * kSubsteps; ++i) {
        const glm::vec3 eye = view_at(scene.path, static_cast<float>(i) / kSubsteps).eye;
        longest_step = std::max(longest_step, glm::length(eye - last));
        views.add(eye);
        last = eye;
    }
    ASSERT_LT(longest_step, clearance);
    approach_all(views, scene);
    const auto [distance, index] = views.least();
    const float frame = static_cast<float>(index) / kSubsteps;
    const glm::vec3 eye = view_at(scene.path, frame).eye;
    EXPECT_GE(distance, clearance)
        << "frame " << frame << " at " << eye.x << ' ' << eye.y << ' ' << eye.z;
}

void looks_somewhere_and_turns_smoothly(const Scene& scene) {
    glm::vec3 last{0.0f};
    for (int i = 0; i <= 1000; ++i) {
        const CameraView view = view_at(scene.path, static_cast<float>(i));
        const glm::vec3 gaze = view.target - view.eye;
        ASSERT_GT(glm::length(gaze), 1e-3f) << "frame " << i;
        const glm::vec3 direction = glm::normalize(gaze);
        ASSERT_LT(std::fabs(direction.y), 0.98f) << "up vector fails at frame " << i;
        ASSERT_TRUE(i == 0 || glm::dot(direction, last) > 0.99f) << "frame " << i;
        last = direction;
    }
}

void default_camera_stands_in_free_space(const Scene& scene, float clearance) {
    Viewpoints views(2.0f * clearance);
    views.add(scene.cameras.at(0).eye);
    approach_all(views, scene);
    EXPECT_GE(views.least().first, clearance);
}

struct Case {
    std::string name;
    std::uint32_t size;
    float clearance; // scene units
};

void PrintTo(const Case& tested, std::ostream* out) {
    *out << tested.name;
}

class ProceduralPath : public testing::TestWithParam<Case> {};

TEST_P(ProceduralPath, IsClearAndSmooth) {
    if (test::kSanitized && GetParam().name != "cornell")
        GTEST_SKIP() << test::too_long_sanitized("the path of " + GetParam().name);
    const Scene scene = *make(GetParam().name, {1, GetParam().size});
    keeps_clear_of_all_surfaces(scene, GetParam().clearance);
    looks_somewhere_and_turns_smoothly(scene);
    default_camera_stands_in_free_space(scene, GetParam().clearance);
}

INSTANTIATE_TEST_SUITE_P(
    All, ProceduralPath,
    testing::Values(Case{"cornell", 0, 20.0f}, Case{"cornell_spheres", 0, 20.0f},
                    Case{"whitted", 0, 0.3f}, Case{"whitted_moving", 0, 0.3f},
                    Case{"tunnel_geometry", 0, 0.4f}, Case{"tunnel_maps", 0, 0.8f},
                    Case{"atrium", 0, 0.3f}, Case{"city", 0, 1.0f}, Case{"voxel_city", 64, 1.0f},
                    Case{"voxel_city", 256, 1.0f}, Case{"spheres", 0, 0.3f}),
    [](const auto& tested) { return tested.param.name + std::to_string(tested.param.size); });

} // namespace
} // namespace macula::scene::procedural
