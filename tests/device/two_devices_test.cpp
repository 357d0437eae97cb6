// Two devices of one platform. PoCL makes as many as its environment asks for at its first use, so
// this is a program of its own.
#include "host/kernel/prefix_sum.hpp"

#include <gtest/gtest.h>

#include <stdlib.h>

#include <numeric>
#include <thread>

namespace {

using namespace macula;

const int kTwoPocls = setenv("POCL_DEVICES", "pthread basic", 1);

std::vector<std::uint32_t> prefix_sums(const compute::Device& device, kernel::Library& library) {
    std::vector<std::uint32_t> values(10000);
    std::iota(values.begin(), values.end(), 0u);
    const std::vector<std::uint32_t> count{10000};
    const compute::Buffer buffer = device.upload(std::span(values), "values");
    kernel::PrefixSum sum(library, device, values.size());
    sum.exclusive(buffer, device.upload(std::span(count), "count"), buffer,
                  device.allocate(4, "total"));
    const auto map = buffer.map_read<std::uint32_t>();
    return {map.begin(), map.end()};
}

TEST(TwoPoclDevices, ComputeAtOnceWithOneLibraryAndAgree) {
    ASSERT_EQ(kTwoPocls, 0);
    const std::vector<compute::DeviceFacts> all = compute::enumerate();
    if (all.size() < 2)
        GTEST_SKIP() << "there is only one device: PoCL is not installed";
    const compute::Device first = compute::open("0"), second = compute::open("1");
    kernel::Library library;
    std::vector<std::uint32_t> one, two;
    std::thread other([&] { two = prefix_sums(second, library); });
    one = prefix_sums(first, library);
    other.join();
    EXPECT_EQ(one, two);
    EXPECT_EQ(one.at(9999), 9998u * 9999u / 2u);
    EXPECT_FALSE(first.timeline().take().empty());
    EXPECT_FALSE(second.timeline().take().empty());
}

} // namespace
