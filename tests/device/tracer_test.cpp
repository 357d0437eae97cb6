#include "host/stage/trace.hpp"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/frame/geometry.hpp"
#include "host/kernel/library.hpp"
#include "host/kernel/tuning.hpp"
#include "tests/support/trace_rays.hpp"

namespace {
using namespace macula;
using kernel::RayClass;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

stage::VariantTable table_of(const char* variant, const kernel::ParameterValues& values = {}) {
    stage::VariantTable table;
    table.fill({&kernel::find_variant(variant), values});
    return table;
}

class TracerTest : public testing::Test {
  protected:
    static constexpr std::uint32_t kCount = 256;

    TracerTest() : geometry_(device_, test::soup_scene()) {
        rays_ = device_.upload(
            std::span<const shared::RayBlock>(bvh::blocks_of(
                test::coherent_rays(kCount, {0.3f, 0.4f, -3.0f}, {0, 0, 0}, 0.8f), kCount)),
            "rays");
        count_ = device_.upload(std::span(&kCount, 1), "count");
        hits_ = device_.allocate_array<shared::HitBlock>(kCount / 16, "hits");
        occluded_ = device_.allocate_array<std::uint32_t>(kCount, "occluded");
    }

    std::vector<std::uint32_t> closest(stage::Tracer& tracer) {
        hits_.fill(0);
        tracer.closest(RayClass::primary, rays_, count_, kCount, hits_, "primary rays");
        const auto words = hits_.map_read<std::uint32_t>();
        return {words.begin(), words.end()};
    }

    compute::Device device_ = compute::open();
    kernel::Library library_;
    frame::DeviceGeometry geometry_;
    compute::Buffer rays_, count_, hits_, occluded_;
};

TEST_F(TracerTest, LaunchesAreTimedByName) {
    stage::Tracer tracer(device_, library_, geometry_, table_of("while_while"));
    device_.finish();
    device_.timeline().take();
    closest(tracer);
    tracer.any(RayClass::shadow, rays_, count_, kCount, occluded_, "shadow rays");
    device_.finish();
    std::vector<std::string> stages;
    for (const compute::Span& span : device_.timeline().take())
        stages.push_back(span.stage);
    EXPECT_THAT(stages, ElementsAre("primary rays", "shadow rays"));
}

TEST_F(TracerTest, WorkCounterStartsAnewAtEachLaunch) {
    stage::Tracer tracer(device_, library_, geometry_, table_of("persistent"));
    const auto first = closest(tracer);
    EXPECT_EQ(closest(tracer), first);
    stage::Tracer reference(device_, library_, geometry_, table_of("while_while"));
    EXPECT_EQ(closest(reference), first);
}

TEST_F(TracerTest, ParametersChangeNoResult) {
    stage::Tracer reference(device_, library_, geometry_, table_of("while_while"));
    const auto expected = closest(reference);
    const std::vector<kernel::ParameterValues> settings = {
        {{"work_group", 1}, {"groups_per_unit", 1}, {"rays_per_fetch", 64}},
        {{"work_group", 256}, {"groups_per_unit", 7}, {"rays_per_fetch", 3}}};
    for (const kernel::ParameterValues& values : settings) {
        stage::Tracer tracer(device_, library_, geometry_, table_of("persistent", values));
        EXPECT_EQ(closest(tracer), expected);
    }
}

TEST_F(TracerTest, EmptyQueueLaunchesNothing) {
    stage::Tracer tracer(device_, library_, geometry_, table_of("while_while"));
    tracer.closest(RayClass::primary, rays_, count_, 0, hits_, "none");
    device_.finish();
}

TEST_F(TracerTest, BuffersTooSmallForTheQueueAreNamed) {
    stage::Tracer tracer(device_, library_, geometry_, table_of("while_while"));
    const auto closest_of = [&](std::uint32_t capacity) {
        tracer.closest(RayClass::primary, rays_, count_, capacity, hits_, "large");
    };
    EXPECT_THAT([&] { closest_of(kCount + 1); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("rays")));
    auto few = device_.allocate_array<std::uint32_t>(kCount - 1, "few");
    EXPECT_THAT([&] { tracer.any(RayClass::shadow, rays_, count_, kCount, few, "small"); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("occlusion")));
    compute::Buffer none;
    EXPECT_THAT([&] { tracer.closest(RayClass::primary, rays_, none, kCount, hits_, "none"); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("count")));
}

TEST_F(TracerTest, WrongChoicesAreRefused) {
    EXPECT_THROW(stage::Tracer(device_, library_, geometry_, stage::VariantTable{}),
                 std::invalid_argument);
    EXPECT_THROW(
        stage::Tracer(device_, library_, geometry_, table_of("persistent", {{"work_group", 3}})),
        std::invalid_argument);
}

class ChooseVariants : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("macula-choose-" + std::to_string(::getpid()));
        setenv("MACULA_CACHE_DIR", folder_.c_str(), 1);
    }
    void TearDown() override {
        unsetenv("MACULA_CACHE_DIR");
        std::filesystem::remove_all(folder_);
    }

    std::filesystem::path folder_;
    compute::Device device_ = compute::open();
};

TEST_F(ChooseVariants, DefaultsWithoutATuningFile) {
    const auto table = stage::choose_variants(device_);
    for (const RayClass ray_class : kernel::kRayClasses)
        EXPECT_EQ(table[static_cast<std::size_t>(ray_class)].variant,
                  &kernel::default_variant(kernel::traits_of(device_), ray_class));
}

TEST_F(ChooseVariants, TheTuningFileOverridesDefaultsAndIsOverridden) {
    kernel::Tuning tuning = kernel::Tuning::of(device_.facts());
    tuning.choices[RayClass::shadow] = {&kernel::find_variant("if_if"), {{"work_group", 16}}};
    kernel::store_tuning(kernel::tuning_folder(), tuning);
    const auto tuned = stage::choose_variants(device_);
    const kernel::Choice& shadow = tuned[static_cast<std::size_t>(RayClass::shadow)];
    EXPECT_STREQ(shadow.variant->name, "if_if");
    EXPECT_EQ(shadow.parameters.at("work_group"), 16u);
    for (const kernel::Choice& choice : stage::choose_variants(device_, "escape_index"))
        EXPECT_STREQ(choice.variant->name, "escape_index");
}

TEST_F(ChooseVariants, ABrokenTuningFileWarns) {
    const auto file =
        kernel::store_tuning(kernel::tuning_folder(), kernel::Tuning::of(device_.facts()));
    std::filesystem::resize_file(file, 10);
    std::vector<std::string> warnings;
    stage::choose_variants(device_, "", &warnings);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr(file.string())));
}

TEST_F(ChooseVariants, UnknownNameIsRefused) {
    EXPECT_THROW(stage::choose_variants(device_, "fastest"), std::invalid_argument);
}

} // namespace
