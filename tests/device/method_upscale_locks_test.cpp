// Lines thinner than a rendered pixel: what the upscaler keeps of them over frames.
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/moving_scenes.hpp"
#include "tests/support/upscale_pictures.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using namespace macula::test::upscale;

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr float kGround = -10.0f; // its depth
constexpr float kFov = 60.0f;
constexpr float kSquare = 8.0f; // pixels

// The length of a picture's pixel at a depth.
float pixel_at(float depth) {
    return 2.0f * std::tan(glm::radians(0.5f * kFov)) * -depth / float(kHeight);
}

// A wire through the middle of the picture; `width`: pixels.
void add_wire(scene::Mesh& mesh, glm::vec2 middle, float degrees, float width, float depth,
              std::uint32_t material) {
    const float pixel = pixel_at(depth), angle = glm::radians(degrees);
    const glm::vec3 along{std::cos(angle), std::sin(angle), 0};
    const glm::vec3 across{-along.y, along.x, 0};
    const glm::vec3 u = 100.0f * pixel * along, v = width * pixel * across;
    add_quad(mesh, glm::vec3(middle * pixel, depth) - 0.5f * (u + v), u, v, material);
}

struct Wires {
    float width = 0.3f; // pixels
    bool textured = false;
    float depth = -9.9f;
};

// White wires at three angles over a grey ground, or over one of many greys.
scene::Scene wires_over_ground(const Wires& w) {
    scene::Mesh ground, wires;
    if (w.textured) {
        const float cell = 4.3f * pixel_at(kGround);
        for (int j = -25; j < 25; ++j)
            for (int i = -30; i < 30; ++i)
                add_quad(ground, {cell * float(i), cell * float(j), kGround}, {cell, 0, 0},
                         {0, cell, 0}, std::uint32_t(1 + (i * 7 + j * 5 + 1000) % 3));
    } else {
        add_quad(ground, {-60, -60, kGround}, {120, 0, 0}, {0, 120, 0}, 1);
    }
    add_wire(wires, {-30.0f, 0.0f}, 73.0f, w.width, w.depth, 0);
    add_wire(wires, {25.0f, 26.0f}, 11.0f, w.width, w.depth, 0);
    add_wire(wires, {20.0f, -20.0f}, 38.0f, w.width, w.depth, 0);
    const std::vector<std::uint32_t> materials = ground.triangle_material;
    ground.triangle_material.assign(materials.size(), 0);
    scene::Scene scene = scene_of(std::move(ground), {{0, 0, 0}, {0, 0, -1}, kFov});
    scene.materials.resize(4);
    scene.meshes[0].triangle_material = materials;
    scene.meshes.push_back(std::move(wires));
    scene.instances.push_back({1, {}, "wires"});
    const float greys[] = {1.0f, 0.2f, 0.25f, 0.3f};
    for (std::size_t i = 0; i < 4; ++i) {
        scene.materials[i].diffuse = glm::vec3(0.0f);
        scene.materials[i].emission = glm::vec3(greys[i]);
    }
    return scene;
}

WeierSetup small(const char* method, std::uint32_t samples = 1) {
    WeierSetup setup = of_method(method);
    setup.width = kWidth;
    setup.height = kHeight;
    setup.temporal.sharpness = 0.0f;
    setup.samples_per_pixel = samples;
    return setup;
}

// Over all pixels that a wire touches and their neighbours.
struct Lines {
    double contrast = 0.0; // of the truth's, in the mean over frames
    double flicker = 0.0;  // deviation over frames of the same, in squares of a few pixels
    double error = 0.0;    // root of the mean square, of the same
};

// `step`: pixels of the picture a frame.
Lines measure(const Wires& wires, float step, std::uint32_t warm_up = 48,
              std::uint32_t frames = 24) {
    const scene::Scene scene = wires_over_ground(wires);
    Wires none = wires;
    none.width = 0.0001f;
    const scene::Scene empty = wires_over_ground(none);
    WeierFrames ours(device(), scene, small("full+upscale"));
    WeierFrames truth(device(), scene, small("full", 16));
    WeierFrames ground(device(), empty, small("full", 16));
    const float way = step * pixel_at(kGround);
    double excess = 0.0, true_excess = 0.0, error = 0.0, count = 0.0;
    Picture what, under;
    std::map<std::pair<int, int>, std::vector<double>> squares;
    for (std::uint32_t frame = 0; frame < warm_up + frames; ++frame) {
        const scene::Camera view = moved(scene, {way * float(frame), 0.4f * way * float(frame), 0});
        ours.run(frame, view);
        if (frame < warm_up)
            continue;
        if (step > 0.0f || frame == warm_up) {
            truth.run(frame, view);
            ground.run(frame, view);
            what = truth.read<Float4>("colour");
            under = ground.read<Float4>("colour");
        }
        const Picture now = ours.read<Float4>(ours.picture());
        std::map<std::pair<int, int>, glm::dvec2> sums;
        for (std::size_t y = 2; y + 2 < kHeight; ++y)
            for (std::size_t x = 2; x + 2 < kWidth; ++x) {
                bool near = false;
                for (std::size_t k = 0; k < 25; ++k) {
                    const std::size_t i = (y + k / 5 - 2) * kWidth + x + k % 5 - 2;
                    near = near || what[i].x - under[i].x > 0.02f;
                }
                if (!near)
                    continue;
                const std::size_t i = y * kWidth + x;
                const double d = now[i].x - what[i].x;
                excess += now[i].x - under[i].x;
                true_excess += what[i].x - under[i].x;
                error += d * d;
                ++count;
                const float across = float(x) + step * float(frame);
                const float down = float(y) - 0.4f * step * float(frame);
                sums[{int(std::floor(across / kSquare)), int(std::floor(down / kSquare))}] +=
                    glm::dvec2(now[i].x - under[i].x, what[i].x - under[i].x);
            }
        for (const auto& [place, s] : sums)
            if (s.y > 1.5 * wires.width)
                squares[place].push_back(s.x / s.y);
    }
    Deviation all;
    for (const auto& [place, contrasts] : squares) {
        if (contrasts.size() < frames / 2)
            continue;
        Deviation one;
        for (const double c : contrasts)
            one.add(c);
        for (const double c : contrasts)
            all.add(c - one.mean());
    }
    return {excess / true_excess, std::sqrt(all.squares / all.count),
            std::sqrt(error / count) * count / true_excess};
}

TEST(Locks, HoldWhatAStillViewMissesInMostFrames) {
    for (const bool textured : {false, true})
        for (const float depth : {-9.9f, -6.0f})
            for (const float width : {0.3f, 0.6f}) {
                const Lines l = measure({width, textured, depth}, 0.0f);
                // Without locks: 0.03 to 0.62 of the contrast.
                EXPECT_NEAR(l.contrast, 1.0, 0.06) << width << " at " << depth << ", " << textured;
                EXPECT_LT(l.flicker, 0.06) << width << " at " << depth << ", " << textured;
            }
}

TEST(Locks, GoWithTheMotion) {
    for (const auto& [step, textured] :
         {std::pair{0.1f, false}, {0.37f, false}, {0.37f, true}, {1.0f, true}}) {
        const Lines l = measure({0.3f, textured, -9.9f}, step);
        // Without locks: 0.15 to 0.52 of the contrast, and more flicker of that.
        EXPECT_NEAR(l.contrast, 1.0, 0.2) << "step " << step << ", " << textured;
        EXPECT_LT(l.flicker, 0.12) << "step " << step << ", " << textured;
    }
}

// A sample that hits a wire, and one that misses it, are no other surfaces for each other.
TEST(Locks, StandWhateverIsBehindTheirThing) {
    for (const float depth : {-8.0f, -6.0f}) {
        const Lines l = measure({0.3f, true, depth}, 0.37f);
        EXPECT_NEAR(l.contrast, 1.0, 0.25) << "depth " << depth;
        EXPECT_LT(l.flicker, 0.25) << "depth " << depth;
    }
}

// How far the brightest pixel is above the truth, `reach` pixels and more from where that shows a
// wire.
float brightest_ghost(const Picture& now, const Picture& what, const Picture& under, int reach) {
    float most = 0.0f;
    for (int y = reach; y + reach < int(kHeight); ++y)
        for (int x = reach; x + reach < int(kWidth); ++x) {
            bool near = false;
            for (int j = -reach; j <= reach; ++j)
                for (int i = -reach; i <= reach; ++i) {
                    const std::size_t k = std::size_t((y + j) * int(kWidth) + x + i);
                    near = near || what[k].x - under[k].x > 0.02f;
                }
            const std::size_t k = std::size_t(y * int(kWidth) + x);
            if (!near)
                most = std::max(most, now[k].x - under[k].x);
        }
    return most;
}

WeierSetup placed(const char* method, std::uint32_t samples = 1) {
    WeierSetup setup = small(method, samples);
    setup.geometry.merge_static = false;
    return setup;
}

Picture grey_ground() {
    return Picture(kWidth * kHeight, Float4{0.2f, 0.2f, 0.2f, 1.0f});
}

TEST(Locks, EndSoonAfterTheirThingHasGone) {
    const scene::Scene scene = wires_over_ground({0.6f, false, -9.0f});
    WeierFrames ours(device(), scene, placed("full+upscale"));
    const scene::Camera& view = scene.cameras.front();
    for (std::uint32_t frame = 0; frame < 64; ++frame)
        ours.run(frame, view);
    const Picture ground = grey_ground();
    const auto ghost = [&] {
        return brightest_ghost(ours.read<Float4>(ours.picture()), ground, ground, 0);
    };
    EXPECT_GT(ghost(), 0.3f);
    ours.place(std::vector{scene::Transform{}, moved_by({0, 0, 100})});
    constexpr std::uint32_t kLife = 26; // frames at the ratio 1.8: 8 samples' worth
    for (std::uint32_t frame = 0; frame < kLife + 1; ++frame)
        ours.run(64 + frame, view);
    EXPECT_LT(ghost(), 1e-3f);
}

TEST(Locks, LeaveNoTrailBehindAThingThatMoves) {
    const scene::Scene scene = wires_over_ground({0.6f, false, -9.0f});
    const scene::Camera& view = scene.cameras.front();
    const Picture ground = grey_ground();
    for (const float step : {0.05f, 0.1f, 0.2f, 0.3f, 0.5f, 1.5f}) {
        WeierFrames ours(device(), scene, placed("full+upscale"));
        WeierFrames truth(device(), scene, placed("full", 16));
        float most = 0.0f;
        for (std::uint32_t frame = 0; frame <= 48; ++frame) {
            const float way = step * pixel_at(-9.0f) * float(frame);
            const std::vector there{scene::Transform{}, moved_by({way, 0, 0})};
            ours.place(there);
            ours.run(frame, view);
            if (frame < 24 || frame % 8 != 0)
                continue;
            truth.place(there);
            truth.run(frame, view);
            most = std::max(most, brightest_ghost(ours.read<Float4>(ours.picture()),
                                                  truth.read<Float4>("colour"), ground, 3));
        }
        EXPECT_LT(most, 0.01f) << "step " << step;
    }
}

TEST(Locks, AreTheSameWithOneLaneAndSixteen) {
    const scene::Scene scene = wires_over_ground({0.3f, true, -8.0f});
    for (const char* method : {"full+upscale", "weier+upscale", "logpolar+taa+upscale"}) {
        std::vector<std::string> hashes;
        for (const std::uint32_t lanes : {1u, 16u}) {
            render::Options options;
            options.width = 150;
            options.height = 90;
            options.method = method;
            options.lanes = lanes;
            render::Renderer renderer(device(), scene, options);
            for (std::uint32_t frame = 0; frame < 5; ++frame)
                renderer.render(frame, moved(scene, {0.02f * float(frame), 0.01f, 0}));
            hashes.push_back(renderer.hash());
        }
        EXPECT_EQ(hashes[0], hashes[1]) << method;
    }
}

// Strips then hold places between pixels beside places in their middles.
TEST(Locks, OfAMovingThingAreTheSameWithOneLaneAndSixteen) {
    const scene::Scene scene = wires_over_ground({0.6f, true, -9.0f});
    WeierSetup one = placed("full+upscale"), sixteen = one;
    sixteen.lanes = 16;
    WeierFrames narrow(device(), scene, one), wide(device(), scene, sixteen);
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        const float way = 0.3f * pixel_at(-9.0f) * float(frame);
        for (WeierFrames* frames : {&narrow, &wide}) {
            frames->place(std::vector{scene::Transform{}, moved_by({way, 0, 0})});
            frames->run(frame, scene.cameras.front());
        }
        EXPECT_TRUE(
            same_bits(narrow.read<Float4>(narrow.picture()), wide.read<Float4>(wide.picture())))
            << "frame " << frame;
    }
}

} // namespace
