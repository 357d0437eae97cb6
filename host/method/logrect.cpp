// Log-rectilinear foveation (Li et al. 2021, "A Log-Rectilinear Transformation for Foveated
// 360-Degree Video Streaming"); docs/methods/logrect.md says what that means for a ray tracer.
#include "host/method/method.hpp"

namespace macula::method {

frame::Graph make_logrect(const stage::Kit& kit, const Options& options) {
    stage::LogPolarOptions shape = options.log_polar;
    shape.alpha = shape.rect_alpha;
    return make_log_space({"logrect", "samples uniform in log-rectilinear space (Li et al. 2021)"},
                          kit, options, shape, true);
}

} // namespace macula::method
