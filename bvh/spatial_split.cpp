#include "bvh/spatial_split.hpp"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace macula::bvh {
namespace {

constexpr std::size_t kParallelSize = 16384;
constexpr std::size_t kGrain = 4096;
constexpr std::uint32_t kMostSpatialBins = 16;

struct SpatialMapping {
    Float4 origin{}, scale{}, step{};
    std::uint32_t bins = 0;

    SpatialMapping(const Box4& box, std::uint32_t bin_count) : bins(bin_count) {
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = box.hi[axis] - box.lo[axis];
            origin[axis] = box.lo[axis];
            step[axis] = extent / static_cast<float>(bins);
            scale[axis] = extent > 1e-30f ? static_cast<float>(bins) / extent : 0.0f;
        }
    }
    Int4 bin(Float4 point) const {
        const Float4 limit = splat(static_cast<float>(bins - 1));
        const Float4 x = min(max((point - origin) * scale, Float4{}), limit);
        return __builtin_convertvector(x, Int4);
    }
    float plane(std::uint32_t axis, std::uint32_t bin) const {
        return origin[axis] + step[axis] * static_cast<float>(bin);
    }
};

struct SpatialBins {
    std::array<std::array<Box4, kMostSpatialBins>, 3> box;
    std::array<std::array<std::uint32_t, kMostSpatialBins>, 3> enter{}, leave{};

    explicit SpatialBins(std::uint32_t bins) {
        for (auto& axis : box)
            std::fill_n(axis.begin(), bins, Box4{});
    }
    void add(std::span<const Reference> references, const SpatialMapping& mapping,
             const Geometry& geometry) {
        for (const Reference& reference : references) {
            const Int4 first = mapping.bin(reference.lo), last = mapping.bin(reference.hi);
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const auto from = static_cast<std::uint32_t>(first[axis]);
                const auto to = static_cast<std::uint32_t>(last[axis]);
                ++enter[axis][from];
                ++leave[axis][to];
                if (from == to)
                    box[axis][from].add(reference.box());
                else
                    chop(reference, mapping, geometry, axis, from, to);
            }
        }
    }
    void add(const SpatialBins& other, std::uint32_t bins) {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            for (std::uint32_t i = 0; i < bins; ++i) {
                box[axis][i].add(other.box[axis][i]);
                enter[axis][i] += other.enter[axis][i];
                leave[axis][i] += other.leave[axis][i];
            }
        }
    }

  private:
    static std::uint32_t bin_in(const SpatialMapping& mapping, Float4 point, std::uint32_t axis,
                                std::uint32_t from, std::uint32_t to) {
        return std::clamp(static_cast<std::uint32_t>(mapping.bin(point)[axis]), from, to);
    }

    // For estimates: the boxes of parts are computed exactly by divide().
    void chop(const Reference& reference, const SpatialMapping& mapping, const Geometry& geometry,
              std::uint32_t axis, std::uint32_t from, std::uint32_t to) {
        const ClippedTriangle triangle(geometry, reference.triangle());
        std::array<Box4, kMostSpatialBins> part;
        std::fill(part.begin() + from, part.begin() + to + 1, Box4{});
        for (int corner = 0; corner < 3; ++corner) {
            const Float4 a = triangle.v[corner], b = triangle.v[corner == 2 ? 0 : corner + 1];
            const Float4 low = a[axis] < b[axis] ? a : b, high = a[axis] < b[axis] ? b : a;
            const std::uint32_t bin_of_low = bin_in(mapping, low, axis, from, to);
            const std::uint32_t bin_of_high = bin_in(mapping, high, axis, from, to);
            part[bin_of_low].add(low);
            part[bin_of_high].add(high);
            const Float4 slope = (high - low) / splat(high[axis] - low[axis]);
            for (std::uint32_t i = bin_of_low; i < bin_of_high; ++i) {
                const Float4 point = low + slope * splat(mapping.plane(axis, i + 1) - low[axis]);
                part[i].add(point);
                part[i + 1].add(point);
            }
        }
        for (std::uint32_t i = from; i <= to; ++i) {
            // Rounding may put the first or last border beside the reference.
            if (part[i].lo[axis] <= part[i].hi[axis])
                box[axis][i].add(part_of(reference, part[i]));
        }
    }
};

SpatialSplit best_split(const SpatialBins& bins, const SpatialMapping& mapping) {
    SpatialSplit best;
    std::array<Box4, kMostSpatialBins> right;
    std::array<std::uint32_t, kMostSpatialBins> right_count{};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        if (mapping.scale[axis] == 0.0f)
            continue;
        Box4 box;
        std::uint32_t count = 0;
        for (std::uint32_t i = mapping.bins; i-- > 1;) {
            box.add(bins.box[axis][i]);
            count += bins.leave[axis][i];
            right[i] = box;
            right_count[i] = count;
        }
        box = Box4{};
        count = 0;
        for (std::uint32_t i = 1; i < mapping.bins; ++i) {
            box.add(bins.box[axis][i - 1]);
            count += bins.enter[axis][i - 1];
            if (count == 0 || right_count[i] == 0)
                continue;
            const float cost = box.half_area() * static_cast<float>(count) +
                               right[i].half_area() * static_cast<float>(right_count[i]);
            if (cost < best.cost)
                best = {cost, axis, mapping.plane(axis, i), box, right[i], count, right_count[i]};
        }
    }
    return best;
}

} // namespace

SpatialSplit find_spatial_split(std::span<const Reference> references, const Box4& box,
                                const Geometry& geometry, std::uint32_t bins) {
    const std::size_t useful = 4 + references.size() / 4;
    const SpatialMapping mapping(
        box, static_cast<std::uint32_t>(std::min<std::size_t>({bins, kMostSpatialBins, useful})));
    if (references.size() < kParallelSize) {
        SpatialBins filled(mapping.bins);
        filled.add(references, mapping, geometry);
        return best_split(filled, mapping);
    }
    const SpatialBins filled = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, references.size(), kGrain), SpatialBins(mapping.bins),
        [&](const tbb::blocked_range<std::size_t>& range, SpatialBins sum) {
            sum.add(references.subspan(range.begin(), range.size()), mapping, geometry);
            return sum;
        },
        [&](SpatialBins a, const SpatialBins& b) {
            a.add(b, mapping.bins);
            return a;
        });
    return best_split(filled, mapping);
}

SpatialSplit::Side SpatialSplit::side(const Reference& reference) const {
    if (reference.hi[axis] <= plane)
        return Side::left;
    if (reference.lo[axis] >= plane)
        return Side::right;
    Box4 whole_left = left, whole_right = right;
    whole_left.add(reference.box());
    whole_right.add(reference.box());
    const auto nl = static_cast<float>(left_count), nr = static_cast<float>(right_count);
    const float divided = left.half_area() * nl + right.half_area() * nr;
    const float as_left = whole_left.half_area() * nl + right.half_area() * (nr - 1.0f);
    const float as_right = left.half_area() * (nl - 1.0f) + whole_right.half_area() * nr;
    if (divided < as_left && divided < as_right)
        return Side::both;
    return as_left <= as_right ? Side::left : Side::right;
}

Divided divide(const Reference& reference, const SpatialSplit& split, const Geometry& geometry) {
    const ClippedTriangle triangle(geometry, reference.triangle());
    const Box4 border = triangle.crossing(split.axis, split.plane);
    Box4 left = border, right = border;
    for (const Float4 v : triangle.v) {
        if (v[split.axis] <= split.plane)
            left.add(Float4(v));
        if (v[split.axis] >= split.plane)
            right.add(Float4(v));
    }
    Divided result = {reference, reference};
    result.left.set_box(part_of(reference, left));
    result.right.set_box(part_of(reference, right));
    return result;
}

} // namespace macula::bvh
