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

inline double mean_error(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * double(a.size()));
}

} // namespace macula::test::upscale
