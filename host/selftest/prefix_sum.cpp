#include "host/selftest/selftest.hpp"

#include "host/kernel/prefix_sum.hpp"

#include <fmt/format.h>

namespace macula::selftest {
namespace {

// Empty when all sums of `count` values agree, otherwise what differs.
std::string compare(const compute::Device& device, kernel::PrefixSum& prefix_sum,
                    std::uint32_t count) {
    std::vector<std::uint32_t> values(count);
    for (std::uint32_t i = 0; i < count; ++i)
        values[i] = (i * 2654435761u) >> 30;
    const compute::Buffer sums = device.upload(std::span(values), "prefix sum test");
    const compute::Buffer length = device.upload(std::span(&count, 1), "prefix sum length");
    const compute::Buffer total = device.allocate_array<std::uint32_t>(1, "prefix sum total");
    prefix_sum.exclusive(sums, length, sums, total);
    const auto found = sums.map_read<std::uint32_t>();
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < count; sum += values[i++]) {
        if (found[i] != sum)
            return fmt::format("sum {} of {} is {}, expected {}", i, count, found[i], sum);
    }
    const std::uint32_t found_total = total.read_one<std::uint32_t>();
    return found_total == sum
               ? ""
               : fmt::format("total of {} is {}, expected {}", count, found_total, sum);
}

} // namespace

Outcome check_prefix_sum(const compute::Device& device, kernel::Library& library) {
    constexpr std::uint32_t lengths[] = {1, 2, 15, 255, 256, 257, 4095, 65536, 300001};
    for (const std::uint32_t count : lengths) {
        kernel::PrefixSum prefix_sum(library, device, count);
        const std::string wrong = compare(device, prefix_sum, count);
        if (!wrong.empty())
            return {"prefix sum", false, wrong};
    }
    return {"prefix sum", true, fmt::format("{} lengths up to 300001", std::size(lengths))};
}

} // namespace macula::selftest
