#include "host/metric/picture.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace macula::metric {

void check(const Picture& picture) {
    const std::size_t pixels = picture.pixels();
    if (pixels == 0 || pixels > kMaxPixels)
        throw std::invalid_argument(fmt::format("{} x {} pixels: 1 to {} pixels were expected",
                                                picture.width, picture.height, kMaxPixels));
    if (picture.rgb.size() != 3 * pixels)
        throw std::invalid_argument(fmt::format("{} values, {} x {} x 3 were expected",
                                                picture.rgb.size(), picture.width, picture.height));
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        if (!std::isfinite(picture.rgb[i]))
            throw std::invalid_argument(
                fmt::format("pixel ({}, {}) is {}", i / 3 % picture.width, i / 3 / picture.width,
                            std::isnan(picture.rgb[i]) ? "not a number" : "infinite"));
    }
}

void check_pair(const Picture& reference, const Picture& test) {
    check(reference);
    check(test);
    if (reference.width != test.width || reference.height != test.height)
        throw std::invalid_argument(fmt::format("the sizes differ: {} x {} and {} x {} pixels",
                                                reference.width, reference.height, test.width,
                                                test.height));
}

void check_map(const Picture& picture, const ScalarMap& map, const char* what) {
    if (map.width != picture.width || map.height != picture.height ||
        map.values.size() != picture.pixels())
        throw std::invalid_argument(
            fmt::format("{}: {} values of {} x {} for a picture of {} x {} pixels", what,
                        map.values.size(), map.width, map.height, picture.width, picture.height));
}

} // namespace macula::metric
