#include "scenes/procedural/rails.hpp"

#include <cmath>
#include <cstdlib>

#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kKeysPerTurn = 4; // between keys a rotation takes the shorter way

} // namespace

glm::quat turned_about(glm::vec3 axis, float turns) {
    const glm::vec2 half = sin_cos_turns(0.5f * turns);
    return {half.x, half.y * axis.x, half.y * axis.y, half.y * axis.z};
}

std::uint32_t Rails::node(std::uint32_t parent, const Pose& rest) {
    MotionNode& added = scene_.motion.nodes.emplace_back();
    added.parent = parent;
    added.rest = rest;
    return static_cast<std::uint32_t>(scene_.motion.nodes.size() - 1);
}

void Rails::spin(std::uint32_t node, glm::vec3 axis, int turns) {
    MotionNode& spun = scene_.motion.nodes[node];
    const int keys = std::abs(turns) * kKeysPerTurn;
    for (int i = 0; i <= keys; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(keys);
        // Whole turns are left out of the angle: it stays small and exact.
        const float angle = static_cast<float>(i % kKeysPerTurn) / kKeysPerTurn;
        spun.rotation.frames.push_back(part * period_);
        spun.rotation.values.push_back(spun.rest.rotation *
                                       turned_about(axis, turns < 0 ? -angle : angle));
    }
}

void Rails::bounce(std::uint32_t node, int count, float height, float squash) {
    MotionNode& ball = scene_.motion.nodes[node];
    ball.translation.interpolation = Interpolation::cubic;
    const float frames = period_ / static_cast<float>(count), speed = 4.0f * height / frames;
    const float low = 1.0f - squash, wide = std::sqrt(1.0f / low);
    const float contact = 0.06f * frames; // from the first touch to the deepest
    const auto scale_key = [&](float frame, const glm::vec3& scale) {
        if (frame < 0.0f || frame > period_)
            return;
        ball.scale.frames.push_back(frame);
        ball.scale.values.push_back(ball.rest.scale * scale);
    };
    for (int i = 0; i <= count; ++i) {
        const float frame = static_cast<float>(i) * frames;
        const glm::vec3 up{0.0f, speed, 0.0f};
        ball.translation.frames.push_back(frame);
        for (const glm::vec3& value : {-up, ball.rest.translation, up})
            ball.translation.values.push_back(value);
        scale_key(frame - contact, glm::vec3{1.0f});
        scale_key(frame, {wide, low, wide});
        scale_key(frame + contact, glm::vec3{1.0f});
    }
}

void Rails::bob(std::uint32_t node, int count, float height) {
    MotionNode& moved = scene_.motion.nodes[node];
    moved.translation.interpolation = Interpolation::cubic;
    // A sine by its slopes at the crossings of its middle and at its turning points.
    const int keys = 4 * count;
    const float frames = period_ / static_cast<float>(keys);
    constexpr float kSlope = 1.5707963f; // pi / 2, of a sine's quarter
    static constexpr float kHeight[] = {0.0f, 1.0f, 0.0f, -1.0f}, kRise[] = {1, 0, -1, 0};
    for (int i = 0; i <= keys; ++i) {
        const glm::vec3 tangent{0.0f, kRise[i % 4] * kSlope * height / frames, 0.0f};
        moved.translation.frames.push_back(static_cast<float>(i) * frames);
        moved.translation.values.push_back(tangent);
        moved.translation.values.push_back(moved.rest.translation +
                                           glm::vec3{0.0f, kHeight[i % 4] * height, 0.0f});
        moved.translation.values.push_back(tangent);
    }
}

void Rails::carry(std::uint32_t node, std::uint32_t mesh, const std::string& name) {
    MovedInstance& moved = scene_.motion.instances.emplace_back();
    moved.instance = static_cast<std::uint32_t>(scene_.instances.size());
    moved.node = node;
    scene_.instances.push_back({mesh, {}, name});
}

} // namespace macula::scene::procedural
