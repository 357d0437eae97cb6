// Pictures for the tests of scores.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "host/metric/picture.hpp"

namespace macula::test {

inline metric::Picture plain(std::uint32_t width, std::uint32_t height, float r, float g, float b) {
    metric::Picture picture{width, height, {}};
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        picture.rgb.insert(picture.rgb.end(), {r, g, b});
    return picture;
}

inline metric::Picture noise(std::uint32_t width, std::uint32_t height, unsigned seed,
                             float scale = 1.0f) {
    std::minstd_rand random(seed);
    metric::Picture picture{width, height, std::vector<float>(std::size_t{width} * height * 3)};
    for (float& value : picture.rgb)
        value = scale * static_cast<float>(random() % 4096) / 4095.0f;
    return picture;
}

// Stripes of fine and coarse detail, everywhere alike.
inline metric::Picture texture(std::uint32_t width, std::uint32_t height) {
    metric::Picture picture{width, height, std::vector<float>(std::size_t{width} * height * 3)};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const bool fine = (x / 2 + y / 2) % 2 != 0, coarse = (x / 9 + y / 7) % 2 != 0;
            float* rgb = &picture.rgb[3 * (std::size_t{y} * width + x)];
            rgb[0] = 0.1f + 0.5f * static_cast<float>(fine);
            rgb[1] = 0.2f + 0.3f * static_cast<float>(coarse);
            rgb[2] = 0.3f + 0.2f * static_cast<float>(fine && coarse);
        }
    }
    return picture;
}

// Replaces the square of 2 radius + 1 pixels around (cx, cy) by its blur over 7 x 7 pixels.
inline metric::Picture blurred_at(const metric::Picture& in, int cx, int cy, int radius) {
    metric::Picture out = in;
    for (int y = cy - radius; y <= cy + radius; ++y) {
        for (int x = cx - radius; x <= cx + radius; ++x) {
            for (int c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (int dy = -3; dy <= 3; ++dy) {
                    for (int dx = -3; dx <= 3; ++dx) {
                        const int sx = std::clamp(x + dx, 0, static_cast<int>(in.width) - 1);
                        const int sy = std::clamp(y + dy, 0, static_cast<int>(in.height) - 1);
                        sum += in.rgb[static_cast<std::size_t>(
                            3 * (sy * static_cast<int>(in.width) + sx) + c)];
                    }
                }
                out.rgb[static_cast<std::size_t>(3 * (y * static_cast<int>(in.width) + x) + c)] =
                    sum / 49.0f;
            }
        }
    }
    return out;
}

} // namespace macula::test
