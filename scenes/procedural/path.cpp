#include "scenes/procedural/path.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace macula::scene::procedural {
namespace {

constexpr int kKeyDistance = 20; // frames
constexpr int kSteps = 64;       // for the length of a piece

// Uniform Catmull-Rom through b and c.
glm::vec3 spline(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, float t) {
    const glm::vec3 p = 2.0f * b, q = c - a, r = 2.0f * a - 5.0f * b + 4.0f * c - d,
                    s = 3.0f * (b - c) + d - a;
    return 0.5f * (p + t * (q + t * (r + t * s)));
}

class Route {
  public:
    Route(std::span<const Waypoint> points, bool closed) : points_(points), closed_(closed) {
        const std::size_t pieces = closed ? points.size() : points.size() - 1;
        length_.push_back(0.0f);
        Waypoint last = points_.front();
        for (std::size_t i = 0; i < pieces; ++i)
            for (int k = 1; k <= kSteps; ++k) {
                const Waypoint now = at(i, static_cast<float>(k) / kSteps);
                // A turn of the head takes time as well.
                length_.push_back(length_.back() + glm::length(now.eye - last.eye) +
                                  0.5f * glm::length(now.target - last.target));
                last = now;
            }
    }

    // The view after `fraction` of the whole length.
    Waypoint after(float fraction) const {
        const float wanted = fraction * length_.back();
        const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
        const auto i = static_cast<std::size_t>(above - length_.begin()) - 1;
        const float piece = std::max(length_[i + 1] - length_[i], 1e-6f);
        const float t = (static_cast<float>(i % kSteps) + (wanted - length_[i]) / piece) / kSteps;
        return at(i / kSteps, std::clamp(t, 0.0f, 1.0f));
    }

  private:
    const Waypoint& point(std::ptrdiff_t i) const {
        const auto n = static_cast<std::ptrdiff_t>(points_.size());
        return points_[static_cast<std::size_t>(closed_ ? (i + n) % n
                                                        : std::clamp<std::ptrdiff_t>(i, 0, n - 1))];
    }
    Waypoint at(std::size_t piece, float t) const {
        const auto i = static_cast<std::ptrdiff_t>(piece);
        const Waypoint &a = point(i - 1), &b = point(i), &c = point(i + 1), &d = point(i + 2);
        return {spline(a.eye, b.eye, c.eye, d.eye, t),
                spline(a.target, b.target, c.target, d.target, t)};
    }

    std::span<const Waypoint> points_;
    bool closed_;
    std::vector<float> length_;
};

} // namespace

CameraPath fly_through(std::span<const Waypoint> waypoints, bool closed) {
    const Route route(waypoints, closed);
    CameraPath path;
    path.frames = kPathFrames;
    for (int frame = 0; frame <= static_cast<int>(kPathFrames); frame += kKeyDistance) {
        const float fraction = static_cast<float>(frame) / static_cast<float>(kPathFrames);
        const Waypoint view = route.after(fraction);
        path.keys.push_back({static_cast<float>(frame), view.eye, view.target});
    }
    return path;
}

} // namespace macula::scene::procedural
