// Method weier over many frames (Weier et al. 2016, section 3.4: a cache that is fed forever):
// memory stays flat, every number finite, and the error at the same place of the path the same.
// MACULA_LONG_RUN_FRAMES sets the number of frames; tests/long_run.sh runs 10,000.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <unistd.h>

#include "host/render/renderer.hpp"
#include "scenes/load.hpp"

namespace {
using namespace macula;
using frame::LightMode;

constexpr std::uint32_t kRoundTrips = 5;
constexpr std::uint32_t kPlaces = 10; // of a round trip where the frame is compared with full's
constexpr float kFirstOfPath = 300.0f;

std::uint32_t wanted_frames() {
    const char* text = std::getenv("MACULA_LONG_RUN_FRAMES");
    const long frames = text != nullptr ? std::atol(text) : 200;
    // A whole number of frames between two compared places.
    return static_cast<std::uint32_t>(std::max(frames, 1L) + 99) / 100 * 100;
}

std::uint64_t resident_bytes() {
    std::uint64_t total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

const scene::Scene& atrium() {
    static const scene::Scene loaded = scene::load("atrium");
    return loaded;
}

const std::shared_ptr<render::DeviceScene>& on_device() {
    static const auto made = std::make_shared<render::DeviceScene>(compute::open(), atrium());
    return made;
}

bool all_finite(const render::Renderer& renderer, const char* image) {
    for (const float value : renderer.map(image).floats)
        if (!std::isfinite(value))
            return false;
    return true;
}

// Of radiance cut off at 1, in dB.
double psnr(const render::Renderer& ours, const render::Renderer& truth) {
    const render::Image a = ours.map("colour"), b = truth.map("colour");
    double sum = 0.0;
    for (std::size_t i = 0; i < a.floats.size(); ++i) {
        const double d = double{std::min(a.floats[i], 1.0f)} - double{std::min(b.floats[i], 1.0f)};
        sum += d * d;
    }
    return 10.0 * std::log10(static_cast<double>(a.floats.size()) * 0.75 / std::max(sum, 1e-30));
}

class LongRun : public testing::TestWithParam<LightMode> {
  protected:
    static render::Renderer make(const char* method) {
        render::Options options;
        options.width = 128;
        options.height = 160;
        options.method = method;
        options.lights = GetParam();
        const bool truth = options.method == "full";
        options.light_samples = options.ambient_occlusion_samples = truth ? 16 : 4;
        if (!truth)
            options.images = {"rho"};
        return {on_device(), atrium(), options};
    }
};

TEST_P(LongRun, MemoryIsFlatEverythingFiniteAndNothingDrifts) {
    const std::uint32_t frames = wanted_frames(), trip = frames / kRoundTrips;
    render::Renderer ours = make("weier"), full = make("full");
    std::vector<std::vector<double>> errors(kRoundTrips); // dB, by round trip and place
    std::uint64_t resident = 0, device_bytes = 0;
    // There and back again, so that each round trip sees the same; one more to begin with.
    for (std::uint32_t frame = 0; frame < frames + trip; ++frame) {
        const std::uint32_t step = frame % trip, turned = std::min(step, trip - step);
        const scene::Camera view =
            frame::camera_at(atrium(), kFirstOfPath + static_cast<float>(turned));
        frame::Gaze gaze;
        const float turn = 6.2831853f * static_cast<float>(step) / static_cast<float>(trip);
        gaze.direction = view.target - view.eye + glm::vec3(std::cos(turn), std::sin(turn), 0.0f);
        ours.render(frame, view, gaze);
        if (frame < trip)
            continue;
        if (step % (trip / kPlaces) == 0) {
            full.render(frame, view, gaze);
            errors[frame / trip - 1].push_back(psnr(ours, full));
            ASSERT_TRUE(all_finite(ours, "colour") && all_finite(ours, "rho")) << frame;
        }
        if (frame + 1 == 2 * trip) {
            resident = resident_bytes();
            device_bytes = on_device()->device.allocated_bytes();
        }
    }
    const double grown = (double(resident_bytes()) - double(resident)) / (1024.0 * 1024.0);
    std::vector<double> means; // by round trip
    double least = 1e9;
    for (const std::vector<double>& of_trip : errors) {
        means.push_back(std::accumulate(of_trip.begin(), of_trip.end(), 0.0) /
                        double(of_trip.size()));
        least = std::min(least, *std::min_element(of_trip.begin(), of_trip.end()));
    }
    std::printf("%u frames: resident %.1f MiB, grown by %.2f MiB after the first round trip; PSNR "
                "against full at least %.2f dB, means of the round trips",
                frames, double(resident) / (1024.0 * 1024.0), grown, least);
    for (const double mean : means)
        std::printf(" %.2f", mean);
    std::printf("\n");
    EXPECT_EQ(on_device()->device.allocated_bytes(), device_bytes);
    EXPECT_LT(grown, 4.0) << "MiB";
    // The samples of a round trip are other ones: half a decibel is chance.
    EXPECT_GT(means.back(), means.front() - 0.5) << "dB";
    EXPECT_GT(least, 20.0) << "dB";
}

INSTANTIATE_TEST_SUITE_P(Lights, LongRun,
                         testing::Values(LightMode::point, LightMode::area,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

} // namespace
