// Reflection and refraction against closed forms (lib/optics.h).
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "lib/optics.h"

namespace {
using namespace macula::shared;

struct Exact {
    double reflectance, cosine; // of the refracted ray; 0: none
};

// Fresnel's equations in double precision.
Exact exact(double cosine, double from, double to) {
    const double sine = std::sqrt(1.0 - cosine * cosine) * from / to;
    if (sine >= 1.0)
        return {1.0, 0.0};
    const double beyond = std::sqrt(1.0 - sine * sine);
    const double s = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    const double p = (from * beyond - to * cosine) / (from * beyond + to * cosine);
    return {0.5 * (s * s + p * p), beyond};
}

TEST(Fresnel, NormalIncidenceIsTheSquareOfTheIndexDifference) {
    for (const float n : {1.0f, 1.33f, 1.5f, 2.4f, 10.0f}) {
        float refracted = 0.0f;
        const double expected = std::pow((n - 1.0) / (n + 1.0), 2.0);
        EXPECT_NEAR(fresnel_reflectance(1.0f, 1.0f / n, &refracted), expected, 1e-6);
        EXPECT_NEAR(fresnel_reflectance(1.0f, n, &refracted), expected, 1e-6);
        EXPECT_FLOAT_EQ(refracted, 1.0f);
    }
}

TEST(Fresnel, EveryAngleAndBothSidesAgreeWithDoublePrecision) {
    for (const double n : {0.1, 0.75, 1.0, 1.3, 1.5, 2.4, 10.0})
        for (int step = 0; step <= 1000; ++step) {
            const auto cosine = static_cast<float>(step / 1000.0);
            for (const bool inside : {false, true}) {
                const auto eta = static_cast<float>(inside ? n : 1.0 / n);
                float refracted = -1.0f;
                const float found = fresnel_reflectance(cosine, eta, &refracted);
                const Exact e = exact(cosine, eta, 1.0);
                // Near the critical angle the cosine is the root of a difference.
                const double tolerance = e.cosine < 0.02 ? 2e-2 : 2e-5;
                EXPECT_NEAR(found, e.reflectance, tolerance) << n << ' ' << cosine;
                EXPECT_NEAR(refracted, e.cosine, e.cosine < 0.02 ? 2e-3 : 2e-5);
                EXPECT_GE(found, 0.0f);
                EXPECT_LE(found, 1.0f);
            }
        }
}

TEST(Fresnel, BrewstersAngleReflectsHalfOfTheOtherPolarisation) {
    const double n = 1.5, angle = std::atan(n);
    float refracted = 0.0f;
    const float found = fresnel_reflectance(static_cast<float>(std::cos(angle)),
                                            static_cast<float>(1 / n), &refracted);
    EXPECT_NEAR(found, 0.5 * std::pow((1 - n * n) / (1 + n * n), 2.0), 1e-6);
}

TEST(Fresnel, BeyondTheCriticalAngleAllIsReflected) {
    const double critical = std::asin(1.0 / 1.5);
    float refracted = 1.0f;
    EXPECT_EQ(fresnel_reflectance(static_cast<float>(std::cos(critical + 1e-3)), 1.5f, &refracted),
              1.0f);
    EXPECT_EQ(refracted, 0.0f);
    EXPECT_LT(fresnel_reflectance(static_cast<float>(std::cos(critical - 1e-3)), 1.5f, &refracted),
              0.9f);
    EXPECT_GT(refracted, 0.0f);
}

TEST(Fresnel, GrazingLightIsReflectedWhole) {
    float refracted = 0.0f;
    EXPECT_EQ(fresnel_reflectance(0.0f, 1.0f / 1.5f, &refracted), 1.0f);
    EXPECT_EQ(fresnel_reflectance(0.0f, 1.0f, &refracted), 1.0f); // no boundary at all
}

// A ray that falls in the plane of x and y onto a surface that faces +y.
float3 falling(double angle) {
    return {static_cast<float>(std::sin(angle)), static_cast<float>(-std::cos(angle)), 0.0f};
}

constexpr float3 kUp = {0.0f, 1.0f, 0.0f};
constexpr float3 kWhite = {1.0f, 1.0f, 1.0f};
constexpr float3 kNothing = {0.0f, 0.0f, 0.0f};

TEST(ContinueRay, DirectionsObeySnellsLaw) {
    for (int degrees = 0; degrees < 90; degrees += 3)
        for (const bool behind : {false, true}) {
            const double angle = degrees * std::numbers::pi / 180.0;
            Continuation c;
            continue_ray(falling(angle), kUp, kUp, behind, kNothing, kWhite, 1.5f, &c);
            EXPECT_NEAR(c.reflected.x, std::sin(angle), 1e-6);
            EXPECT_NEAR(c.reflected.y, std::cos(angle), 1e-6);
            const double sine = std::sin(angle) * (behind ? 1.5 : 1.0 / 1.5);
            if (sine > 0.999)
                continue;
            EXPECT_NEAR(c.refracted.x, sine, 2e-6) << degrees;
            EXPECT_NEAR(c.refracted.y, -std::sqrt(1 - sine * sine), 2e-5) << degrees;
            EXPECT_EQ(c.refracted.z, 0.0f);
        }
}

TEST(ContinueRay, TotalInternalReflectionLeavesNothingToRefract) {
    Continuation c;
    continue_ray(falling(0.9), kUp, kUp, true, kNothing, kWhite, 1.5f, &c);
    EXPECT_EQ(c.refracted_weight.x, 0.0f);
    EXPECT_EQ(c.reflected_weight.x, 1.0f);
}

TEST(ContinueRay, WeightsSumToReflectivityAndTransmission) {
    const float3 mirror = {0.1f, 0.2f, 0.0f}, glass = {0.8f, 0.5f, 0.25f};
    for (int step = 0; step < 157; ++step)
        for (const bool behind : {false, true}) {
            Continuation c;
            continue_ray(falling(0.01 * step), kUp, kUp, behind, mirror, glass, 1.33f, &c);
            EXPECT_NEAR(c.reflected_weight.x + c.refracted_weight.x, 0.9f, 1e-6f);
            EXPECT_NEAR(c.reflected_weight.y + c.refracted_weight.y, 0.7f, 1e-6f);
            EXPECT_NEAR(c.reflected_weight.z + c.refracted_weight.z, 0.25f, 1e-6f);
        }
}

TEST(ContinueRay, RaysStayOnTheirSideOfATriangleWhoseShadingNormalIsBent) {
    for (int bend = -80; bend <= 80; bend += 5)
        for (int degrees = -85; degrees <= 85; degrees += 5)
            for (const bool behind : {false, true}) {
                const double tilt = bend * std::numbers::pi / 180.0;
                const float3 bent = {static_cast<float>(std::sin(tilt)),
                                     static_cast<float>(std::cos(tilt)), 0.0f};
                Continuation c;
                continue_ray(falling(degrees * std::numbers::pi / 180.0), kUp, bent, behind, kWhite,
                             kWhite, 1.5f, &c);
                EXPECT_GE(c.reflected.y, 0.0f) << bend << ' ' << degrees;
                EXPECT_LE(c.refracted.y, 0.0f) << bend << ' ' << degrees;
                EXPECT_NEAR(dot3(c.reflected, c.reflected), 1.0f, 1e-5f);
                EXPECT_NEAR(dot3(c.refracted, c.refracted), 1.0f, 1e-5f);
            }
}

TEST(ContinueRay, EqualIndicesChangeNothing) {
    Continuation c;
    const float3 direction = falling(0.7);
    continue_ray(direction, kUp, kUp, false, kNothing, kWhite, 1.0f, &c);
    EXPECT_NEAR(c.refracted.x, direction.x, 1e-6f);
    EXPECT_NEAR(c.refracted.y, direction.y, 1e-6f);
    EXPECT_NEAR(c.refracted_weight.x, 1.0f, 1e-6f);
}

} // namespace
