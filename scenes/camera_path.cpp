#include "scenes/camera_path.hpp"

#include <algorithm>
#include <stdexcept>

namespace macula::scene {
namespace {

struct Tangent {
    glm::vec3 eye, target; // a frame
};

// Beyond its ends the path stands still for as long as its first (last) piece takes.
Tangent tangent_at(const std::vector<CameraKey>& keys, std::size_t i) {
    const CameraKey &before = keys[i == 0 ? 0 : i - 1], &here = keys[i],
                    &after = keys[std::min(i + 1, keys.size() - 1)];
    const float start = i == 0 ? 2.0f * here.frame - after.frame : before.frame;
    const float end = i + 1 == keys.size() ? 2.0f * here.frame - before.frame : after.frame;
    const float frames = end - start;
    return {(after.eye - before.eye) / frames, (after.target - before.target) / frames};
}

// Cubic Hermite over `frames` frames, t in [0, 1]; exact at both ends.
glm::vec3 hermite(glm::vec3 from, glm::vec3 from_tangent, glm::vec3 to, glm::vec3 to_tangent,
                  float frames, float t) {
    const float back = 1.0f - t;
    const glm::vec3 along = (from_tangent * back - to_tangent * t) * (frames * t * back);
    const float weight = t * t * (3.0f - 2.0f * t);
    return from * (1.0f - weight) + to * weight + along;
}

} // namespace

CameraView view_at(const CameraPath& path, float frame) {
    const std::vector<CameraKey>& keys = path.keys;
    if (keys.empty())
        throw std::invalid_argument("a camera path without keys has no view");
    if (!(frame > keys.front().frame))
        return {keys.front().eye, keys.front().target};
    if (frame >= keys.back().frame)
        return {keys.back().eye, keys.back().target};
    const auto next = std::upper_bound(keys.begin(), keys.end(), frame,
                                       [](float f, const CameraKey& key) { return f < key.frame; });
    const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
    const CameraKey &from = keys[i], &to = keys[i + 1];
    const Tangent leaving = tangent_at(keys, i), arriving = tangent_at(keys, i + 1);
    const float frames = to.frame - from.frame, t = (frame - from.frame) / frames;
    return {hermite(from.eye, leaving.eye, to.eye, arriving.eye, frames, t),
            hermite(from.target, leaving.target, to.target, arriving.target, frames, t)};
}

} // namespace macula::scene
