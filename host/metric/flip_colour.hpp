/// Colour spaces of FLIP (Andersson et al. 2020, section 4.1), from linear RGB of sRGB's primaries.
#pragma once

#include <algorithm>
#include <cmath>

namespace macula::metric {

struct Colour {
    float x = 0.0f, y = 0.0f, z = 0.0f;
};

inline Colour xyz_of_rgb(const Colour& c) {
    constexpr float n1 = 24577794.0f, n2 = 12288897.0f, n3 = 73733382.0f;
    return {10135552.0f / n1 * c.x + 8788810.0f / n1 * c.y + 4435075.0f / n1 * c.z,
            2613072.0f / n2 * c.x + 8788810.0f / n2 * c.y + 887015.0f / n2 * c.z,
            1425312.0f / n3 * c.x + 8788810.0f / n3 * c.y + 70074185.0f / n3 * c.z};
}

inline Colour rgb_of_xyz(const Colour& c) {
    return {3.241003275f * c.x - 1.537398934f * c.y - 0.498615861f * c.z,
            -0.969224334f * c.x + 1.875930071f * c.y + 0.041554224f * c.z,
            0.055639423f * c.x - 0.204011202f * c.y + 1.057148933f * c.z};
}

/// White of D65: xyz_of_rgb of (1, 1, 1).
inline constexpr Colour kWhite{0.950428545f, 1.0f, 1.088900371f};

/// Linearised CIELAB: differences in it may be filtered.
inline Colour ycxcz_of_rgb(const Colour& rgb) {
    const Colour c = xyz_of_rgb(rgb);
    const float x = c.x / kWhite.x, y = c.y, z = c.z / kWhite.z;
    return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

inline Colour rgb_of_ycxcz(const Colour& c) {
    const float y = (c.x + 16.0f) / 116.0f;
    return rgb_of_xyz({(y + c.y / 500.0f) * kWhite.x, y * kWhite.y, (y - c.z / 200.0f) * kWhite.z});
}

/// The curve of CIELAB.
inline float lab_curve(float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

/// CIELAB whose chroma fades with lightness (Hunt's effect).
inline Colour hunt_lab_of_rgb(const Colour& rgb) {
    const Colour c = xyz_of_rgb(rgb);
    const float x = lab_curve(c.x / kWhite.x), y = lab_curve(c.y), z = lab_curve(c.z / kWhite.z);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

/// Distance for large differences (Abasi et al. 2020).
inline float hyab(const Colour& a, const Colour& b) {
    const float da = a.y - b.y, db = a.z - b.z;
    return std::fabs(a.x - b.x) + std::sqrt(da * da + db * db);
}

inline Colour clamped(const Colour& c) {
    return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
}

} // namespace macula::metric
