// Random numbers, strata and the warps from them.
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "lib/sampling.h"

namespace {
using namespace macula::shared;

// Chi-square statistic of counts that should be equal.
double chi_square(const std::vector<int>& counts) {
    double total = 0.0, sum = 0.0;
    for (const int n : counts)
        total += n;
    const double expected = total / static_cast<double>(counts.size());
    for (const int n : counts)
        sum += (n - expected) * (n - expected) / expected;
    return sum;
}

// Mean and spread of chi-square with k - 1 degrees of freedom: 5 standard deviations around it.
void expect_uniform(const std::vector<int>& counts) {
    const double freedom = static_cast<double>(counts.size()) - 1.0;
    EXPECT_NEAR(chi_square(counts), freedom, 5.0 * std::sqrt(2.0 * freedom));
}

TEST(Random, IsUniformInEveryArgument) {
    for (int argument = 0; argument < 5; ++argument) {
        std::vector<int> counts(256, 0);
        for (uint i = 0; i < 100000; ++i) {
            std::array<uint, 5> a{7, 1, 0, 2, 5};
            a[static_cast<std::size_t>(argument)] = i;
            const float x = random_unit(random_key(a[0], a[1], a[4]), a[2], a[3]);
            ASSERT_TRUE(x >= 0.0f && x < 1.0f);
            ++counts[static_cast<std::size_t>(x * 256.0f)];
        }
        expect_uniform(counts);
    }
}

TEST(Random, NeighboursInPixelFrameSampleAndDimensionAreIndependent) {
    const auto value = [](uint pixel, uint frame, uint sample, uint dimension) {
        return random_unit(random_key(pixel, frame, 1), sample, dimension);
    };
    std::array<std::vector<int>, 4> counts;
    counts.fill(std::vector<int>(256, 0));
    for (uint i = 0; i < 60000; ++i) {
        const auto here = static_cast<std::size_t>(value(i, 0, 0, 0) * 16.0f);
        const std::array<float, 4> near{value(i + 1, 0, 0, 0), value(i, 1, 0, 0), value(i, 0, 1, 0),
                                        value(i, 0, 0, 1)};
        for (std::size_t k = 0; k < 4; ++k)
            ++counts[k][here * 16 + static_cast<std::size_t>(near[k] * 16.0f)];
    }
    for (const std::vector<int>& table : counts)
        expect_uniform(table);
}

TEST(Random, SampleAndDimensionDoNotCollide) {
    std::set<uint> seen;
    for (uint sample = 0; sample < 256; ++sample)
        for (uint dimension = 0; dimension < 64; ++dimension)
            seen.insert(random_bits(123u, sample, dimension));
    EXPECT_GE(seen.size(), 256u * 64u - 2u);
}

TEST(Strata, GridHasExactlyTheNumberOfSamples) {
    for (uint count = 1; count <= 300; ++count) {
        const uint columns = strata_columns(count);
        EXPECT_EQ(count % columns, 0u);
        EXPECT_GE(columns * columns, count);
    }
    EXPECT_EQ(strata_columns(16), 4u);
    EXPECT_EQ(strata_columns(8), 4u);
    EXPECT_EQ(strata_columns(1), 1u);
}

TEST(Strata, EachCellGetsOnePoint) {
    for (const uint count : {1u, 7u, 8u, 16u, 25u, 4096u}) {
        const uint columns = strata_columns(count), rows = count / columns;
        const Strata strata = make_strata(columns, count);
        std::vector<int> hits(count, 0);
        for (uint i = 0; i < count; ++i) {
            float u = -1, v = -1;
            stratified_point(random_key(9, 9, 9), i, 2, i, &strata, &u, &v);
            ASSERT_TRUE(u >= 0.0f && u < 1.0f && v >= 0.0f && v < 1.0f);
            const auto cell = static_cast<uint>(u * static_cast<float>(columns)) +
                              columns * static_cast<uint>(v * static_cast<float>(rows));
            ++hits[cell];
        }
        for (const int n : hits)
            EXPECT_EQ(n, 1) << count;
    }
}

double dot(float3 a, float3 b) {
    return double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
}

TEST(Basis, IsOrthonormalAlsoNearTheSouthPole) {
    for (const float3 raw : {float3{0, 0, 1}, float3{0, 0, -1}, float3{1e-6f, 0, -1},
                             float3{0.6f, -0.48f, 0.64f}, float3{-1, 0, 0}, float3{0, 1, 0}}) {
        const float3 n = unit3(raw, {0, 0, 1});
        float3 t{}, b{};
        const Basis basis = make_basis(n);
        t = basis.tangent;
        b = basis.bitangent;
        EXPECT_NEAR(dot(t, t), 1.0, 1e-6);
        EXPECT_NEAR(dot(b, b), 1.0, 1e-6);
        EXPECT_NEAR(dot(t, b), 0.0, 1e-6);
        EXPECT_NEAR(dot(t, n), 0.0, 1e-6);
        EXPECT_NEAR(dot(b, n), 0.0, 1e-6);
    }
}

// The mean of cos and cos^2 under the cosine density are 2/3 and 1/2, tangential means are 0.
TEST(Warps, CosineDirectionsHaveTheCosinesMoments) {
    const float3 n = unit3({0.3f, -0.8f, 0.5f}, {0, 0, 1});
    double cosine = 0, squared = 0, side = 0;
    const uint count = 1u << 16;
    const Strata strata = make_strata(256, count);
    const Basis basis = make_basis(n);
    for (uint i = 0; i < count; ++i) {
        float u = 0, v = 0;
        stratified_point(random_key(4, 0, 0), i, 0, i, &strata, &u, &v);
        const float3 d = cosine_direction(&basis, u, v);
        ASSERT_NEAR(dot(d, d), 1.0, 1e-5);
        ASSERT_GE(dot(d, n), -1e-6);
        cosine += dot(d, n);
        squared += dot(d, n) * dot(d, n);
        side += d.x - n.x * dot(d, n);
    }
    EXPECT_NEAR(cosine / count, 2.0 / 3.0, 1e-4);
    EXPECT_NEAR(squared / count, 0.5, 1e-4);
    EXPECT_NEAR(side / count, 0.0, 1e-3);
}

TEST(Warps, ConeDirectionsAreUniformInTheConesHeight) {
    const float3 n = unit3({-0.5f, 0.5f, -0.7f}, {0, 0, 1});
    const float height = 0.25f;
    std::vector<int> counts(16, 0);
    for (uint i = 0; i < 40000; ++i) {
        const uint key = random_key(i, 0, 0);
        const float3 d = cone_direction(n, height, random_unit(key, 0, 0), random_unit(key, 0, 1));
        const double drop = 1.0 - dot(d, n);
        ASSERT_TRUE(drop > -1e-6 && drop < height + 1e-6);
        ++counts[static_cast<std::size_t>(std::min(std::max(drop, 0.0) / height * 16.0, 15.0))];
    }
    expect_uniform(counts);
}

} // namespace
