// A result of `macula bench quality` with something in every field.
#pragma once

#include "host/report/quality_case.hpp"

namespace macula::test {

inline report::QualityCase quality_case(const std::string& method = "weier") {
    report::QualityCase c;
    c.scene = "cornell";
    c.lights = "area";
    c.method = method;
    c.name = method + " medium";
    c.parameters.frc = "medium";
    c.parameters.r0 = 10.0;
    c.parameters.r1 = 20.0;
    c.width = 96;
    c.height = 80;
    c.frames = 3;
    c.segments = 2;
    c.warm_up = 1;
    c.reference_spp = 36;
    c.display = "dk2";
    c.gaze = "fixed \"</script><b>\" \xc3\xa9";
    c.device = "a device";
    c.clock = "device";
    c.time_ms = {2.0, 3.0, 4.0};
    c.stages = {{"trace camera rays", 1, {1.5, 1.6, 1.7}}};
    c.scores.flip = {0.1, 0.2, 0.05, 0.3, 0.9};
    c.scores.psnr = 31.5;
    c.scores.flicker_energy = 0.01;
    c.against_full.flip_inside_r0 = 0.015;
    c.bands = {{"fovea", 0.0, 5.0, 0.1, 0.02, 0.001, std::nullopt}};
    c.eccentricity = {{0.5, 1.5}, {0.1, 0.2}};
    c.series = {{0, 500, 501}, {2.0, 2.1, 2.2}, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05}, {}, {}};
    c.series.flicker_energy = {std::nullopt, std::nullopt, 0.01};
    c.series.instability = {std::nullopt, std::nullopt, -0.01};
    return c;
}

} // namespace macula::test
