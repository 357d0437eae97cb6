#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "host/metric/flip.hpp"
#include "host/metric/flip_window.hpp"

namespace macula::metric {
namespace {

/// Of the display's white: where the pixel that bounds the exposures comes to lie (Andersson et al.
/// 2021, section 3).
constexpr double kBright = 0.85;
constexpr unsigned kMaxExposures = 512;

/// (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5).
struct Curve {
    double k[6];
    float operator()(float x) const {
        const auto at = [&](int i) { return static_cast<float>(k[i]); };
        return ((at(0) * x + at(1)) * x + at(2)) / ((at(3) * x + at(4)) * x + at(5));
    }
};

const Curve& curve_of(ToneMapper tone_mapper) {
    // Narkowicz's fit of ACES, at 0.6 of the exposure; Hable's curve with its white at 11.2.
    static const Curve aces{
        {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14}};
    static const Curve hable{{0.231683, 0.013791, 0.0, 0.18, 0.3, 0.018}};
    static const Curve reinhard{{0.0, 1.0, 0.0, 0.0, 1.0, 1.0}};
    switch (tone_mapper) {
    case ToneMapper::aces:
        return aces;
    case ToneMapper::hable:
        return hable;
    case ToneMapper::reinhard:
        break;
    }
    return reinhard;
}

float luminance(const float* rgb) {
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

/// Where the curve reaches kBright.
double bright_input(const Curve& curve) {
    const double a = curve.k[0] - kBright * curve.k[3], b = curve.k[1] - kBright * curve.k[4],
                 c = curve.k[2] - kBright * curve.k[5];
    if (a == 0.0)
        return -c / b;
    const double middle = -0.5 * (b / a);
    return middle + std::sqrt(middle * middle - c / a);
}

/// Reinhard's curve keeps the hue, the others map channel by channel.
Picture tone_mapped(const Picture& picture, double exposure, ToneMapper tone_mapper) {
    const auto scale = static_cast<float>(std::exp2(exposure));
    const Curve& curve = curve_of(tone_mapper);
    Picture result{picture.width, picture.height, std::vector<float>(picture.rgb.size())};
    const bool keeps_hue = tone_mapper == ToneMapper::reinhard;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        float rgb[3];
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = std::min(std::max(picture.rgb[i + c], 0.0f) * scale, 1e18f);
        const float factor = 1.0f / (1.0f + luminance(rgb));
        for (std::size_t c = 0; c < 3; ++c)
            result.rgb[i + c] = keeps_hue ? rgb[c] * factor : curve(rgb[c]);
    }
    return result;
}

void check(const Exposures& e) {
    if (!(std::isfinite(e.start) && std::isfinite(e.stop) && e.start <= e.stop && e.count >= 1 &&
          e.count <= kMaxExposures && (e.count >= 2 || e.start == e.stop)))
        throw std::invalid_argument(fmt::format("{} exposures from {} to {}: start <= stop and 2 "
                                                "to {} of them were expected",
                                                e.count, e.start, e.stop, kMaxExposures));
}

} // namespace

Exposures find_exposures(const Picture& reference, ToneMapper tone_mapper) {
    metric::check(reference);
    std::vector<float> luminances(reference.pixels());
    for (std::size_t i = 0; i < luminances.size(); ++i) {
        float rgb[3];
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = std::max(reference.rgb[3 * i + c], 0.0f);
        luminances[i] = luminance(rgb);
    }
    std::sort(luminances.begin(), luminances.end());
    const double brightest = luminances.back();
    // As the authors' evaluator: the upper of two middle values, never below the step of a float
    // at 1.
    const double median =
        std::max(luminances[luminances.size() / 2], std::numeric_limits<float>::epsilon());
    if (!(brightest > 0.0))
        return {0.0, 0.0, 1}; // black at every exposure
    const double bright = bright_input(curve_of(tone_mapper));
    Exposures result;
    result.start = std::log2(bright / brightest);
    result.stop = std::max(result.start, std::log2(bright / median));
    const double count = std::ceil(result.stop - result.start);
    result.count = static_cast<unsigned>(std::clamp(count, 2.0, double{kMaxExposures}));
    return result;
}

ScalarMap hdr_flip(const Picture& reference, const Picture& test, double pixels_per_degree,
                   const std::optional<Exposures>& exposures, ToneMapper tone_mapper) {
    check_pair(reference, test);
    check_density(pixels_per_degree);
    const Exposures e = exposures ? *exposures : find_exposures(reference, tone_mapper);
    check(e);
    ScalarMap worst(reference.width, reference.height);
    for (unsigned i = 0; i < e.count; ++i) {
        const double exposure =
            e.count == 1 ? e.start : e.start + i * ((e.stop - e.start) / (e.count - 1));
        const Plane errors =
            flip_window(Opponent(tone_mapped(reference, exposure, tone_mapper)),
                        Opponent(tone_mapped(test, exposure, tone_mapper)), pixels_per_degree,
                        {0, 0, reference.width, reference.height});
        std::transform(errors.values.begin(), errors.values.end(), worst.values.begin(),
                       worst.values.begin(), [](float a, float b) { return std::max(a, b); });
    }
    return worst;
}

} // namespace macula::metric
