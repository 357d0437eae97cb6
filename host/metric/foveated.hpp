/// Scores that know where the eye looks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/metric/picture.hpp"
#include "host/metric/pool.hpp"
#include "scenes/display.hpp"

namespace macula::metric {

/// Degrees between every pixel's direction and the gaze (head space). The display has the picture's
/// size. Deterministic.
ScalarMap eccentricity_map(const scene::Display& display, scene::Eye eye, const glm::dvec3& gaze);

/// Pixels per degree at every pixel of the display: a tangent plane's density grows off its axis.
ScalarMap density_map(const scene::Display& display, scene::Eye eye);

/// A display without curvature of any kind: `pixels_per_degree` at its centre, seen at a right
/// angle.
scene::Display flat_display(std::uint32_t width, std::uint32_t height, double pixels_per_degree);

/// Pixels with `from` <= eccentricity < `to`, in degrees.
struct Band {
    std::string name;
    double from = 0.0, to = 180.0;
    bool contains(float eccentricity) const {
        return eccentricity >= static_cast<float>(from) && eccentricity < static_cast<float>(to);
    }
};

/// fovea (below 2.6 degrees; 5.2 in diameter, Wandell 1995 as in Weier et al. 2016), parafovea (to
/// 4.2), perifovea (to 9.2; both Polyak 1941 as in Sakurai 2016), far (beyond).
std::vector<Band> default_bands();

struct BandScore {
    Band band;
    std::size_t pixels = 0; // 0: the band lies outside the picture, and `errors` are all 0
    Pooled errors;
};

/// Pools a map of errors band by band. Throws std::invalid_argument when the sizes differ.
std::vector<BandScore> band_scores(const ScalarMap& errors, const ScalarMap& eccentricity,
                                   std::span<const Band> bands);

/// Eccentricity in degrees at which the finest visible detail is twice as coarse as at the gaze
/// (Geisler and Perry 1998: contrast threshold = 1/64 exp(0.106 f (e + 2.3) / 2.3)).
inline constexpr double kHalfResolutionEccentricity = 2.3;

/// FLIP whose filters widen with eccentricity: at e degrees they are those of the gaze for detail
/// finer by 1 + e / 2.3 (docs/metrics.md). Equals flip() where the eccentricity is 0 and the
/// density the same everywhere. `density`: pixels per degree. Throws as flip does.
ScalarMap foveated_flip(const Picture& reference, const Picture& test,
                        const ScalarMap& eccentricity, const ScalarMap& density);

} // namespace macula::metric
