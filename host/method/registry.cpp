#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "host/method/method.hpp"

namespace macula::method {
namespace {

constexpr std::array kMethods = {
    Method{"full", "every pixel, any samples per pixel", make_full},
    Method{"full+upscale", "the same at fewer pixels, enlarged over frames", make_full, false,
           true},
    Method{"logpolar", "samples uniform in kernel log-polar space (Mrad 2022)", make_logpolar},
    Method{"logpolar+taa", "the same, smoothed over frames", make_logpolar, true, false},
    Method{"logpolar+upscale", "the same at fewer pixels, enlarged over frames", make_logpolar,
           false, true},
    Method{"logpolar+taa+upscale", "the same at fewer pixels, smoothed and enlarged over frames",
           make_logpolar, true, true},
    Method{"logrect", "samples uniform in log-rectilinear space (Li et al. 2021)", make_logrect},
    Method{"logrect+taa", "the same, smoothed over frames", make_logrect, true, false},
    Method{"logrect+upscale", "the same at fewer pixels, enlarged over frames", make_logrect, false,
           true},
    Method{"logrect+taa+upscale", "the same at fewer pixels, smoothed and enlarged over frames",
           make_logrect, true, true},
    Method{"lowres", "uniform lower resolution, enlarged by a bicubic filter", make_lowres},
    Method{"lowres_rings", "blocks of pixels that grow in rings around the gaze, blurred",
           make_lowres_rings},
    Method{"rrm", "the fovea in every frame, the rest in turns (Smith et al. 2014)", make_rrm},
    Method{"weier", "foveated samples and a reprojected cache (Weier et al. 2016)", make_weier},
    Method{"weier+upscale", "the same at fewer pixels, enlarged over frames", make_weier, false,
           true},
};

} // namespace

bool Method::foveates() const {
    return base != make_full && base != make_lowres;
}

std::span<const Method> methods() {
    return kMethods;
}

const Method& find_method(std::string_view name) {
    std::string known;
    for (const Method& method : kMethods) {
        if (method.name == name)
            return method;
        known += known.empty() ? "" : ", ";
        known += method.name;
    }
    throw std::invalid_argument(fmt::format("there is no method \"{}\"; there is {}", name, known));
}

} // namespace macula::method
