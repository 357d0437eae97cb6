/// Ordered prefix sum and compaction on the device, without a round trip to the host
/// (kernels/scan/scan.cl). The order of the input is the order of the output, always.
#pragma once

#include "host/cl/device.hpp"
#include "host/kernel/library.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace macula::kernel {

class PrefixSum {
  public:
    /// For up to `capacity` elements, at most kMaxCapacity. Allocates the sums of the levels, about
    /// 1/2048 of the input. Throws compute::Error.
    PrefixSum(Library& library, const compute::Device& device, std::uint64_t capacity);

    static constexpr std::uint64_t kMaxCapacity = std::uint64_t{1} << 31;

    /// offsets[i] = values[0] + ... + values[i - 1] for i < *count and *total = the sum of all,
    /// modulo 2^32. All are uints on the device; a count above the capacity counts as the capacity.
    /// `offsets` may be `values`; `total` must not be `count`. `stage` names the launches.
    void exclusive(const compute::Buffer& values, const compute::Buffer& count,
                   const compute::Buffer& offsets, const compute::Buffer& total,
                   const std::string& stage = "prefix sum");

    /// The offsets of the tiles of 2048 elements alone: what their elements' offsets begin with.
    /// Valid until the next call. The launches cover `at_most` elements; a count above it counts as
    /// it.
    const compute::Buffer& tile_offsets(const compute::Buffer& values, const compute::Buffer& count,
                                        const compute::Buffer& total, const std::string& stage,
                                        std::uint64_t at_most = kMaxCapacity);

    std::uint64_t capacity() const { return capacity_; }

  private:
    std::uint64_t capacity_;
    compute::Kernel sum_tiles_, scan_tiles_, scan_top_;
    /// sums_[k] is level k + 1.
    std::vector<compute::Buffer> sums_;
};

/// The indices of the elements whose flag is set, in order.
class Compaction {
  public:
    Compaction(Library& library, const compute::Device& device, std::uint64_t capacity);

    /// flags: one uint for each element, 0 or 1. Writes `indices` (room for as many as are set) and
    /// *total, their number. `total` must not be `count`. `at_most`: as of tile_offsets().
    void run(const compute::Buffer& flags, const compute::Buffer& count,
             const compute::Buffer& indices, const compute::Buffer& total,
             const std::string& stage = "compaction",
             std::uint64_t at_most = PrefixSum::kMaxCapacity);

  private:
    PrefixSum sum_;
    compute::Kernel compact_;
};

} // namespace macula::kernel
