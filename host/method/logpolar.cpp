// Kernel log-polar foveation (Mrad 2022, "Image Upscaling for Ray Traced Foveated Rendering");
// docs/methods/logpolar.md says what differs and why.
#include "host/method/method.hpp"

namespace macula::method {

frame::Graph make_logpolar(const stage::Kit& kit, const Options& options) {
    return make_log_space({"logpolar", "samples uniform in kernel log-polar space (Mrad 2022)"},
                          kit, options, options.log_polar, false);
}

} // namespace macula::method
