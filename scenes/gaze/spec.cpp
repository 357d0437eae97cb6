#include "scenes/gaze/spec.hpp"

#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>

#include "scenes/gaze/recording.hpp"
#include "scenes/gaze/udp.hpp"
#include "scenes/text.hpp"

namespace macula::scene {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& value,
                         const std::string& expected) {
    throw std::invalid_argument(what + " \"" + value + "\": " + expected);
}

bool parse_number(std::string_view text, double& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// "X,Y", nothing else.
bool parse_pair(std::string_view text, double& x, double& y) {
    const std::size_t comma = text.find(',');
    return comma != std::string_view::npos && parse_number(trimmed(text.substr(0, comma)), x) &&
           parse_number(trimmed(text.substr(comma + 1)), y);
}

// A key and where its number goes; whole numbers for seeds.
struct Setting {
    std::string_view key;
    double* number;
    std::uint64_t* whole = nullptr;
};

void set(const Setting& setting, std::string_view text, const std::string& what,
         const std::string& list) {
    if (setting.whole != nullptr) {
        const auto [end, error] =
            std::from_chars(text.data(), text.data() + text.size(), *setting.whole);
        if (error != std::errc() || end != text.data() + text.size())
            refuse(what, list, std::string(setting.key) + " must be a whole number");
    } else if (!parse_number(text, *setting.number)) {
        refuse(what, list, std::string(setting.key) + " must be a number");
    }
}

// "key=value,key=value".
void parse_list(const std::string& what, const std::string& list,
                std::span<const Setting> settings) {
    std::string_view rest = list;
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view item = rest.substr(0, comma);
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
        const std::size_t equals = item.find('=');
        std::string known;
        bool found = false;
        for (const Setting& setting : settings) {
            known += (known.empty() ? "" : ", ") + std::string(setting.key);
            if (equals == std::string_view::npos || item.substr(0, equals) != setting.key)
                continue;
            set(setting, item.substr(equals + 1), what, list);
            found = true;
        }
        if (!found) {
            std::string expected("'");
            expected.append(item).append("' is not KEY=VALUE with one of the keys ").append(known);
            refuse(what, list, expected);
        }
    }
}

GazePointer parse_target(const std::string& list, const GazeContext& context) {
    TargetOptions o;
    o.left_eye = context.display.eye(Eye::left).offset;
    o.right_eye = context.display.eye(Eye::right).offset;
    const Setting settings[] = {{"seed", nullptr, &o.seed},
                                {"speed", &o.speed},
                                {"width", &o.half_width},
                                {"height", &o.half_height},
                                {"window", &o.depth_window_ms}};
    parse_list("gaze target", list, settings);
    return moving_target(o, context.depth);
}

GazePointer parse_synthetic(const std::string& list) {
    ObserverOptions o;
    const Setting settings[] = {{"seed", nullptr, &o.seed},
                                {"fixation", &o.fixation_ms},
                                {"spread", &o.spread_degrees},
                                {"limit", &o.limit_degrees},
                                {"blinks", &o.blinks_per_minute}};
    parse_list("gaze synthetic", list, settings);
    return synthetic_observer(o);
}

GazePointer parse_trace(std::string file) {
    constexpr std::string_view kRepeat = ":repeat";
    AtEnd at_end = AtEnd::hold;
    if (file.ends_with(kRepeat)) {
        file.resize(file.size() - kRepeat.size());
        at_end = AtEnd::repeat;
    }
    return recorded_gaze(read_gaze_csv(file), at_end);
}

GazePointer parse_udp(const std::string& text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size() || port == 0)
        refuse("gaze udp", text, "a port from 1 to 65535 was expected");
    return std::make_unique<UdpGaze>(port);
}

GazePointer parse_pixel(const std::string& text, const GazeContext& context) {
    double x = 0.0, y = 0.0;
    if (!parse_pair(text, x, y) || !(x >= 0.0 && x <= context.display.width) ||
        !(y >= 0.0 && y <= context.display.height))
        refuse("gaze pixel", text,
               "X,Y within " + std::to_string(context.display.width) + " x " +
                   std::to_string(context.display.height) + " pixels was expected");
    return fixed_gaze(pixel_direction(context.display, context.eye, x, y));
}

} // namespace

GazePointer parse_gaze(const std::string& spec, const GazeContext& context) {
    double right = 0.0, up = 0.0;
    if (parse_pair(spec, right, up)) {
        if (!(std::fabs(right) <= 180.0 && std::fabs(up) <= 90.0))
            refuse("gaze", spec, "X must be -180 to 180 degrees and Y -90 to 90");
        return fixed_gaze(direction_of_angles(right, up));
    }
    if (spec == "centre")
        return fixed_gaze({0.0, 0.0, -1.0});
    const std::size_t colon = spec.find(':');
    const std::string kind = spec.substr(0, colon);
    const std::string rest = colon == std::string::npos ? "" : spec.substr(colon + 1);
    if (kind == "pixel")
        return parse_pixel(rest, context);
    if (kind == "target")
        return parse_target(rest, context);
    if (kind == "synthetic")
        return parse_synthetic(rest);
    if (kind == "udp")
        return parse_udp(rest);
    if (kind == "trace")
        return parse_trace(rest);
    if (spec.ends_with(".csv") || spec.ends_with(".csv:repeat"))
        return parse_trace(spec);
    refuse("gaze", spec,
           "X,Y in degrees, centre, pixel:X,Y, target, synthetic, FILE.csv, trace:FILE or "
           "udp:PORT was expected");
}

TrackerOptions parse_tracker(const std::string& list) {
    TrackerOptions o;
    const Setting settings[] = {{"latency", &o.latency_ms},  {"rate", &o.rate_hz},
                                {"noise", &o.noise_degrees}, {"quantum", &o.quantum_degrees},
                                {"dropout", &o.dropout},     {"dropout-ms", &o.dropout_ms},
                                {"smooth", &o.smooth_ms},    {"saccade", &o.saccade_degrees},
                                {"widen", &o.widening},      {"seed", nullptr, &o.seed}};
    parse_list("tracker", list, settings);
    return o;
}

} // namespace macula::scene
