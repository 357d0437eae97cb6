#include "host/selftest/selftest.hpp"

#include "host/render/renderer.hpp"
#include "host/selftest/scene.hpp"

#include <fmt/format.h>

namespace macula::selftest {
namespace {

// XXH3 of the colour bits of the frames below. They change only when a change to the engine is
// meant to change pixels, and then in the same commit.
constexpr const char* kExpectedArea = "794aca76a5effd7e";
constexpr const char* kExpectedOcclusion = "e79edd2a76fd4c4b";

std::string hash_of(const compute::Device& device, frame::LightMode lights) {
    render::Options options;
    options.width = 48;
    options.height = 32;
    options.lights = lights;
    scene::Scene scene = make_scene();
    render::Renderer renderer(device, scene, options);
    renderer.render(0);
    return renderer.hash();
}

} // namespace

Outcome check_frame(const compute::Device& device, kernel::Library& /*library*/) {
    const std::string area = hash_of(device, frame::LightMode::area);
    const std::string occlusion = hash_of(device, frame::LightMode::ambient_occlusion);
    if (area == kExpectedArea && occlusion == kExpectedOcclusion)
        return {"frame", true, fmt::format("hashes {} and {}", area, occlusion)};
    return {"frame", false,
            fmt::format("hashes {} (area lights) and {} (ambient occlusion), expected {} and {}",
                        area, occlusion, kExpectedArea, kExpectedOcclusion)};
}

} // namespace macula::selftest
