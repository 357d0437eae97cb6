/// What the scores look at: pictures of linear light, and maps of one number a pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace macula::metric {

/// Linear RGB with the primaries of sRGB, rows from the top, three floats a pixel; 1 is the
/// display's white. All values are finite.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgb;

    std::size_t pixels() const { return std::size_t{width} * height; }
};

/// One float a pixel, rows from the top: errors, eccentricities in degrees, pixels per degree.
struct ScalarMap {
    std::uint32_t width = 0, height = 0;
    std::vector<float> values;

    ScalarMap() = default;
    ScalarMap(std::uint32_t w, std::uint32_t h, float value = 0.0f)
        : width(w), height(h), values(std::size_t{w} * h, value) {}
};

/// Pixels in one picture that the scores accept: 16384 x 16384 would need 12 GiB and more.
inline constexpr std::size_t kMaxPixels = std::size_t{1} << 26;

/// Throws std::invalid_argument when a picture is empty, larger than kMaxPixels, not of the size it
/// claims, or holds a value that is not finite; or when the two differ in size.
void check(const Picture& picture);
void check_pair(const Picture& reference, const Picture& test);
/// Throws std::invalid_argument when the map has not the picture's size.
void check_map(const Picture& picture, const ScalarMap& map, const char* what);

} // namespace macula::metric
