// Importers of foreign recordings: those that others made, where they are.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "scenes/gaze/import.hpp"

namespace macula::scene {
namespace {

namespace fs = std::filesystem;

class SharedTraces : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::is_directory(folder_))
            GTEST_SKIP() << folder_ << " is not here";
    }
    ImportedTrace read(const char* file) const { return import_trace(folder_ / file, ""); }
    const fs::path folder_ = fs::path(MACULA_SHARED_DIR) / "traces";
};

struct Yaw {
    double range = 0.0, fastest = 0.0; // degrees, degrees a second
};

Yaw yaw_of(const HeadRecording& head) {
    Yaw yaw;
    double lo = 0.0, hi = 0.0, sum = 0.0, last = 0.0;
    for (std::size_t i = 0; i < head.samples.size(); ++i) {
        const double now =
            angles_of_direction(head.samples[i].orientation * glm::dvec3(0.0, 0.0, -1.0)).x;
        if (i > 0) {
            const double step = std::remainder(now - last, 360.0);
            sum += step;
            // Over about 40 ms: positions are rounded and times jitter.
            if (i >= 5) {
                const double before = angles_of_direction(head.samples[i - 5].orientation *
                                                          glm::dvec3(0.0, 0.0, -1.0))
                                          .x;
                const double seconds = 1e-9 * static_cast<double>(head.samples[i].time_ns -
                                                                  head.samples[i - 5].time_ns);
                yaw.fastest = std::fmax(yaw.fastest,
                                        std::fabs(std::remainder(now - before, 360.0)) / seconds);
            }
        }
        lo = std::fmin(lo, sum);
        hi = std::fmax(hi, sum);
        last = now;
    }
    yaw.range = hi - lo;
    return yaw;
}

TEST_F(SharedTraces, ViveHeadsTurnAsFarAsTheirNotesSay) {
    const struct {
        const char* file;
        double range;
    } cases[] = {{"vive_pro_eye_head_gaze/TESTNA01_2D_Fist3.csv", 37.0},
                 {"vive_pro_eye_head_gaze/TESTNA01_360VR_Fist3.csv", 52.0},
                 {"vive_pro_eye_head_gaze/TESTNA05_360VR_Spread7.csv", 72.0}};
    for (const auto& c : cases) {
        const ImportedTrace t = read(c.file);
        const Yaw yaw = yaw_of(t.head);
        EXPECT_LT(yaw.fastest, 200.0) << c.file << ": a jolt";
        EXPECT_NEAR(yaw.range, c.range, 1.0) << c.file;
        std::size_t invalid = 0;
        for (const GazeSample& s : t.gaze.samples) {
            EXPECT_NEAR(glm::length(s.direction), 1.0, 1e-12);
            EXPECT_LT(s.direction.z, 0.0);
            invalid += s.valid ? 0 : 1;
        }
        const double part =
            static_cast<double>(invalid) / static_cast<double>(t.gaze.samples.size());
        EXPECT_GT(part, 0.01) << c.file;
        EXPECT_LT(part, 0.15) << c.file;
    }
}

TEST_F(SharedTraces, ViveEyesConverge) {
    // The left eye looks to the right of the right one at whatever is near; crossed signs of x
    // would make them diverge.
    const ImportedTrace t = read("vive_pro_eye_head_gaze/TESTNA01_2D_Fist3.csv");
    double sum = 0.0, count = 0.0;
    for (const GazeSample& s : t.gaze.samples) {
        if (!s.left || !s.right)
            continue;
        sum += s.left->x - s.right->x;
        ++count;
    }
    EXPECT_GT(count, 1000.0);
    EXPECT_GT(sum / count, -0.01);
}

TEST_F(SharedTraces, PicoAndQuaternionHeads) {
    const ImportedTrace pico = read("pico_neo3_head_gaze/boxing_VR.csv");
    EXPECT_EQ(pico.gaze.samples.size(), 492u);
    EXPECT_LT(yaw_of(pico.head).fastest, 400.0);
    for (const char* file : {"R51ADW_5.csv", "UBCLRB_24.csv"}) {
        const ImportedTrace head = read((std::string("head_360video_quat/") + file).c_str());
        EXPECT_NEAR(1e-9 * static_cast<double>(head.head.samples.back().time_ns), 60.0, 0.2);
        for (std::size_t i = 1; i < head.head.samples.size(); ++i)
            ASSERT_GT(
                glm::dot(head.head.samples[i - 1].orientation, head.head.samples[i].orientation),
                0.9)
                << file << " row " << i;
    }
}

} // namespace
} // namespace macula::scene
