/// The scores of old habit. They look at what a display shows: sRGB-encoded values, clamped to
/// 0..1, not rounded.
#pragma once

#include "host/metric/picture.hpp"

namespace macula::metric {

/// Mean of the squared differences over all pixels and channels. Throws as check_pair does.
double mse(const Picture& reference, const Picture& test);

/// Decibels with a peak of 1; infinite when the mean squared error is 0.
double psnr(double mean_squared_error);

/// Wang et al. 2004: luma (BT.601 weights), Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01,
/// K2 = 0.03, averaged over the windows that lie in the picture. In pictures with less than 11 rows
/// or columns the window has the greatest odd size that fits. -1..1, 1 when identical.
double ssim(const Picture& reference, const Picture& test);

} // namespace macula::metric
