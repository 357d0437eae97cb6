#include "host/kernel/prefix_sum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace {

using namespace macula;
using Uints = std::vector<std::uint32_t>;

class PrefixSumTest : public testing::TestWithParam<std::uint32_t> {
  protected:
    compute::Device device = compute::open();
    kernel::Library library;

    compute::Buffer upload(const Uints& values) {
        return device.upload(std::span(values), "test values");
    }
};

Uints random_values(std::uint32_t count, std::uint32_t bound) {
    std::mt19937 random(count + bound);
    Uints values(count);
    for (std::uint32_t& value : values)
        value = random() % bound;
    return values;
}

Uints exclusive_scan(const Uints& values) {
    Uints sums(values.size());
    std::exclusive_scan(values.begin(), values.end(), sums.begin(), 0u);
    return sums;
}

Uints read(const compute::Buffer& buffer, std::size_t count) {
    const auto map = buffer.map_read<std::uint32_t>(0, count);
    return {map.begin(), map.end()};
}

TEST_P(PrefixSumTest, EqualsTheHosts) {
    const Uints values = random_values(GetParam(), 1000);
    const compute::Buffer offsets =
        device.allocate_array<std::uint32_t>(values.size(), "test offsets");
    const compute::Buffer total = upload({77});
    kernel::PrefixSum sum(library, device, values.size());
    sum.exclusive(upload(values), upload({GetParam()}), offsets, total);
    EXPECT_EQ(read(offsets, values.size()), exclusive_scan(values));
    EXPECT_EQ(total.read_one<std::uint32_t>(),
              std::accumulate(values.begin(), values.end(), std::uint32_t{0}));
}

TEST_P(PrefixSumTest, CompactionKeepsTheOrder) {
    const Uints flags = random_values(GetParam(), 2);
    Uints expected;
    for (std::uint32_t i = 0; i < flags.size(); ++i)
        if (flags[i])
            expected.push_back(i);
    const compute::Buffer indices =
        device.allocate_array<std::uint32_t>(flags.size(), "test indices");
    const compute::Buffer total = upload({77});
    kernel::Compaction compaction(library, device, flags.size());
    compaction.run(upload(flags), upload({GetParam()}), indices, total);
    ASSERT_EQ(total.read_one<std::uint32_t>(), expected.size());
    EXPECT_EQ(read(indices, expected.size()), expected);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PrefixSumTest,
                         testing::Values(0, 1, 2, 15, 16, 17, 255, 256, 257, 2047, 2048, 2049,
                                         999983, 1000000, 2048 * 2048, 2048 * 2048 + 1));

TEST_F(PrefixSumTest, RandomSizes) {
    std::mt19937 random(1);
    kernel::PrefixSum sum(library, device, 300000);
    const compute::Buffer offsets = device.allocate_array<std::uint32_t>(300000, "test offsets");
    for (int round = 0; round < 20; ++round) {
        const std::uint32_t count = random() % 300000;
        Uints values = random_values(300000, 1u << 31);
        const compute::Buffer total = upload({0});
        sum.exclusive(upload(values), upload({count}), offsets, total);
        values.resize(count);
        ASSERT_EQ(read(offsets, count), exclusive_scan(values)) << count << " elements";
        ASSERT_EQ(total.read_one<std::uint32_t>(),
                  std::accumulate(values.begin(), values.end(), std::uint32_t{0}));
    }
}

TEST_F(PrefixSumTest, ElementsBeyondTheDeviceCountStayUntouched) {
    const Uints values = random_values(5000, 100);
    compute::Buffer offsets = device.allocate_array<std::uint32_t>(5000, "test offsets");
    offsets.fill(0xabcdef01u);
    kernel::PrefixSum sum(library, device, 5000);
    sum.exclusive(upload(values), upload({3000}), offsets, upload({0}));
    const Uints result = read(offsets, 5000);
    EXPECT_THAT(std::span(result).subspan(3000), testing::Each(0xabcdef01u));
}

TEST_F(PrefixSumTest, CountBeyondTheCapacityCountsAsTheCapacity) {
    const Uints values(3000, 1);
    const compute::Buffer offsets = device.allocate_array<std::uint32_t>(3000, "test offsets");
    const compute::Buffer total = upload({0});
    kernel::PrefixSum sum(library, device, 3000);
    sum.exclusive(upload(values), upload({4000000000u}), offsets, total);
    EXPECT_EQ(total.read_one<std::uint32_t>(), 3000u);
}

TEST_F(PrefixSumTest, InPlace) {
    const Uints values = random_values(10000, 100);
    const compute::Buffer buffer = upload(values);
    kernel::PrefixSum sum(library, device, values.size());
    sum.exclusive(buffer, upload({10000}), buffer, upload({0}));
    EXPECT_EQ(read(buffer, values.size()), exclusive_scan(values));
}

TEST_F(PrefixSumTest, ThreeLevelsAt64MillionElements) {
    constexpr std::uint32_t kCount = 64u << 20;
    if (device.facts().max_allocation_bytes < kCount * 4ull ||
        device.facts().global_memory_bytes < kCount * 8ull)
        GTEST_SKIP() << "the device is too small for 2^26 elements";
    compute::Buffer values = device.allocate_array<std::uint32_t>(kCount, "test values");
    values.fill(3);
    const compute::Buffer total = upload({0});
    kernel::PrefixSum sum(library, device, kCount);
    sum.exclusive(values, upload({kCount}), values, total);
    EXPECT_EQ(total.read_one<std::uint32_t>(), 3 * kCount);
    const auto offsets = values.map_read<std::uint32_t>();
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < kCount; ++i)
        wrong += offsets[i] != 3 * i;
    EXPECT_EQ(wrong, 0u);
}

TEST_F(PrefixSumTest, TooSmallABufferIsAnError) {
    kernel::PrefixSum sum(library, device, 100);
    const compute::Buffer small = upload(Uints(99));
    EXPECT_THAT([&] { sum.exclusive(small, upload({1}), small, upload({0})); },
                testing::ThrowsMessage<compute::Error>(testing::HasSubstr("holds only 99")));
}

} // namespace
