// Foveated FLIP against people: Weier et al. 2016 asked 15 of them about four foveal regions
// (Figures 6 and 7): artefacts of the small one were noticed, of the medium and large ones hardly,
// of full frames not.
#include <limits>

#include <gtest/gtest.h>

#include "host/metric/foveated.hpp"
#include "scenes/load.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

constexpr std::uint32_t kFrames = 6, kFirstCompared = 4; // the first frame is sampled whole
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Region {
    const char* name;
    float r0, r1, p_min;
};
// Section 4.2.1.
constexpr Region kRegions[] = {{"small", 5.0f, 10.0f, 0.01f},
                               {"medium", 10.0f, 20.0f, 0.05f},
                               {"large", 15.0f, 30.0f, 0.1f},
                               {"full", kInfinity, kInfinity, 1.0f}};

struct Float4 {
    float x, y, z, w;
};

// The DK2 with a sixth of its pixels along each side.
scene::Display dk2() {
    scene::Display display = scene::find_display("dk2");
    display.width = 197;
    display.height = 244;
    return display;
}

std::vector<metric::Picture> render(const scene::Scene& scene, const std::string& method,
                                    const Region& region) {
    static compute::Device device = compute::open();
    const scene::Display display = dk2();
    const scene::EyeView& eye = display.eye(scene::Eye::mono);
    WeierSetup setup;
    setup.method = method;
    setup.width = display.width;
    setup.height = display.height;
    setup.tangents =
        frame::Tangents{static_cast<float>(eye.tan_left), static_cast<float>(eye.tan_right),
                        static_cast<float>(eye.tan_up), static_cast<float>(eye.tan_down)};
    setup.weier.r0 = region.r0;
    setup.weier.r1 = region.r1;
    setup.weier.p_min = region.p_min;
    WeierFrames frames(device, scene, setup);
    std::vector<metric::Picture> pictures;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        frames.run(frame, frame::camera_on_path(scene, frame));
        if (frame < kFirstCompared)
            continue;
        metric::Picture picture{display.width, display.height, {}};
        for (const Float4& pixel : frames.read<Float4>("colour"))
            picture.rgb.insert(picture.rgb.end(), {pixel.x, pixel.y, pixel.z});
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

class WeierRanking : public ::testing::TestWithParam<const char*> {};

TEST_P(WeierRanking, OfFoveatedFlipIsThatOfTheUserStudy) {
    const scene::Scene scene = scene::load(GetParam());
    const scene::Display display = dk2();
    const metric::ScalarMap density = metric::density_map(display, scene::Eye::mono);
    const metric::ScalarMap eccentricity =
        metric::eccentricity_map(display, scene::Eye::mono, {0.0, 0.0, -1.0});
    const std::vector<metric::Picture> reference = render(scene, "full", kRegions[3]);
    double last = 1.0;
    for (const Region& region : kRegions) {
        const std::vector<metric::Picture> pictures = render(scene, "weier", region);
        double mean = 0.0;
        for (std::size_t i = 0; i < pictures.size(); ++i)
            mean +=
                metric::pool(
                    metric::foveated_flip(reference[i], pictures[i], eccentricity, density).values)
                    .mean /
                static_cast<double>(pictures.size());
        RecordProperty(region.name, std::to_string(mean));
        EXPECT_LT(mean, 0.98 * last) << region.name;
        last = mean;
    }
    EXPECT_EQ(last, 0.0) << "every pixel is sampled in every frame";
}

INSTANTIATE_TEST_SUITE_P(Scenes, WeierRanking, ::testing::Values("atrium", "tunnel_maps"),
                         [](const auto& scene) { return std::string(scene.param); });

} // namespace
