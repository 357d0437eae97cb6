#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "host/metric/flip.hpp"
#include "host/metric/flip_window.hpp"
#include "host/metric/foveated.hpp"

namespace macula::metric {
namespace {

/// FLIP is computed at densities of base * 2^(level / 2), and a pixel's error interpolated between
/// the two levels next to its own density.
constexpr double kLevelsPerOctave = 2.0;
/// From this density on the picture is halved first, whose own blur hardly widens filters that are
/// then at least 1.5 pixels wide (sigma): on rendered frames means move by 0.1 %.
constexpr double kHalvingDensity = 200.0;

/// Pixels per degree of the gaze whose filters the pixel sees, as levels above `base`.
struct Levels {
    double base = 0.0;
    ScalarMap position;
    int count = 0;
};

Levels levels_of(const ScalarMap& eccentricity, const ScalarMap& density) {
    Levels levels{0.0, ScalarMap(eccentricity.width, eccentricity.height), 0};
    std::vector<float>& position = levels.position.values;
    for (std::size_t i = 0; i < position.size(); ++i) {
        const double e = eccentricity.values[i], d = density.values[i];
        if (!(e >= 0.0 && e <= 180.1))
            throw std::invalid_argument(fmt::format("an eccentricity of {} degrees", e));
        check_density(d);
        position[i] = static_cast<float>(
            std::min(d * (1.0 + e / kHalfResolutionEccentricity), kMaxPixelsPerDegree));
    }
    levels.base = *std::min_element(position.begin(), position.end());
    float highest = 0.0f;
    for (float& p : position) {
        p = static_cast<float>(kLevelsPerOctave * std::log2(p / levels.base));
        highest = std::max(highest, p);
    }
    levels.count = static_cast<int>(std::floor(highest)) + 2;
    return levels;
}

/// A tent around each level.
float weight(float position, int level) {
    return std::max(0.0f, 1.0f - std::fabs(position - static_cast<float>(level)));
}

/// The pixels of which a level is a part; an empty window where there are none.
Window window_of(const ScalarMap& position, int level) {
    Window w{position.width, position.height, 0, 0};
    for (std::uint32_t y = 0; y < position.height; ++y) {
        for (std::uint32_t x = 0; x < position.width; ++x) {
            if (weight(position.values[std::size_t{y} * position.width + x], level) > 0.0f)
                w = {std::min(w.x0, x), std::min(w.y0, y), std::max(w.x1, x + 1),
                     std::max(w.y1, y + 1)};
        }
    }
    return w.x1 == 0 ? Window{} : w;
}

Plane halved(const Plane& in) {
    Plane out((in.width + 1) / 2, (in.height + 1) / 2);
    tbb::parallel_for(std::uint32_t{0}, out.height, [&](std::uint32_t y) {
        const float* above = in.row(2 * y);
        const float* below = in.row(std::min(2 * y + 1, in.height - 1));
        for (std::uint32_t x = 0; x < out.width; ++x) {
            const std::uint32_t left = 2 * x, right = std::min(left + 1, in.width - 1);
            out.row(y)[x] = 0.25f * ((above[left] + above[right]) + (below[left] + below[right]));
        }
    });
    return out;
}

Opponent halved(const Opponent& in) {
    return {halved(in.y), halved(in.cx), halved(in.cz), halved(in.lightness)};
}

/// Errors of a part of a picture that was halved `halvings` times, read at full resolution.
class LevelErrors {
  public:
    LevelErrors(const Opponent& reference, const Opponent& test, double density, int halvings,
                const Window& window)
        : scale_(std::ldexp(1.0f, -halvings)) {
        const auto shift = static_cast<std::uint32_t>(halvings);
        const auto low = [&](std::uint32_t x) { return (x >> shift) - ((x >> shift) != 0); };
        const auto high = [&](std::uint32_t x, std::uint32_t end) {
            return std::min((x >> shift) + 2, end);
        };
        window_ = halvings == 0
                      ? window
                      : Window{low(window.x0), low(window.y0), high(window.x1, reference.y.width),
                               high(window.y1, reference.y.height)};
        errors_ = flip_window(reference, test, std::ldexp(density, -halvings), window_);
    }

    float at(std::uint32_t x, std::uint32_t y) const {
        if (scale_ == 1.0f)
            return errors_.row(y - window_.y0)[x - window_.x0];
        const Between h(x, scale_, window_.x0, errors_.width);
        const Between v(y, scale_, window_.y0, errors_.height);
        const float* above = errors_.row(v.first);
        const float* below = errors_.row(v.second);
        return v.mix(h.mix(above[h.first], above[h.second]),
                     h.mix(below[h.first], below[h.second]));
    }

  private:
    /// Two samples and the way from the first to the second.
    struct Between {
        std::uint32_t first, second;
        float fraction;
        Between(std::uint32_t i, float scale, std::uint32_t origin, std::uint32_t count) {
            const float p = std::clamp((static_cast<float>(i) + 0.5f) * scale - 0.5f -
                                           static_cast<float>(origin),
                                       0.0f, static_cast<float>(count - 1));
            first = static_cast<std::uint32_t>(p);
            second = std::min(first + 1, count - 1);
            fraction = p - static_cast<float>(first);
        }
        float mix(float a, float b) const { return a + (b - a) * fraction; }
    };

    float scale_;
    Window window_;
    Plane errors_;
};

void accumulate(ScalarMap& errors, const Levels& levels, int level, const Window& window,
                const LevelErrors& of_level) {
    tbb::parallel_for(window.y0, window.y1, [&](std::uint32_t y) {
        for (std::uint32_t x = window.x0; x < window.x1; ++x) {
            const std::size_t i = std::size_t{y} * errors.width + x;
            const float w = weight(levels.position.values[i], level);
            if (w > 0.0f)
                errors.values[i] += w * of_level.at(x, y);
        }
    });
}

} // namespace

ScalarMap foveated_flip(const Picture& reference, const Picture& test,
                        const ScalarMap& eccentricity, const ScalarMap& density) {
    check_pair(reference, test);
    check_map(reference, eccentricity, "eccentricities");
    check_map(reference, density, "densities");
    const Levels levels = levels_of(eccentricity, density);
    Opponent r(reference), t(test);
    int halvings = 0;
    ScalarMap errors(reference.width, reference.height);
    for (int level = 0; level < levels.count; ++level) {
        const Window window = window_of(levels.position, level);
        const double at = levels.base * std::exp2(level / kLevelsPerOctave);
        while (level > 0 && std::ldexp(at, -halvings) >= kHalvingDensity) {
            r = halved(r);
            t = halved(t);
            ++halvings;
        }
        if (window.x1 != 0)
            accumulate(errors, levels, level, window, {r, t, at, halvings, window});
    }
    return errors;
}

} // namespace macula::metric
