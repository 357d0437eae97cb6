#include "host/cl/device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

namespace {

using namespace macula::compute;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

DeviceFacts made_up(int index, const char* name, const char* platform, DeviceType type) {
    DeviceFacts facts;
    facts.index = index;
    facts.name = name;
    facts.platform_name = platform;
    facts.type = type;
    return facts;
}

const std::vector<DeviceFacts> kThree{
    made_up(0, "Large CPU", "Alpha", DeviceType::cpu),
    made_up(1, "Fast GPU", "Beta", DeviceType::gpu),
    made_up(2, "Other GPU 7", "Gamma", DeviceType::gpu),
};

class Selector : public testing::Test {
  protected:
    void SetUp() override { unsetenv("MACULA_DEVICE"); }
    void TearDown() override { unsetenv("MACULA_DEVICE"); }
};

TEST_F(Selector, Index) {
    EXPECT_EQ(select(kThree, "2").index, 2);
}
TEST_F(Selector, PartOfANameInAnyCase) {
    EXPECT_EQ(select(kThree, "oTHER").index, 2);
}
TEST_F(Selector, PartOfAPlatformsName) {
    EXPECT_EQ(select(kThree, "beta").index, 1);
}
TEST_F(Selector, TypeBeforeName) {
    EXPECT_EQ(select(kThree, "cpu").index, 0);
}
TEST_F(Selector, EmptyPrefersAGpu) {
    EXPECT_EQ(select(kThree, "").index, 1);
}
TEST_F(Selector, EmptyTakesACpuWithoutAGpu) {
    EXPECT_EQ(select({kThree[0]}, "").index, 0);
}

TEST_F(Selector, EnvironmentIsTheDefault) {
    setenv("MACULA_DEVICE", "cpu", 1);
    EXPECT_EQ(select(kThree, "").index, 0);
    EXPECT_EQ(select(kThree, "1").index, 1);
}

TEST_F(Selector, UnknownNameListsTheDevices) {
    EXPECT_THAT([] { select(kThree, "nosuch"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("\"nosuch\""), HasSubstr("--device"),
                                           HasSubstr("1: Fast GPU"))));
}

TEST_F(Selector, UnknownNameInTheEnvironmentNamesTheVariable) {
    setenv("MACULA_DEVICE", "nosuch", 1);
    EXPECT_THAT([] { select(kThree, ""); }, ThrowsMessage<Error>(HasSubstr("MACULA_DEVICE")));
}

TEST_F(Selector, IndexBeyondTheList) {
    EXPECT_THROW(select(kThree, "3"), Error);
    EXPECT_THROW(select(kThree, "99999999999999999999"), Error);
}

TEST_F(Selector, NoDeviceNamesThePackage) {
    EXPECT_THAT([] { select({}, "cpu"); }, ThrowsMessage<Error>(HasSubstr("pocl-opencl-icd")));
}

TEST(OpenDevice, ByIndexNameAndType) {
    const std::vector<DeviceFacts> all = enumerate();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(open("0").facts().name, all[0].name);
    EXPECT_EQ(open(all[0].name).facts().index, 0);
    EXPECT_EQ(open(to_string(all[0].type)).facts().type, all[0].type);
}

TEST(OpenDevice, FactsAreFilledIn) {
    const DeviceFacts& facts = open().facts();
    EXPECT_GE(facts.major, 1);
    EXPECT_GT(facts.compute_units, 0u);
    EXPECT_GT(facts.global_memory_bytes, 0u);
    EXPECT_GE(facts.global_memory_bytes, facts.max_allocation_bytes);
    EXPECT_TRUE(facts.fp32.round_to_nearest);
    EXPECT_FALSE(facts.driver_version.empty());
}

constexpr const char* kTwice = R"(
kernel void twice(global int *values, int scale) {
    values[get_global_id(0)] *= scale;
})";

TEST(TwoDevices, OpenAtOnceAndComputeApart) {
    const Device first = open(), second = open();
    EXPECT_NE(first.id(), second.id());
    const auto work = [](const Device& device, int scale) {
        const std::vector<int> values{1, 2, 3};
        const Buffer buffer = device.upload(std::span(values), "values");
        Kernel kernel = device.build(kTwice, "", "twice").kernel("twice");
        for (int i = 0; i < 5; ++i)
            kernel.set(buffer, scale).launch("scale", {3});
        return buffer.read_one<int>(2);
    };
    int one = 0, two = 0;
    std::thread other([&] { two = work(second, 3); });
    one = work(first, 2);
    other.join();
    EXPECT_EQ(one, 3 * 32);
    EXPECT_EQ(two, 3 * 243);
}

TEST(TwoDevices, BufferOfAnotherDeviceIsAnError) {
    const Device first = open(), second = open();
    Kernel kernel = first.build(kTwice, "", "twice").kernel("twice");
    EXPECT_THAT(
        [&] { kernel.set(second.allocate(16, "foreign"), 1); },
        ThrowsMessage<Error>(AllOf(HasSubstr("foreign"), HasSubstr("another open device"))));
}

TEST(Allocation, BeyondTheLargestSaysHowMuchForWhatAndTheLimit) {
    const Device device = open();
    const std::uint64_t limit = device.facts().max_allocation_bytes;
    EXPECT_THAT([&] { device.allocate(limit + 5000000, "ray queue"); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr("\"ray queue\""), HasSubstr("largest single allocation"),
                          HasSubstr(std::to_string((limit + 5000000) / 1000000) + " MB"),
                          HasSubstr(std::to_string(limit / 1000000) + " MB"))));
}

TEST(Allocation, OverflowingProductIsAnError) {
    EXPECT_THAT([] { open().allocate_array<double>(~0ull / 4, "rays"); },
                ThrowsMessage<Error>(HasSubstr("overflows")));
}

TEST(Allocation, IsCountedAndGivenBack) {
    const Device device = open();
    {
        const Buffer buffer = device.allocate(1000, "a");
        const Buffer copy = buffer;
        EXPECT_EQ(device.allocated_bytes(), 1000u);
    }
    EXPECT_EQ(device.allocated_bytes(), 0u);
}

TEST(Allocation, EmptyBufferCanBeMappedFilledAndWritten) {
    Buffer buffer = open().upload(std::span<const int>(), "nothing");
    EXPECT_EQ(buffer.size(), 0u);
    EXPECT_TRUE(buffer.map_read<int>().empty());
    EXPECT_NO_THROW(buffer.fill(1));
}

TEST(BufferMap, WritesAreReadBackAndRangesChecked) {
    Buffer buffer = open().allocate_array<int>(10, "ten");
    {
        auto map = buffer.map_write<int>();
        for (int i = 0; i < 10; ++i)
            map[static_cast<std::size_t>(i)] = i;
    }
    EXPECT_THAT(buffer.map_read<int>(7), testing::ElementsAre(7, 8, 9));
    EXPECT_THAT([&] { buffer.map_read<int>(8, 3); },
                ThrowsMessage<Error>(AllOf(HasSubstr("\"ten\""), HasSubstr("outside"))));
    EXPECT_THAT([] { Buffer().map_read<int>(); },
                ThrowsMessage<Error>(HasSubstr("never allocated")));
}

TEST(BufferMap, CopyAndFillStayInQueueOrder) {
    const Device device = open();
    Buffer source = device.allocate(64, "source"), target = device.allocate(64, "target");
    source.fill(5);
    target.copy_from(source, 64);
    source.fill(6);
    EXPECT_THAT(target.map_read<std::uint32_t>(), testing::Each(5u));
    EXPECT_THROW(target.copy_from(source, 65), Error);
}

TEST(KernelArguments, WrongNumberSizeAndEntryNameTheKernel) {
    const Device device = open();
    const Program program = device.build(kTwice, "", "program twice");
    Kernel kernel = program.kernel("twice");
    const Buffer buffer = device.allocate(16, "values");
    EXPECT_THAT([&] { kernel.set(buffer); },
                ThrowsMessage<Error>(AllOf(HasSubstr("takes 2"), HasSubstr("\"twice\""))));
    EXPECT_THAT([&] { kernel.set(buffer, 1.0); },
                ThrowsMessage<Error>(AllOf(HasSubstr("argument 1"), HasSubstr("8 bytes"))));
    EXPECT_THAT([&] { program.kernel("thrice"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("\"thrice\""), HasSubstr("are: twice"))));
}

TEST(KernelLaunch, GlobalSizeThatIsNoMultipleIsAnError) {
    const Device device = open();
    Kernel kernel = device.build(kTwice, "", "twice").kernel("twice");
    kernel.set(device.allocate(400, "values"), 1);
    EXPECT_THAT([&] { kernel.launch("scale", {100}, {64}); },
                ThrowsMessage<Error>(HasSubstr("no multiple")));
    EXPECT_NO_THROW(kernel.launch("scale", {0}, {64}));
}

TEST(TimelineTest, ReportsDeviceTimesByStageInOrder) {
    const Device device = open();
    Kernel kernel = device.build(kTwice, "", "twice").kernel("twice");
    kernel.set(device.allocate(4 << 20, "values"), 1);
    kernel.launch("first stage", {1 << 20});
    kernel.launch("second stage", {1 << 20});
    device.finish();
    const std::vector<Span> spans = device.timeline().take();
    ASSERT_EQ(spans.size(), 2u);
    EXPECT_EQ(spans[0].stage, "first stage");
    EXPECT_EQ(spans[1].stage, "second stage");
    EXPECT_GT(spans[0].device_ns(), 0u);
    EXPECT_GT(spans[0].host_ns, 0u);
    EXPECT_LE(spans[0].ended, spans[1].started);
    EXPECT_TRUE(device.timeline().take().empty());
}

TEST(Errors, NameTheStatusAndWhatToDo) {
    EXPECT_STREQ(Error("doing", -5).what(),
                 ("doing: CL_OUT_OF_RESOURCES (" + status_advice(-5) + ")").c_str());
    EXPECT_THAT(status_advice(-36), HasSubstr("device was lost"));
    EXPECT_EQ(status_name(-9999), "CL error -9999");
}

} // namespace
