// Method `full` as a whole: identical bits, ray counts, samples, materials, errors.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "host/method/method.hpp"
#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;
using testing::HasSubstr;
using testing::ThrowsMessage;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

render::Options options(LightMode lights) {
    render::Options o;
    o.width = 70;
    o.height = 50;
    o.lights = lights;
    return o;
}

std::string words_of(const render::Image& image) {
    return {reinterpret_cast<const char*>(image.words.data()), image.words.size_bytes()};
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, EveryVariantGivesTheSameBits) {
    std::string expected;
    for (const kernel::Variant& variant : kernel::variants()) {
        const kernel::DeviceTraits traits = kernel::traits_of(device());
        if (!kernel::why_not(variant, traits, kernel::RayClass::primary).empty())
            continue;
        render::Options o = options(GetParam());
        o.variant = variant.name;
        render::Renderer renderer(device(), cornell(), o);
        renderer.render(0);
        if (expected.empty())
            expected = renderer.hash();
        EXPECT_EQ(renderer.hash(), expected) << variant.name;
    }
    EXPECT_FALSE(expected.empty());
}

TEST_P(EachMode, OneAndSixteenLanesGiveTheSameBits) {
    for (const char* name : {"cornell", "whitted", "atrium"}) {
        const scene::Scene scene = scene::load(name);
        std::vector<std::string> hashes;
        for (const std::uint32_t lanes : {1u, 16u}) {
            render::Options o = options(GetParam());
            o.lanes = lanes;
            o.images = {"albedo", "shading normal", "motion"};
            render::Renderer renderer(device(), scene, o);
            renderer.render(0);
            for (const char* image : {"colour", "albedo", "shading normal", "motion"})
                hashes.push_back(words_of(renderer.map(image)));
        }
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_TRUE(hashes[i] == hashes[i + 4]) << name << ", image " << i;
    }
}

TEST_P(EachMode, TheSameFrameTwiceGivesTheSameBits) {
    render::Renderer renderer(device(), cornell(), options(GetParam()));
    renderer.render(3);
    const std::string first = renderer.hash();
    renderer.render(4);
    const std::string other = renderer.hash();
    renderer.render(3);
    EXPECT_EQ(renderer.hash(), first);
    EXPECT_NE(other, first);
    render::Options o = options(GetParam());
    render::Renderer again(device(), cornell(), o);
    again.render(3);
    EXPECT_EQ(again.hash(), first);
}

TEST_P(EachMode, EveryValueIsFinite) {
    render::Options o = options(GetParam());
    o.samples_per_pixel = 2;
    for (const render::ImageFormat& format : render::image_formats()) {
        const std::string name = format.name;
        if (name == "reprojected colour")
            break; // from here on they are those of method weier
        const bool occlusion = GetParam() == LightMode::ambient_occlusion;
        if (name != "lens image" && name != (occlusion ? "irradiance" : "ambient occlusion"))
            o.images.push_back(name);
    }
    render::Renderer renderer(device(), cornell(), o);
    renderer.render(0);
    for (const std::string& name : o.images)
        for (const float value : renderer.map(name).floats)
            ASSERT_TRUE(std::isfinite(value)) << name;
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::area, LightMode::soft,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

// Inside a closed box every primary ray hits, and every point faces the light in its middle.
scene::Scene closed_box() {
    scene::Mesh mesh = icosphere(0);
    scene::Scene scene = scene_of(std::move(mesh), {{0.1f, 0, 0}, {0, 0.2f, -1}});
    scene.lights.emplace_back();
    scene.lights[0].radius = 0.05f;
    scene.lights[0].position = {0, 0.1f, 0};
    return scene;
}

TEST(RayCounts, AreThoseOfThePapersTable) {
    const std::map<LightMode, std::uint64_t> rays{{LightMode::point, 2},
                                                  {LightMode::area, 9},
                                                  {LightMode::soft, 4},
                                                  {LightMode::ambient_occlusion, 17}};
    for (const auto& [mode, per_pixel] : rays) {
        render::Renderer renderer(device(), closed_box(), options(mode));
        EXPECT_EQ(renderer.render(0).total_rays(), per_pixel * 70 * 50);
        EXPECT_EQ(renderer.render(1).total_rays(), per_pixel * 70 * 50);
    }
}

TEST(Batches, AQueueOfSeveralBatchesIsWhole) {
    // 300 x 300 pixels with 16 rays each: a batch holds 2^20 rays.
    render::Options o = options(LightMode::ambient_occlusion);
    o.width = o.height = 300;
    o.ambient_occlusion_radius = 10.0f;
    render::Renderer renderer(device(), closed_box(), o);
    const render::FrameReport report = renderer.render(0);
    EXPECT_EQ(report.total_rays(), 17u * 300 * 300);
    for (const frame::StageTime& stage : report.stages) {
        if (stage.stage == "trace ambient occlusion rays") {
            EXPECT_GT(stage.launches, 1u);
        }
    }
    // Closed: nothing is open.
    const render::Image colour = renderer.map("colour");
    for (std::uint32_t i = 0; i < pixels(colour); ++i)
        ASSERT_EQ(at(colour, i), glm::dvec3(0.0));
}

TEST(Samples, MoreSamplesConvergeOnTheSameMean) {
    const auto mean_of = [](std::uint32_t samples) {
        render::Options o = options(LightMode::area);
        o.samples_per_pixel = samples;
        render::Renderer renderer(device(), cornell(), o);
        renderer.render(0);
        const render::Image colour = renderer.map("colour");
        glm::dvec3 sum(0.0);
        for (std::uint32_t i = 0; i < pixels(colour); ++i)
            sum += at(colour, i);
        return sum / double(pixels(colour));
    };
    const glm::dvec3 few = mean_of(5), many = mean_of(36);
    EXPECT_LT(glm::length(few - many), 0.01 * glm::length(many));
}

// Each sample of the regular grid is a pixel of the picture twice as wide and high.
TEST(Samples, OfARegularGridAreTheFinerPicturesPixels) {
    render::Options o = options(LightMode::point);
    o.samples_per_pixel = 4;
    render::Renderer coarse(device(), cornell(), o);
    coarse.render(0);
    o.samples_per_pixel = 1;
    o.width *= 2;
    o.height *= 2;
    render::Renderer fine(device(), cornell(), o);
    fine.render(0);
    const render::Image a = coarse.map("colour"), b = fine.map("colour");
    for (std::uint32_t y = 0; y < a.height; ++y)
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const std::uint32_t first = 2 * y * b.width + 2 * x;
            const glm::dvec3 mean = (at(b, first) + at(b, first + 1) + at(b, first + b.width) +
                                     at(b, first + b.width + 1)) /
                                    4.0;
            ASSERT_LT(glm::length(at(a, y * a.width + x) - mean), 1e-5) << x << ' ' << y;
        }
}

TEST(Seed, ChangesTheNoiseAlone) {
    render::Options o = options(LightMode::area);
    render::Renderer first(device(), cornell(), o);
    o.seed = 1;
    render::Renderer second(device(), cornell(), o);
    first.render(0);
    second.render(0);
    EXPECT_NE(first.hash(), second.hash());
}

// A mirror-like floor reflects a point light where Fermat says.
TEST(Highlight, LiesInTheMirrorDirection) {
    scene::Mesh mesh;
    add_quad(mesh, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 2, 4}, {0.5f, 0, 0}, 50});
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].specular = {1.0f, 0.5f, 0.25f};
    scene.materials[0].shininess = 200.0f;
    scene.lights.emplace_back();
    scene.lights[0].position = {1, 2, -4};
    render::Options o = options(LightMode::point);
    o.width = 400;
    o.height = 300;
    o.images = {"position"};
    render::Renderer renderer(device(), scene, o);
    renderer.render(0);
    const render::Image colour = renderer.map("colour"), position = renderer.map("position");
    std::uint32_t brightest = 0;
    for (std::uint32_t i = 0; i < pixels(colour); ++i) {
        brightest = at(colour, i).x > at(colour, brightest).x ? i : brightest;
        EXPECT_NEAR(at(colour, i).y, 0.5 * at(colour, i).x, 1e-6);
        EXPECT_NEAR(at(colour, i).z, 0.25 * at(colour, i).x, 1e-6);
    }
    // Eye and light at equal heights: the mirror point is the middle of their feet.
    EXPECT_LT(glm::length(at(position, brightest) - glm::dvec3(0.5, 0, 0)), 0.02);
    EXPECT_NEAR(at(colour, brightest).x, 1.0, 0.01);
}

TEST(Emission, IsAddedOnceAndNeedsNoLight) {
    scene::Scene scene = closed_box();
    scene.lights.clear();
    scene.materials[0].emission = {0.5f, 2.0f, 0.0f};
    render::Renderer renderer(device(), scene, options(LightMode::point));
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    for (std::uint32_t i = 0; i < pixels(colour); ++i)
        ASSERT_EQ(at(colour, i), glm::dvec3(0.5, 2.0, 0.0));
}

TEST(AmbientLight, TimesAlbedoIsTheColourOfAnUnlitSurface) {
    scene::Scene scene = closed_box();
    scene.lights.clear();
    scene.ambient = {0.25f, 0.5f, 1.0f};
    scene.materials[0].diffuse = {0.5f, 0.5f, 0.25f};
    render::Renderer renderer(device(), scene, options(LightMode::point));
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    for (std::uint32_t i = 0; i < pixels(colour); ++i)
        ASSERT_EQ(at(colour, i), glm::dvec3(0.125, 0.25, 0.25));
}

TEST(Renderer, TimesEveryStage) {
    render::Renderer renderer(device(), cornell(), options(LightMode::point));
    for (std::uint32_t frame = 0; frame < 3; ++frame)
        renderer.render(frame);
    EXPECT_EQ(renderer.timings().frames(), 2u);
    std::set<std::string> stages;
    for (const frame::StageStatistics& row : renderer.timings().statistics())
        stages.insert(row.stage);
    for (const char* stage : {"generate primary rays", "trace primary rays", "resolve surfaces",
                              "trace shadow rays", "shade", "all stages", "frame"})
        EXPECT_TRUE(stages.contains(stage)) << stage;
}

TEST(Renderer, UnknownNamesAreErrorsThatListTheKnownOnes) {
    render::Options o = options(LightMode::point);
    o.method = "fool";
    EXPECT_THAT([&] { render::Renderer(device(), cornell(), o); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("full")));
    o = options(LightMode::point);
    o.images = {"normal"};
    EXPECT_THAT([&] { render::Renderer(device(), cornell(), o); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("shading normal")));
    o = options(LightMode::point);
    o.variant = "fastest";
    EXPECT_THROW(render::Renderer(device(), cornell(), o), std::invalid_argument);
}

TEST(Renderer, SizesAndCountsOutOfRangeAreErrors) {
    for (const auto& spoil : std::vector<void (*)(render::Options&)>{
             [](render::Options& o) { o.width = 0; }, [](render::Options& o) { o.height = 20000; },
             [](render::Options& o) { o.samples_per_pixel = 0; },
             [](render::Options& o) { o.light_samples = 0; }}) {
        render::Options o = options(LightMode::area);
        spoil(o);
        EXPECT_THROW(render::Renderer(device(), cornell(), o), std::invalid_argument);
    }
}

TEST(Renderer, AnImageThatWasNotAskedForIsAnError) {
    render::Renderer renderer(device(), cornell(), options(LightMode::point));
    renderer.render(0);
    EXPECT_THROW(renderer.map("depth"), std::invalid_argument);
    EXPECT_THROW(renderer.map("nonsense"), std::invalid_argument);
}

} // namespace
