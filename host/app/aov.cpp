#include "host/app/aov.hpp"

#include <stdexcept>

namespace macula::app {

std::span<const Aov> aovs() {
    static const std::vector<Aov> all = {
        {"albedo", "albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}},
        {"irradiance", "irradiance", {"Irradiance.R", "Irradiance.G", "Irradiance.B"}},
        {"ao", "ambient occlusion", {"AmbientOcclusion"}},
        {"depth", "depth", {"Z"}},
        {"position", "position", {"P.X", "P.Y", "P.Z"}},
        {"normal", "geometric normal", {"N.X", "N.Y", "N.Z"}},
        {"shading_normal", "shading normal", {"Ns.X", "Ns.Y", "Ns.Z"}},
        {"triangle", "triangle", {"Triangle"}},
        {"material", "material", {"Material"}},
        {"motion", "motion", {"Motion.X", "Motion.Y"}},
        {"reprojected", "reprojected colour", {"Reprojected.R", "Reprojected.G", "Reprojected.B"}},
        {"support", "support colour", {"Support.R", "Support.G", "Support.B"}},
        {"sampling", "sampling", {"Sampling"}},
        {"resampling", "resampling", {"Resampling"}},
        {"age", "cache age", {"Age"}},
        {"rho", "rho", {"Rho"}},
    };
    return all;
}

const Aov& find_aov(const std::string& name) {
    std::string known;
    for (const Aov& aov : aovs()) {
        if (aov.name == name)
            return aov;
        known += (known.empty() ? "" : ", ") + std::string(aov.name);
    }
    throw std::invalid_argument("there is no AOV \"" + name + "\" (known: " + known + ")");
}

} // namespace macula::app
