#include "host/kernel/tuning.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/facts.hpp"

namespace {
using namespace macula;
using kernel::RayClass;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr kernel::DeviceTraits kCpu{.gpu = false, .compute_units = 8, .max_work_group = 4096};
constexpr kernel::DeviceTraits kGpu{.gpu = true, .compute_units = 80, .max_work_group = 1024};

std::string chosen(const kernel::DeviceTraits& device, RayClass ray_class) {
    return kernel::default_variant(device, ray_class).name;
}

TEST(Registry, TheReferenceIsTheLast) {
    EXPECT_STREQ(kernel::reference_variant().name, "while_while");
}

TEST(Registry, NamesAreFoundAndUnknownOnesListTheRest) {
    for (const kernel::Variant& variant : kernel::variants())
        EXPECT_EQ(&kernel::find_variant(variant.name), &variant);
    EXPECT_THAT([] { kernel::find_variant("wide9"); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("escape_index, while_while")));
}

TEST(Registry, DefaultsOfACpuFollowTheRaysCoherence) {
    for (const RayClass coherent : {RayClass::primary, RayClass::shadow, RayClass::sparse})
        EXPECT_EQ(chosen(kCpu, coherent), "packet_stream");
    for (const RayClass incoherent :
         {RayClass::ambient_occlusion, RayClass::diffuse, RayClass::random})
        EXPECT_EQ(chosen(kCpu, incoherent), "stream");
}

TEST(Registry, AGpuTracesOneRayAWorkItem) {
    for (const RayClass ray_class : kernel::kRayClasses)
        EXPECT_EQ(chosen(kGpu, ray_class), "wide8_quantized");
}

TEST(Registry, EveryDefaultApplies) {
    for (const auto& device : {kCpu, kGpu}) {
        for (const RayClass ray_class : kernel::kRayClasses)
            EXPECT_EQ(
                kernel::why_not(kernel::default_variant(device, ray_class), device, ray_class), "");
    }
}

TEST(Registry, TheReferenceAppliesToAllRaysEverywhere) {
    for (const auto& device : {kCpu, kGpu}) {
        for (const RayClass ray_class : kernel::kRayClasses)
            EXPECT_EQ(kernel::why_not(kernel::reference_variant(), device, ray_class), "");
    }
}

TEST(Registry, StandardParametersAreInRange) {
    for (const kernel::Variant& variant : kernel::variants()) {
        kernel::ParameterValues values;
        for (const kernel::Parameter& parameter : variant.parameters)
            values[parameter.name] = parameter.standard;
        EXPECT_NO_THROW(kernel::check_parameters(variant, values)) << variant.name;
    }
}

TEST(Registry, WrongParametersSayWhy) {
    const kernel::Variant& variant = kernel::find_variant("persistent");
    EXPECT_THAT(
        [&] {
            kernel::check_parameters(variant, {{"colour", 1}});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("work_group")));
    EXPECT_THAT(
        [&] {
            kernel::check_parameters(variant, {{"work_group", 2048}});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("1 .. 1024")));
    EXPECT_THAT(
        [&] {
            kernel::check_parameters(variant, {{"work_group", 48}});
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("power of two")));
}

TEST(Registry, ListNamesEveryVariantTheChoicesAndTheReasonsAgainst) {
    std::vector<kernel::Choice> chosen;
    for (const RayClass ray_class : kernel::kRayClasses)
        chosen.push_back({&kernel::default_variant(kGpu, ray_class), {}});
    chosen[static_cast<std::size_t>(RayClass::random)] = {&kernel::find_variant("persistent"),
                                                          {{"work_group", 8}}};
    const std::string list = kernel::list_variants(kGpu, chosen);
    for (const kernel::Variant& variant : kernel::variants())
        EXPECT_THAT(list, HasSubstr(variant.name));
    EXPECT_THAT(list, HasSubstr("chosen for primary rays\n"));
    EXPECT_THAT(list, HasSubstr("chosen for random rays (work_group 8)\n"));
    EXPECT_THAT(list, HasSubstr("private memory"));
}

TEST(Registry, ListNeedsAChoiceForEachClass) {
    EXPECT_THROW(kernel::list_variants(kGpu, {}), std::invalid_argument);
}

class TuningFile : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  ("macula-tuning-" + std::string(test->name()) + std::to_string(::getpid()));
        device_.name = "CPU 1/2 (fast)";
        device_.vendor = "Maker";
        device_.driver_version = "3.1";
        device_.type = compute::DeviceType::cpu;
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path store() {
        kernel::Tuning tuning = kernel::Tuning::of(device_);
        tuning.choices[RayClass::random] = {&kernel::find_variant("persistent"),
                                            {{"work_group", 8}, {"rays_per_fetch", 4}}};
        return kernel::store_tuning(folder_, tuning);
    }
    static void replace(const fs::path& file, const std::string& from, const std::string& to) {
        std::ifstream in(file);
        std::string text(std::istreambuf_iterator<char>(in), {});
        const auto at = text.find(from);
        ASSERT_NE(at, std::string::npos);
        std::ofstream(file) << text.replace(at, from.size(), to);
    }

    fs::path folder_;
    compute::DeviceFacts device_;
};

TEST_F(TuningFile, ComesBackAsStored) {
    const fs::path file = store();
    const kernel::LoadedTuning loaded = kernel::load_tuning(folder_, device_);
    EXPECT_EQ(loaded.file, file);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    ASSERT_EQ(loaded.tuning.choices.size(), 1u);
    const kernel::Choice& choice = loaded.tuning.choices.at(RayClass::random);
    EXPECT_STREQ(choice.variant->name, "persistent");
    EXPECT_EQ(choice.parameters,
              (kernel::ParameterValues{{"work_group", 8}, {"rays_per_fetch", 4}}));
}

TEST_F(TuningFile, NoneGivesNoChoices) {
    for (const fs::path& folder : {fs::path(), folder_ / "nowhere"}) {
        const kernel::LoadedTuning loaded = kernel::load_tuning(folder, device_);
        EXPECT_TRUE(loaded.file.empty());
        EXPECT_THAT(loaded.tuning.choices, IsEmpty());
        EXPECT_THAT(loaded.warnings, IsEmpty());
    }
}

TEST_F(TuningFile, AnotherDeviceOfTheVendorIsTheFallback) {
    store();
    device_.name = "CPU 3";
    EXPECT_EQ(kernel::load_tuning(folder_, device_).tuning.choices.size(), 1u);
    device_.type = compute::DeviceType::gpu;
    EXPECT_THAT(kernel::load_tuning(folder_, device_).tuning.choices, IsEmpty());
    device_.type = compute::DeviceType::cpu;
    device_.vendor = "Other";
    EXPECT_THAT(kernel::load_tuning(folder_, device_).tuning.choices, IsEmpty());
}

TEST_F(TuningFile, TruncatedFileIsAWarning) {
    const fs::path file = store();
    fs::resize_file(file, fs::file_size(file) / 2);
    const kernel::LoadedTuning loaded = kernel::load_tuning(folder_, device_);
    EXPECT_THAT(loaded.tuning.choices, IsEmpty());
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr(file.string())));
}

TEST_F(TuningFile, OfAnotherFormatIsAWarning) {
    replace(store(), "\"format\": 1", "\"format\": 99");
    EXPECT_THAT(kernel::load_tuning(folder_, device_).warnings, ElementsAre(HasSubstr("99")));
}

TEST_F(TuningFile, WrongTypesAreAWarning) {
    replace(store(), "\"driver\": \"3.1\"", "\"driver\": [3]");
    EXPECT_THAT(kernel::load_tuning(folder_, device_).warnings, ElementsAre(HasSubstr("ignored")));
}

TEST_F(TuningFile, UnknownVariantIsLeftOut) {
    replace(store(), "\"persistent\"", "\"forgotten\"");
    const kernel::LoadedTuning loaded = kernel::load_tuning(folder_, device_);
    EXPECT_THAT(loaded.tuning.choices, IsEmpty());
    EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("forgotten")));
}

TEST_F(TuningFile, ParameterOutOfRangeIsLeftOut) {
    replace(store(), "\"work_group\": 8", "\"work_group\": 9");
    EXPECT_THAT(kernel::load_tuning(folder_, device_).warnings,
                ElementsAre(HasSubstr("power of two")));
}

TEST_F(TuningFile, NegativeParameterIsLeftOut) {
    replace(store(), "\"work_group\": 8", "\"work_group\": -8");
    EXPECT_THAT(kernel::load_tuning(folder_, device_).tuning.choices, IsEmpty());
}

TEST_F(TuningFile, UnknownRayClassIsLeftOut) {
    replace(store(), "\"random\"", "\"purple\"");
    EXPECT_THAT(kernel::load_tuning(folder_, device_).warnings, ElementsAre(HasSubstr("purple")));
}

TEST_F(TuningFile, StoringLeavesNoTemporaryFile) {
    store();
    store();
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(TuningFile, StoringWhereNothingCanBeWrittenNamesTheFile) {
    std::ofstream(folder_) << "a file, not a folder";
    EXPECT_THAT([&] { store(); }, ThrowsMessage<std::runtime_error>(HasSubstr(folder_.string())));
}

} // namespace
