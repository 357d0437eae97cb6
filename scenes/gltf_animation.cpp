#include "scenes/gltf_animation.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace macula::scene {
namespace {

// Many channels may name the same accessor: small files must not unfold without bounds.
constexpr std::size_t kMaxKeys = std::size_t{1} << 24;

// The index of the animation that is asked for; nothing for none.
std::optional<std::size_t> chosen(const GltfDocument& document, const std::string& wanted) {
    const std::vector<tinygltf::Animation>& all = document.model().animations;
    if (wanted == "none" || (wanted.empty() && all.empty()))
        return std::nullopt;
    if (wanted.empty())
        return 0;
    std::string names;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].name == wanted)
            return i;
        names += (i == 0 ? "'" : ", '") + all[i].name + "'";
    }
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto parsed = std::from_chars(wanted.data(), end, index);
    if (parsed.ec == std::errc() && parsed.ptr == end && index < all.size())
        return index;
    document.fail("animations",
                  "there is no '" + wanted + "'" + (all.empty() ? "" : "; there are " + names));
}

glm::vec3 value_of(const float* p, glm::vec3 /*kind*/) {
    return {p[0], p[1], p[2]};
}
glm::quat value_of(const float* p, glm::quat /*kind*/) {
    return {p[3], p[0], p[1], p[2]};
}

// A matrix that is a translation, a rotation and a scale.
Pose pose_of(const std::vector<double>& m, const GltfDocument& document, const std::string& where) {
    std::array<glm::dvec3, 3> axes;
    for (std::size_t i = 0; i < 3; ++i)
        axes[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
    glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    if (!(scale.x > 0.0 && scale.y > 0.0 && scale.z > 0.0))
        document.fail(where, "it moves, and its matrix is singular");
    for (int i = 0; i < 3; ++i)
        axes[static_cast<std::size_t>(i)] /= scale[i];
    for (std::size_t i = 0; i < 3; ++i)
        if (std::fabs(glm::dot(axes[i], axes[(i + 1) % 3])) > 1e-4)
            document.fail(where, "it moves, and its matrix is no translation, rotation and scale");
    if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) {
        scale.x = -scale.x;
        axes[0] = -axes[0];
    }
    Pose pose;
    pose.translation = {m[12], m[13], m[14]};
    pose.rotation = glm::quat(glm::quat_cast(glm::dmat3(axes[0], axes[1], axes[2])));
    pose.scale = glm::vec3(scale);
    return pose;
}

// What the loader has found to be sound.
Pose rest_of(const tinygltf::Node& node, const GltfDocument& document, const std::string& where) {
    if (!node.matrix.empty())
        return pose_of(node.matrix, document, where);
    Pose pose;
    if (!node.translation.empty())
        pose.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (!node.rotation.empty()) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (glm::length(q) > 0.0)
            pose.rotation = glm::quat(glm::normalize(q));
    }
    if (!node.scale.empty())
        pose.scale = {node.scale[0], node.scale[1], node.scale[2]};
    return pose;
}

} // namespace

GltfAnimation::GltfAnimation(const GltfDocument& document, const LoadOptions& options)
    : document_(document), frame_rate_(options.frame_rate) {
    const std::vector<tinygltf::Animation>& all = document.model().animations;
    const std::optional<std::size_t> index = chosen(document, options.animation);
    left_out_ = all.size() - (index ? 1 : 0);
    if (index)
        read(all[*index], "animation " + std::to_string(*index) + " '" + all[*index].name + "'");
}

void GltfAnimation::read(const tinygltf::Animation& animation, const std::string& where) {
    for (std::size_t i = 0; i < animation.channels.size(); ++i)
        read_channel(animation, animation.channels[i], where + ", channel " + std::to_string(i));
}

void GltfAnimation::read_channel(const tinygltf::Animation& animation,
                                 const tinygltf::AnimationChannel& channel,
                                 const std::string& where) {
    const std::string& path = channel.target_path;
    if (channel.target_node < 0)
        return; // of an extension
    const auto node = static_cast<std::size_t>(channel.target_node);
    if (node >= document_.model().nodes.size())
        document_.fail(where, "node " + std::to_string(channel.target_node) + " does not exist");
    if (channel.sampler < 0 ||
        static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
        document_.fail(where, "sampler " + std::to_string(channel.sampler) + " does not exist");
    if (path == "weights") {
        has_weights_ = true;
        return;
    }
    if (!document_.model().nodes[node].matrix.empty())
        document_.fail(where, "node " + std::to_string(node) + " has a matrix and cannot move");
    const tinygltf::AnimationSampler& sampler =
        animation.samplers[static_cast<std::size_t>(channel.sampler)];
    MotionNode& keys = tracks_[channel.target_node];
    if (path == "translation")
        read_track(sampler, where, keys.translation);
    else if (path == "rotation")
        read_track(sampler, where, keys.rotation);
    else if (path == "scale")
        read_track(sampler, where, keys.scale);
    else
        document_.fail(where, "nothing of a node is called '" + path + "'");
}

std::vector<float> GltfAnimation::frames(int accessor, const std::string& where) {
    std::vector<float> times = document_.floats(accessor, 1, where);
    if (times.empty())
        document_.fail(where, "it has no keys");
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] *= frame_rate_;
        if (!(times[i] >= 0.0f && std::isfinite(times[i])))
            document_.fail(where, "the time of key " + std::to_string(i) + " is no time");
        if (i > 0 && !(times[i] > times[i - 1]))
            document_.fail(where, "the time of key " + std::to_string(i) +
                                      " is not after that of the key before");
    }
    last_frame_ = std::max(last_frame_, times.back());
    return times;
}

template <typename T>
void GltfAnimation::read_track(const tinygltf::AnimationSampler& sampler, const std::string& where,
                               Track<T>& track) {
    constexpr int kComponents = std::is_same_v<T, glm::quat> ? 4 : 3;
    if (!track.frames.empty())
        document_.fail(where, "an earlier channel moves the same part of the node");
    const std::string& kind = sampler.interpolation;
    if (!kind.empty() && kind != "LINEAR" && kind != "STEP" && kind != "CUBICSPLINE")
        document_.fail(where, "'" + kind + "' is no interpolation");
    track.interpolation = kind == "STEP"          ? Interpolation::step
                          : kind == "CUBICSPLINE" ? Interpolation::cubic
                                                  : Interpolation::linear;
    const bool cubic = track.interpolation == Interpolation::cubic;
    track.frames = frames(sampler.input, where);
    const std::vector<float> values = document_.floats(sampler.output, kComponents, where);
    const std::size_t count = values.size() / kComponents;
    if (count != track.frames.size() * (cubic ? 3 : 1))
        document_.fail(where, std::to_string(count) + " values for " +
                                  std::to_string(track.frames.size()) + " keys" +
                                  (cubic ? " of three each" : ""));
    keys_ += count;
    if (keys_ > kMaxKeys)
        document_.fail(where, "there are more than " + std::to_string(kMaxKeys) + " values");
    for (std::size_t i = 0; i < count; ++i) {
        T value = value_of(&values[i * kComponents], T());
        for (int c = 0; c < kComponents; ++c)
            if (!std::isfinite(values[i * kComponents + static_cast<std::size_t>(c)]))
                document_.fail(where, "value " + std::to_string(i) + " is not finite");
        if (cubic && i % 3 != 1) // a tangent, in seconds
            value = value * (1.0f / frame_rate_);
        track.values.push_back(value);
    }
}

MotionNode GltfAnimation::node(int index) const {
    const auto found = tracks_.find(index);
    MotionNode node = found == tracks_.end() ? MotionNode{} : found->second;
    node.rest = rest_of(document_.model().nodes[static_cast<std::size_t>(index)], document_,
                        "node " + std::to_string(index));
    return node;
}

} // namespace macula::scene
