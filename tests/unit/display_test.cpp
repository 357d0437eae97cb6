// Displays: the numbers of the built-in ones, true angles off-centre and on canted eyes, files.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/display.hpp"

namespace macula::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Display parse(const std::string& text) {
    return parse_display(text, "some.toml", false);
}

TEST(Display, Dk2HasThePapersNumbersAndMirroredEyes) {
    const Display d = find_display("dk2");
    EXPECT_EQ(d.width, 1182u);
    EXPECT_EQ(d.height, 1464u);
    const EyeView &left = d.eye(Eye::left), &right = d.eye(Eye::right);
    EXPECT_EQ(left.tan_up, 1.3299);
    EXPECT_EQ(left.tan_down, 1.3299);
    EXPECT_EQ(left.tan_left, 1.0586);
    EXPECT_EQ(left.tan_right, 1.0924);
    EXPECT_EQ(right.tan_left, left.tan_right);
    EXPECT_EQ(right.tan_right, left.tan_left);
    EXPECT_LT(left.offset.x, right.offset.x);
    EXPECT_EQ(d.eye(Eye::mono).offset, glm::dvec3(0.0));
    EXPECT_EQ(d.eye(Eye::mono).tan_left, left.tan_left);
}

TEST(Display, AllBuiltInOnesAreValidAndFoundByName) {
    for (const Display& display : builtin_displays()) {
        EXPECT_NO_THROW(check(display)) << display.name;
        EXPECT_EQ(find_display(display.name).source, display.source);
    }
}

TEST(Display, AnUnknownNameListsTheKnownOnes) {
    EXPECT_THAT([] { find_display("cv1"); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("\"cv1\""), HasSubstr("dk2"), HasSubstr("quest_pro"))));
}

TEST(Display, EdgesLieAtTheTangents) {
    for (const Display& d : builtin_displays()) {
        const EyeView& view = d.eye(Eye::mono);
        const glm::dvec3 corner =
            glm::transpose(view.head_from_eye) * pixel_direction(d, Eye::mono, 0.0, 0.0);
        EXPECT_NEAR(corner.x / -corner.z, -view.tan_left, 1e-12) << d.name;
        EXPECT_NEAR(corner.y / -corner.z, view.tan_up, 1e-12) << d.name;
    }
}

TEST(Display, ProjectionUndoesThePixelsDirection) {
    for (const Display& d : builtin_displays())
        for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
            double x = 0.0, y = 0.0;
            ASSERT_TRUE(project(d, eye, pixel_direction(d, eye, 17.25, 900.5), x, y));
            EXPECT_NEAR(x, 17.25, 1e-8) << d.name << ' ' << name(eye);
            EXPECT_NEAR(y, 900.5, 1e-8) << d.name << ' ' << name(eye);
        }
}

TEST(Display, WhatLiesBehindTheEyeHasNoImagePoint) {
    double x = 0.0, y = 0.0;
    EXPECT_FALSE(project(find_display("dk2"), Eye::left, {0.0, 0.0, 1.0}, x, y));
    EXPECT_FALSE(project(find_display("dk2"), Eye::left, {1.0, 0.0, 0.0}, x, y));
}

// cos e = (1 + g.p) / (|g| |p|) for points g and p of the image plane.
TEST(Eccentricity, AgreesWithTheClosedFormOffCentreOnAnAsymmetricEye) {
    const Display d = find_display("quest_pro");
    const EyeView& view = d.eye(Eye::left);
    const glm::dvec3 gaze = direction_of_angles(-22.0, 13.0);
    const double gx = gaze.x / -gaze.z, gy = gaze.y / -gaze.z;
    for (const auto& [x, y] :
         {std::pair{0.5, 0.5}, {2159.5, 3.5}, {700.5, 2000.5}, {1340.0, 800.0}}) {
        const double px = x / d.width * (view.tan_left + view.tan_right) - view.tan_left;
        const double py = view.tan_up - y / d.height * (view.tan_up + view.tan_down);
        const double cosine = (1.0 + gx * px + gy * py) / std::sqrt(1.0 + gx * gx + gy * gy) /
                              std::sqrt(1.0 + px * px + py * py);
        EXPECT_NEAR(eccentricity(d, Eye::left, x, y, gaze), kDegrees * std::acos(cosine), 1e-9);
    }
}

TEST(Eccentricity, IsTheDifferenceOfAnglesAlongTheHorizontalMeridian) {
    const Display d = find_display("dk2");
    for (const double degrees : {-40.0, -10.0, 0.0, 10.0, 45.0}) {
        double x = 0.0, y = 0.0;
        ASSERT_TRUE(project(d, Eye::left, direction_of_angles(degrees, 0.0), x, y));
        EXPECT_NEAR(eccentricity(d, Eye::left, x, y, direction_of_angles(20.0, 0.0)),
                    std::fabs(degrees - 20.0), 1e-9);
    }
}

TEST(Eccentricity, OfACantedEyeIsMeasuredInHeadSpace) {
    const Display d = find_display("pimax_8k_large");
    double x = 0.0, y = 0.0;
    // The left eye's axis points 10 degrees to the left.
    ASSERT_TRUE(project(d, Eye::left, direction_of_angles(-10.0, 0.0), x, y));
    const EyeView& view = d.eye(Eye::left);
    EXPECT_NEAR(x, view.tan_left / (view.tan_left + view.tan_right) * d.width, 1e-9);
    EXPECT_NEAR(y, 0.5 * d.height, 1e-9);
    EXPECT_NEAR(eccentricity(d, Eye::left, x, y, {0.0, 0.0, -1.0}), 10.0, 1e-9);
    EXPECT_NEAR(eccentricity(d, Eye::left, 0.0, 0.5 * d.height, direction_of_angles(-10.0, 0.0)),
                kDegrees * std::atan(view.tan_left), 1e-9);
}

TEST(Eccentricity, IsExactForTinyAndForOppositeAngles) {
    const glm::dvec3 a = direction_of_angles(0.0, 0.0);
    EXPECT_NEAR(angle_degrees(a, direction_of_angles(1e-7, 0.0)), 1e-7, 1e-16);
    EXPECT_NEAR(angle_degrees(a, direction_of_angles(180.0 - 1e-7, 0.0)), 180.0 - 1e-7, 1e-12);
    EXPECT_EQ(angle_degrees(a, a), 0.0);
}

TEST(PixelsPerDegree, AgreesWithFiniteDifferencesOfSolidAngle) {
    const Display d = find_display("quest_pro");
    for (const auto& [x, y] : {std::pair{1340.0, 900.0}, {10.0, 20.0}, {2100.0, 2200.0}}) {
        constexpr double h = 1e-3;
        const glm::dvec3 right =
            pixel_direction(d, Eye::left, x + h, y) - pixel_direction(d, Eye::left, x - h, y);
        const glm::dvec3 down =
            pixel_direction(d, Eye::left, x, y + h) - pixel_direction(d, Eye::left, x, y - h);
        const double side = std::sqrt(glm::length(glm::cross(right, down))) / (2.0 * h);
        EXPECT_NEAR(pixels_per_degree(d, Eye::left, x, y), 1.0 / (side * kDegrees), 1e-4);
    }
}

TEST(PixelsPerDegree, OfADesktopMatchesItsWidthAndDistance) {
    const Display d = find_display("desktop_1080p");
    // 1920 pixels on 531 mm, seen from 600 mm: pixels in one degree straight ahead.
    EXPECT_NEAR(pixels_per_degree(d, Eye::mono, 960.0, 540.0), 1920.0 / 531.0 * 600.0 / kDegrees,
                1e-9);
}

TEST(Angles, AndDirectionsAreInverse) {
    for (const auto& [right, up] : {std::pair{0.0, 0.0}, {30.0, -20.0}, {-170.0, 85.0}}) {
        const glm::dvec2 angles = angles_of_direction(direction_of_angles(right, up));
        EXPECT_NEAR(angles.x, right, 1e-12);
        EXPECT_NEAR(angles.y, up, 1e-12);
    }
    EXPECT_EQ(direction_of_angles(0.0, 0.0), glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_GT(direction_of_angles(10.0, 0.0).x, 0.0);
    EXPECT_GT(direction_of_angles(0.0, 10.0).y, 0.0);
}

TEST(Distortion, IsInvertedWhereItGrows) {
    const Distortion k = {0.22, 0.24, -0.01};
    for (const double r : {0.0, 0.1, 0.7, 1.3})
        EXPECT_NEAR(undistort(k, distort(k, r)), r, 1e-12);
    EXPECT_EQ(distort({}, 0.8), 0.8);
    EXPECT_NEAR(distort({0.5}, 0.2), 0.2 * (1.0 + 0.5 * 0.04), 1e-15);
}

constexpr const char* kHeadset = R"(name = "mine"
width = 1000
height = 1200
refresh_hz = 90
ipd_mm = 66
cant_degrees = 5
[left]
tan_left = 1.2
tan_right = 0.9
up_degrees = 45
down_degrees = 50
[distortion]
red = [0.1, 0.2]
)";

TEST(DisplayFile, HeadsetWithCantAndDistortion) {
    const Display d = parse(kHeadset);
    EXPECT_EQ(d.name, "mine");
    EXPECT_NEAR(d.ipd(), 0.066, 1e-9);
    EXPECT_NEAR(d.eye(Eye::left).tan_up, 1.0, 1e-7);
    EXPECT_NEAR(d.eye(Eye::right).tan_left, 0.9, 1e-7);
    EXPECT_NEAR(angles_of_direction(-d.eye(Eye::left).head_from_eye[2]).x, -5.0, 1e-6);
    EXPECT_NEAR(angles_of_direction(-d.eye(Eye::right).head_from_eye[2]).x, 5.0, 1e-6);
    EXPECT_EQ(d.distortion[0].size(), 2u);
    EXPECT_TRUE(d.distortion[1].empty());
}

TEST(DisplayFile, ColoursWithoutADistortionHaveThatOfGreen) {
    const std::string screen =
        "width = 9\nheight = 9\n[screen]\nwidth_mm = 90\ndistance_mm = 300\n";
    const Display d = parse(screen + "[distortion]\ngreen = [0.1]\nblue = [0.2]\n");
    EXPECT_EQ(d.distortion[0], Distortion{0.1});
    EXPECT_EQ(d.distortion[1], Distortion{0.1});
    EXPECT_EQ(d.distortion[2], Distortion{0.2});
}

TEST(DisplayFile, JsonIsReadLikeToml) {
    const Display d = parse_display(
        R"({"width": 800, "height": 600, "screen": {"width_mm": 400, "distance_mm": 500}})",
        "folder/flat.json", true);
    EXPECT_EQ(d.name, "flat");
    EXPECT_NEAR(d.eye(Eye::mono).tan_left, 0.4, 1e-9);
    EXPECT_NEAR(d.eye(Eye::mono).tan_up, 0.3, 1e-9);
    // Each eye sees the same screen from its own place.
    EXPECT_LT(d.eye(Eye::left).tan_left, d.eye(Eye::right).tan_left);
}

TEST(DisplayFile, ErrorsNameFileLineAndKey) {
    const auto message = [](const std::string& text) { return [text] { parse(text); }; };
    EXPECT_THAT(message("width = 1\nheight = 'x'\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.toml:2"), HasSubstr("'height'"))));
    EXPECT_THAT(message("width = 0\nheight = 2\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.toml:1"), HasSubstr("'width'"))));
    EXPECT_THAT(message("width = 1\nheight = 2\n"),
                ThrowsMessage<SceneError>(HasSubstr("exactly one of [left]")));
    EXPECT_THAT(message("width = 1\n = 2\n"), ThrowsMessage<SceneError>(HasSubstr("some.toml:2")));
    EXPECT_THAT(
        message("width = 9\nheight = 9\ncolour = 3\n[screen]\nwidth_mm = 9\ndistance_mm = 9"),
        ThrowsMessage<SceneError>(AllOf(HasSubstr("some.toml:3"), HasSubstr("'colour'"))));
    EXPECT_THAT(message("width = 9\nheight = 9\n[left]\ntan_left = 1\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.toml:3"), HasSubstr("tan_right"))));
    EXPECT_THAT(message(std::string(kHeadset) + "blue = [1, 'a']\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.toml:14"), HasSubstr("'blue'"))));
}

TEST(DisplayFile, BrokenJsonIsAnErrorWithItsLine) {
    const auto parse_json = [](const std::string& text) {
        return [text] { parse_display(text, "x.json", true); };
    };
    EXPECT_THAT(parse_json("{\n\"width\": ,\n}"),
                ThrowsMessage<SceneError>(HasSubstr("x.json:2: no valid JSON")));
    EXPECT_THAT(parse_json("{\"width\": 11.1e11111}"),
                ThrowsMessage<SceneError>(HasSubstr("x.json: no valid JSON")));
    EXPECT_THAT(parse_json("[1]"), ThrowsMessage<SceneError>(HasSubstr("an object")));
    EXPECT_THAT(parse_json(R"({"width": 1e300, "height": 2})"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("x.json: key 'width'"))));
    EXPECT_THAT(parse_json(std::string(100, '[')), ThrowsMessage<SceneError>(HasSubstr("nested")));
}

TEST(DisplayFile, AMissingFileIsNamed) {
    EXPECT_THAT([] { find_display("/nonexistent/mine.toml"); },
                ThrowsMessage<SceneError>(HasSubstr("/nonexistent/mine.toml")));
}

} // namespace
} // namespace macula::scene
