#include "host/frame/blue_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <numeric>

#include "lib/math.h"
#include "lib/random.h"
#include "shared/blue_noise.h"

namespace macula::frame {
namespace {

constexpr std::uint32_t kSide = MACULA_NOISE_SIDE, kSlices = MACULA_NOISE_SLICES;
constexpr std::uint32_t kSlice = kSide * kSide, kRows = kSide * kSlices;
constexpr std::uint32_t kTexels = kSlice * kSlices;
constexpr std::uint32_t kInitial = kTexels / 10; // of Ulichney's initial binary pattern

// Standard deviations in texels and in slices (Wolfe et al. 2022), and where the Gaussian in the
// image is cut off: there it has fallen to a thousandth of its peak.
constexpr float kSigma = 1.9f, kSigmaInTime = 1.9f;
constexpr int kReach = 7; // texels

using Energy = std::int32_t;
constexpr Energy kPeak = 1 << 20; // of one texel; all together send less than 32 of it
constexpr Energy kChosen = 1 << 28;

Energy gaussian(int squared_distance, float sigma) {
    constexpr float log2_e = 0x1.715476p+0f;
    const float exponent = static_cast<float>(squared_distance) * log2_e / (2.0f * sigma * sigma);
    return static_cast<Energy>(std::rint(shared::m_exp2(-exponent) * static_cast<float>(kPeak)));
}

// The void-and-cluster method's pattern of chosen texels. The energy of a texel is the sum of what
// the chosen ones send to it; the chosen ones themselves lie above all others. So the largest void
// has the least energy of all, and the tightest cluster the most.
class Pattern {
  public:
    explicit Pattern(std::uint32_t seed) : energy_(kTexels) {
        for (int y = -kReach; y <= kReach; ++y)
            for (int x = -kReach; x <= kReach; ++x)
                in_image_[y + kReach][x + kReach] = gaussian(x * x + y * y, kSigma);
        for (std::uint32_t t = 0; t < kSlices; ++t) {
            const int distance = static_cast<int>(std::min(t, kSlices - t));
            in_time_[t] = gaussian(distance * distance, kSigmaInTime);
        }
        // Far less than any two different energies: it decides between equal ones alone.
        for (std::uint32_t i = 0; i < kTexels; ++i)
            energy_[i] = static_cast<Energy>(shared::random_bits(seed, i, 0) & 63u);
        for (std::uint32_t row = 0; row < kRows; ++row)
            note_row(row);
    }

    bool is_free(std::uint32_t texel) const { return energy_[texel] < kChosen; }
    void choose(std::uint32_t texel) { change(texel, 1); }
    void release(std::uint32_t texel) { change(texel, -1); }
    std::uint32_t largest_void() const {
        return find(least_, [](auto a, auto b) { return a < b; });
    }
    std::uint32_t tightest_cluster() const {
        return find(most_, [](auto a, auto b) { return a > b; });
    }

  private:
    void change(std::uint32_t texel, Energy sign) {
        energy_[texel] += sign * kChosen;
        const std::uint32_t slice = texel / kSlice, at = texel % kSlice;
        const std::uint32_t x = at % kSide, y = at / kSide;
        for (std::uint32_t j = 0; j <= 2 * kReach; ++j) {
            const std::uint32_t row = slice * kSide + (y + j - kReach) % kSide;
            for (std::uint32_t i = 0; i <= 2 * kReach; ++i)
                energy_[row * kSide + (x + i - kReach) % kSide] += sign * in_image_[j][i];
            note_row(row);
        }
        for (std::uint32_t t = 1; t < kSlices; ++t) {
            const std::uint32_t there = (slice + t) % kSlices * kSlice + at;
            energy_[there] += sign * in_time_[t];
            note_row(there / kSide);
        }
    }

    void note_row(std::uint32_t row) {
        const Energy* texels = energy_.data() + row * kSide;
        Energy least = texels[0], most = texels[0];
        for (std::uint32_t i = 1; i < kSide; ++i) {
            least = std::min(least, texels[i]);
            most = std::max(most, texels[i]);
        }
        least_[row] = least;
        most_[row] = most;
    }

    // The first texel whose energy no other one's is better than.
    template <class Better>
    std::uint32_t find(const std::array<Energy, kRows>& of_rows, Better better) const {
        Energy best = of_rows[0];
        for (const Energy energy : of_rows)
            best = better(energy, best) ? energy : best;
        const auto row = std::find(of_rows.begin(), of_rows.end(), best) - of_rows.begin();
        const auto texel = std::find(energy_.begin() + row * kSide, energy_.end(), best);
        return static_cast<std::uint32_t>(texel - energy_.begin());
    }

    Energy in_image_[2 * kReach + 1][2 * kReach + 1];
    std::array<Energy, kSlices> in_time_;
    std::vector<Energy> energy_;
    std::array<Energy, kRows> least_, most_;
};

// A tenth of the texels, moved from clusters into voids until nothing moves.
Pattern initial_pattern(std::uint32_t seed) {
    Pattern pattern(seed);
    std::uint32_t chosen = 0;
    for (std::uint32_t draw = 0; chosen < kInitial; ++draw) {
        const std::uint32_t texel = shared::random_bits(seed, draw, 1) % kTexels;
        if (pattern.is_free(texel)) {
            pattern.choose(texel);
            ++chosen;
        }
    }
    for (std::uint32_t move = 0; move < kTexels; ++move) {
        const std::uint32_t from = pattern.tightest_cluster();
        pattern.release(from);
        const std::uint32_t to = pattern.largest_void();
        pattern.choose(to);
        if (to == from)
            break;
    }
    return pattern;
}

// The order in which texels are chosen: of the initial pattern the tightest cluster is the last,
// of the others the largest void the first.
std::vector<std::uint32_t> order_of_texels(std::uint32_t seed) {
    const Pattern initial = initial_pattern(seed);
    std::vector<std::uint32_t> order(kTexels);
    Pattern pattern = initial;
    for (std::uint32_t rank = kInitial; rank-- > 0;) {
        order[rank] = pattern.tightest_cluster();
        pattern.release(order[rank]);
    }
    pattern = initial;
    for (std::uint32_t rank = kInitial; rank < kTexels; ++rank) {
        order[rank] = pattern.largest_void();
        pattern.choose(order[rank]);
    }
    return order;
}

} // namespace

std::vector<std::uint16_t> make_blue_noise(std::uint32_t seed) {
    std::vector<std::uint16_t> ranks(kTexels);
    std::array<std::uint16_t, kSlices> next{};
    for (const std::uint32_t texel : order_of_texels(seed))
        ranks[texel] = next[texel / kSlice]++;
    return ranks;
}

const std::vector<std::uint32_t>& blue_noise() {
    static const std::vector<std::uint32_t> packed = [] {
        auto second = std::async(std::launch::async, make_blue_noise, 2u);
        const std::vector<std::uint16_t> u = make_blue_noise(1), v = second.get();
        std::vector<std::uint32_t> texels(kTexels);
        // The middle of each rank's part of 16 bits.
        constexpr std::uint32_t part = 65536 / kSlice;
        for (std::uint32_t i = 0; i < kTexels; ++i)
            texels[i] = (u[i] * part + part / 2) << 16 | (v[i] * part + part / 2);
        return texels;
    }();
    return packed;
}

} // namespace macula::frame
