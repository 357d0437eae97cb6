#include "scenes/motion_keys.hpp"

#include <algorithm>
#include <cmath>

namespace macula::scene {
namespace {

enum class Blend : std::uint8_t { step, linear, smooth };

constexpr double kMaxFrame = 1e7, kMaxDegrees = 36000.0, kLeastScale = 1e-9, kMostScale = 1e9;
constexpr std::size_t kMaxKeys = std::size_t{1} << 20; // of a node's turns
constexpr float kLongestArc = 90.0f; // degrees between keys, which then take the way that is meant

// A rotation as it is written: as a quaternion, or as an angle about an axis.
struct Turn {
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    bool is_angle = false;
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; // unit length
    float degrees = 0.0f;
};

glm::quat about(const glm::vec3& axis, float degrees) {
    return glm::angleAxis(glm::radians(degrees), axis);
}

std::optional<glm::vec3> read_axis(const TomlTable& table) {
    const std::optional<glm::vec3> axis = table.vec3("axis");
    if (axis && !(glm::length(*axis) > 0.0f))
        table.fail("axis", "it has no length");
    return axis ? std::optional(glm::normalize(*axis)) : std::nullopt;
}

std::optional<Turn> read_turn(const TomlTable& table, const glm::vec3& usual_axis) {
    const std::optional<std::vector<double>> q = table.numbers("rotation", 4, -1.0, 1.0);
    const std::optional<float> degrees = table.number("degrees", -kMaxDegrees, kMaxDegrees);
    const glm::vec3 axis = read_axis(table).value_or(usual_axis);
    if (q && degrees)
        table.fail("degrees", "there is 'rotation', too");
    if (degrees)
        return Turn{about(axis, *degrees), true, axis, *degrees};
    if (!q)
        return std::nullopt;
    if (q->size() != 4)
        table.fail("rotation", "a quaternion [x, y, z, w] was expected");
    const glm::dquat given((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
    if (!(glm::length(given) > 1e-6))
        table.fail("rotation", "it has no length");
    return Turn{glm::quat(glm::normalize(given)), false, {}, 0.0f};
}

template <typename T>
void add_key(Track<T>& track, float frame, const T& value) {
    track.frames.push_back(frame);
    track.values.push_back(value);
}

// A turn of more than a quarter gets keys of its own in between: two alone would take the short
// way round.
void add_turn(const TomlTable& table, float frame, const Turn& turn,
              const std::optional<Turn>& last, MotionNode& node, Blend blend) {
    const float from = node.rotation.frames.empty() ? 0.0f : node.rotation.frames.back();
    const bool same_axis = last && last->is_angle && turn.is_angle && last->axis == turn.axis;
    const float degrees = same_axis ? turn.degrees - last->degrees : 0.0f;
    if (blend == Blend::smooth && std::fabs(degrees) >= 180.0f)
        table.fail("degrees", "smooth keys turn by less than 180 degrees each");
    const float arcs = blend == Blend::linear ? std::ceil(std::fabs(degrees) / kLongestArc) : 0.0f;
    if (node.rotation.frames.size() > kMaxKeys)
        table.fail("degrees",
                   "the turns of this node need more than " + std::to_string(kMaxKeys) + " keys");
    for (float i = 1.0f; i < arcs; ++i) {
        const float between = from + (frame - from) * (i / arcs);
        if (!(between > node.rotation.frames.back() && between < frame))
            table.fail("degrees", "too few frames for such a turn");
        add_key(node.rotation, between, about(turn.axis, last->degrees + degrees * (i / arcs)));
    }
    add_key(node.rotation, frame, turn.rotation);
}

// Catmull-Rom tangents; one-sided at the ends, unless the last key closes the round.
template <typename T>
void smooth(Track<T>& track, float period) {
    const std::size_t count = track.frames.size();
    if (count < 2) {
        track.interpolation = Interpolation::linear;
        return;
    }
    std::vector<T> keys = std::move(track.values);
    if constexpr (std::is_same_v<T, glm::quat>)
        for (std::size_t i = 1; i < count; ++i)
            if (glm::dot(keys[i - 1], keys[i]) < 0.0f)
                keys[i] = -keys[i];
    const auto slope = [&](std::size_t i, std::size_t j) {
        return (keys[j] - keys[i]) * (1.0f / (track.frames[j] - track.frames[i]));
    };
    const bool closed = keys.front() == keys.back() && count > 2 &&
                        track.frames.back() - track.frames.front() == period;
    const T around = ((keys[1] - keys[0]) + (keys[count - 1] - keys[count - 2])) *
                     (1.0f / (track.frames[1] - track.frames[0] + track.frames[count - 1] -
                              track.frames[count - 2]));
    track.interpolation = Interpolation::cubic;
    track.values.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const bool end = i == 0 || i + 1 == count;
        const T tangent = end && closed ? around
                          : i == 0      ? slope(0, 1)
                          : end         ? slope(i - 1, i)
                                        : slope(i - 1, i + 1);
        track.values.insert(track.values.end(), {tangent, keys[i], tangent});
    }
}

template <typename T>
void interpolate(Track<T>& track, Blend blend, float period) {
    track.interpolation = blend == Blend::step ? Interpolation::step : Interpolation::linear;
    if (blend == Blend::smooth)
        smooth(track, period);
}

} // namespace

void read_keys(const TomlTable& table, float period, MotionNode& node) {
    static constexpr KeyedValue<Blend> kBlends[] = {
        {"step", Blend::step}, {"linear", Blend::linear}, {"smooth", Blend::smooth}};
    const Blend blend = table.choice<Blend>("interpolation", kBlends).value_or(Blend::linear);
    const glm::vec3 axis = read_axis(table).value_or(glm::vec3(0, 1, 0));
    node.rest.translation = table.vec3("translation").value_or(glm::vec3(0.0f));
    node.rest.scale = table.factors("scale", kLeastScale, kMostScale).value_or(glm::vec3(1.0f));
    if (const std::optional<Turn> turn = read_turn(table, axis))
        node.rest.rotation = turn->rotation;
    std::optional<Turn> last;
    std::optional<float> last_frame;
    for (const TomlTable& key : table.tables("key")) {
        const float frame = key.required_number("frame", 0.0, kMaxFrame);
        if (last_frame && !(frame > *last_frame))
            key.fail("frame", "it must be greater than that of the key before");
        last_frame = frame;
        if (const auto translation = key.vec3("translation"))
            add_key(node.translation, frame, *translation);
        if (const auto scale = key.factors("scale", kLeastScale, kMostScale))
            add_key(node.scale, frame, *scale);
        if (const std::optional<Turn> turn = read_turn(key, axis)) {
            add_turn(key, frame, *turn, last, node, blend);
            last = turn;
        }
        key.reject_unknown();
    }
    interpolate(node.translation, blend, period);
    interpolate(node.rotation, blend, period);
    interpolate(node.scale, blend, period);
}

} // namespace macula::scene
