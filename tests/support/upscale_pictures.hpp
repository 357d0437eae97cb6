// What the tests of smoothing and upscaling share: a device, set-ups, and comparisons of pictures.
#pragma once

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace macula::test::upscale {

struct Float4 {
    float x, y, z, w;
};
using Picture = std::vector<Float4>;

inline compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

inline const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

inline WeierSetup of_method(const char* method) {
    WeierSetup setup;
    setup.method = method;
    return setup;
}

// The foveal disk covers the image: what is left is the method's smoothing or enlarging.
inline WeierSetup whole_disk(const char* method) {
    WeierSetup setup = of_method(method);
    setup.log_polar.disk = 3.0f;
    return setup;
}

inline scene::Camera moved(const scene::Scene& scene, glm::vec3 by) {
    scene::Camera view = scene.cameras.front();
    view.eye += by;
    view.target += by;
    return view;
}

inline bool same_bits(const Picture& a, const Picture& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Float4)) == 0;
}

inline bool is_finite(const Float4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// A box whose front is red and whose right side, `deep`, is blue, before a black wall at `wall_z`.
inline scene::Scene two_sided_box(float wall_z, float deep, const View& view) {
    scene::Mesh wall, box;
    add_quad(wall, {-40, -40, wall_z}, {80, 0, 0}, {0, 80, 0}, 0);
    add_quad(box, {-1, -1, 0.3f}, {2, 0, 0}, {0, 2, 0}, 1);
    add_quad(box, {1, -1, 0.3f}, {0, 0, -deep}, {0, 2, 0}, 2);
    scene::Scene scene = scene_of(std::move(wall), view);
    scene.meshes.push_back(std::move(box));
    scene.instances.push_back({1, {}, "box"});
    scene.materials.resize(3);
    for (scene::Material& material : scene.materials)
        material.diffuse = material.emission = glm::vec3(0.0f);
    scene.materials[1].emission = glm::vec3(1.0f, 0.0f, 0.0f);
    scene.materials[2].emission = glm::vec3(0.0f, 0.0f, 1.0f);
    return scene;
}

// About the vertical axis, in radians.
inline scene::Transform turned(float angle) {
    scene::Transform there;
    there.row[0] = {std::cos(angle), 0, std::sin(angle), 0};
    there.row[2] = {-std::sin(angle), 0, std::cos(angle), 0};
    return there;
}

// All pixels up to `reach` from one show that side of the box alone, to within `slack`.
inline bool shows(const Picture& picture, int width, int height, int x, int y, int reach, bool red,
                  float slack) {
    if (x < reach || y < reach || x + reach >= width || y + reach >= height)
        return false;
    bool all = true;
    for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
            const Float4& c = picture[std::size_t((y + j) * width + x + i)];
            all = all && std::abs(c.x - (red ? 1.0f : 0.0f)) <= slack &&
                  std::abs(c.z - (red ? 0.0f : 1.0f)) <= slack;
        }
    return all;
}

inline double mean_error(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * double(a.size()));
}

} // namespace macula::test::upscale
