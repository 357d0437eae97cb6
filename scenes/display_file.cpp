#include <cmath>
#include <numbers>

#include "scenes/display_build.hpp"
#include "scenes/input.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {
namespace {

constexpr std::uint64_t kMaxFileBytes = 1 << 20;
constexpr double kMaxTangent = 1e3;
constexpr float kDefaultIpdMm = 63.0f;

// tan_SIDE, or SIDE_degrees for its angle.
double read_tangent(const TomlTable& table, const std::string& side) {
    const std::string tangent = "tan_" + side, degrees = side + "_degrees";
    const auto value = table.number(tangent, 1e-4, kMaxTangent);
    const auto angle = table.number(degrees, 0.01, 89.9);
    if (value.has_value() == angle.has_value())
        table.fail(tangent, "exactly one of '" + tangent + "' and '" + degrees + "' must be given");
    return value ? *value : std::tan(*angle * std::numbers::pi / 180.0);
}

Tangents read_tangents(const TomlTable& table) {
    return {read_tangent(table, "left"), read_tangent(table, "right"), read_tangent(table, "up"),
            read_tangent(table, "down")};
}

void read_headset(const TomlTable& root, const TomlTable& left, Display& display) {
    const double ipd = root.number("ipd_mm", 0.0, 200.0).value_or(kDefaultIpdMm) / 1000.0;
    const double cant = root.number("cant_degrees", -45.0, 45.0).value_or(0.0f);
    set_headset(display, read_tangents(left), ipd, cant);
    left.reject_unknown();
    if (const auto right = root.table("right")) {
        const Tangents t = read_tangents(*right);
        EyeView& view = display.eyes[static_cast<std::size_t>(Eye::right)];
        view.tan_left = t.left;
        view.tan_right = t.right;
        view.tan_up = t.up;
        view.tan_down = t.down;
        right->reject_unknown();
    }
}

void read_screen(const TomlTable& root, const TomlTable& screen, Display& display) {
    const double width = screen.required_number("width_mm", 1.0, 1e5) / 1000.0;
    const double distance = screen.required_number("distance_mm", 1.0, 1e5) / 1000.0;
    set_screen(display, width, distance,
               root.number("ipd_mm", 0.0, 200.0).value_or(kDefaultIpdMm) / 1000.0);
    for (const char* key : {"cant_degrees", "right"})
        if (root.has(key))
            root.fail(key, "only headsets (with [left]) have it");
    screen.reject_unknown();
}

void read_distortion(const TomlTable& root, Display& display) {
    const std::optional<TomlTable> table = root.table("distortion");
    if (!table)
        return;
    static constexpr const char* kColours[] = {"red", "green", "blue"};
    for (std::size_t colour = 0; colour < 3; ++colour)
        if (const auto k = table->numbers(kColours[colour], 8, -1e3, 1e3))
            display.distortion[colour] = *k;
        else if (const auto of_green = table->numbers("green", 8, -1e3, 1e3))
            display.distortion[colour] = *of_green;
    table->reject_unknown();
}

std::uint32_t pixels(const TomlTable& root, const char* key) {
    const std::optional<std::int64_t> value = root.integer(key, 1, 16384);
    if (!value)
        root.fail(key, "it is missing");
    return static_cast<std::uint32_t>(*value);
}

} // namespace

Display parse_display(const std::string& text, const std::string& file, bool json) {
    const TomlDocument document =
        json ? TomlDocument::from_json(text, file) : TomlDocument(text, file);
    const TomlTable root = document.root();
    Display display;
    display.name = root.string("name").value_or(std::filesystem::path(file).stem().string());
    display.source = root.string("source").value_or(file);
    display.width = pixels(root, "width");
    display.height = pixels(root, "height");
    display.refresh_hz = root.number("refresh_hz", 1.0, 10000.0).value_or(60.0f);
    const std::optional<TomlTable> left = root.table("left"), screen = root.table("screen");
    if (left.has_value() == screen.has_value())
        root.fail("left", "exactly one of [left] (a headset) and [screen] must be given");
    if (left)
        read_headset(root, *left, display);
    else
        read_screen(root, *screen, display);
    read_distortion(root, display);
    root.reject_unknown();
    try {
        check(display);
    } catch (const std::invalid_argument& error) {
        throw SceneError(file + ": " + error.what());
    }
    return display;
}

Display read_display(const std::filesystem::path& file) {
    return parse_display(read_file(file, kMaxFileBytes), file.string(),
                         file.extension() == ".json");
}

} // namespace macula::scene
