#include "scenes/motion.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/scene.hpp"

namespace macula::scene {
namespace {

glm::vec3 between(const glm::vec3& a, const glm::vec3& b, float t) {
    return a * (1.0f - t) + b * t;
}

glm::quat between(const glm::quat& a, const glm::quat& b, float t) {
    return glm::slerp(a, b, t);
}

// Of the key at `i`; of `cubic` the one in the middle of three.
template <typename T>
const T& value_of(const Track<T>& track, std::size_t i) {
    return track.interpolation == Interpolation::cubic ? track.values[3 * i + 1] : track.values[i];
}

// A spline between opposite rotations may pass through none.
glm::vec3 finished(const glm::vec3& v, const glm::vec3& /*nearest*/) {
    return v;
}

glm::quat finished(const glm::quat& q, const glm::quat& nearest) {
    return glm::length(q) > 1e-6f ? glm::normalize(q) : nearest;
}

// glTF 2.0, appendix C.5.
template <typename T>
T cubic(const Track<T>& track, std::size_t i, float t) {
    const float frames = track.frames[i + 1] - track.frames[i];
    const float t2 = t * t, t3 = t2 * t;
    const T &from = track.values[3 * i + 1], &leaving = track.values[3 * i + 2];
    const T &arriving = track.values[3 * i + 3], &to = track.values[3 * i + 4];
    return finished(from * (2.0f * t3 - 3.0f * t2 + 1.0f) +
                        leaving * (frames * (t3 - 2.0f * t2 + t)) + to * (3.0f * t2 - 2.0f * t3) +
                        arriving * (frames * (t3 - t2)),
                    t < 0.5f ? from : to);
}

template <typename T>
T evaluate(const Track<T>& track, float frame, const T& rest) {
    if (track.frames.empty())
        return rest;
    const auto next = std::upper_bound(track.frames.begin(), track.frames.end(), frame);
    if (next == track.frames.begin())
        return value_of(track, 0);
    const auto i = static_cast<std::size_t>(next - track.frames.begin()) - 1;
    if (next == track.frames.end() || track.interpolation == Interpolation::step)
        return value_of(track, i);
    const float t = (frame - track.frames[i]) / (track.frames[i + 1] - track.frames[i]);
    if (track.interpolation == Interpolation::cubic)
        return cubic(track, i, t);
    return between(track.values[i], track.values[i + 1], t);
}

glm::mat4 matrix_of(const MotionNode& node, float frame) {
    const glm::vec3 moved = evaluate(node.translation, frame, node.rest.translation);
    const glm::quat turned = evaluate(node.rotation, frame, node.rest.rotation);
    const glm::vec3 scaled = evaluate(node.scale, frame, node.rest.scale);
    glm::mat4 m = glm::mat4_cast(turned);
    for (int axis = 0; axis < 3; ++axis)
        m[axis] *= scaled[axis];
    m[3] = glm::vec4(moved, 1.0f);
    return m;
}

} // namespace

Transform transform_of(const glm::mat4& m) {
    Transform t;
    for (int row = 0; row < 3; ++row)
        t.row[row] = glm::vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
    return t;
}

void place_nodes(const Motion& motion, float frame, std::vector<glm::mat4>& world_from_node) {
    world_from_node.resize(motion.nodes.size());
    const float time = motion.period > 0.0f ? std::fmod(frame, motion.period) : frame;
    for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
        const MotionNode& node = motion.nodes[i];
        const glm::mat4 local = matrix_of(node, time);
        world_from_node[i] = node.parent == kNoNode ? local : world_from_node[node.parent] * local;
    }
}

Transform placed(const MovedInstance& moved, const std::vector<glm::mat4>& world_from_node) {
    return transform_of(world_from_node[moved.node] * moved.node_from_object);
}

void place_instances(Scene& scene, float frame) {
    std::vector<glm::mat4> world_from_node;
    place_nodes(scene.motion, frame, world_from_node);
    for (const MovedInstance& moved : scene.motion.instances)
        scene.instances[moved.instance].world_from_object = placed(moved, world_from_node);
}

} // namespace macula::scene
