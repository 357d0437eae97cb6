// The head in the world: eyes on it, recorded motion of it.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/error.hpp"
#include "scenes/head/pose.hpp"
#include "scenes/head/recording.hpp"

namespace macula::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::int64_t kMs = 1'000'000;

Camera looking(glm::vec3 eye, glm::vec3 target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    return camera;
}

glm::dvec3 forward_of(const Camera& camera) {
    return -world_from_head(camera)[2];
}

TEST(HeadPose, AxesAreARightHandedRotation) {
    const glm::dmat3 m = world_from_head(looking({1, 2, 3}, {4, 3, -5}));
    EXPECT_NEAR(glm::determinant(m), 1.0, 1e-12);
    EXPECT_NEAR(m[0].y, 0.0, 1e-12);
    EXPECT_GT(m[1].y, 0.0);
    const glm::dmat3 identity = world_from_head(looking({0, 0, 0}, {0, 0, -1}));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(glm::length(identity[i] - glm::dmat3(1.0)[i]), 0.0, 1e-15);
}

TEST(HeadPose, LookingStraightUpIsDefined) {
    const glm::dmat3 m = world_from_head(looking({0, 0, 0}, {0, 5, 0}));
    EXPECT_NEAR(glm::determinant(m), 1.0, 1e-12);
    EXPECT_NEAR(-m[2].y, 1.0, 1e-12);
}

TEST(EyeCamera, InTheMiddleIsTheHeadsCameraBitForBit) {
    const Camera head = looking({0.1f, 0.2f, 0.3f}, {7, 8, 9});
    const Camera eye = eye_camera(head, find_display("dk2").eye(Eye::mono), 100.0);
    EXPECT_EQ(eye.eye, head.eye);
    EXPECT_EQ(eye.target, head.target);
    EXPECT_EQ(eye.up, head.up);
}

TEST(EyeCamera, EyesLieApartByTheIpdInSceneUnitsAndLookAlongParallels) {
    const Display dk2 = find_display("dk2");
    const Camera head = looking({0, 0, 0}, {0, 0, -10});
    const Camera left = eye_camera(head, dk2.eye(Eye::left), 100.0);
    const Camera right = eye_camera(head, dk2.eye(Eye::right), 100.0);
    EXPECT_NEAR(left.eye.x, -3.2, 1e-5);
    EXPECT_NEAR(right.eye.x, 3.2, 1e-5);
    EXPECT_NEAR(angle_degrees(forward_of(left), forward_of(right)), 0.0, 1e-5);
}

TEST(EyeCamera, CantedEyesTurnOutward) {
    const Display wide = find_display("pimax_8k_large");
    const Camera head = looking({5, 1, 2}, {5, 1, -10});
    const glm::dvec3 left = forward_of(eye_camera(head, wide.eye(Eye::left), 1.0));
    const glm::dvec3 right = forward_of(eye_camera(head, wide.eye(Eye::right), 1.0));
    EXPECT_NEAR(angles_of_direction(left).x, -10.0, 1e-4);
    EXPECT_NEAR(angles_of_direction(right).x, 10.0, 1e-4);
}

TEST(UnityAngles, TurnAsUnityDoes) {
    const glm::dvec3 ahead(0.0, 0.0, -1.0);
    const auto angles = [&](double x, double y, double z) {
        return angles_of_direction(orientation_of_unity_angles(x, y, z) * ahead);
    };
    EXPECT_NEAR(angles(0, 30, 0).x, 30.0, 1e-9);  // y: to the right
    EXPECT_NEAR(angles(20, 0, 0).y, -20.0, 1e-9); // x: down
    EXPECT_NEAR(angles(20, 30, 0).x, 30.0, 1e-9); // about the world's y last
    EXPECT_NEAR(angles(20, 30, 0).y, -20.0, 1e-9);
    EXPECT_NEAR(angles(340, 350, 50).x, -10.0, 1e-9);
    EXPECT_NEAR(angles(340, 350, 50).y, 20.0, 1e-9);
    // z: counterclockwise for the wearer, the head's right side goes up.
    const glm::dvec3 right = orientation_of_unity_angles(0, 0, 90) * glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_NEAR(right.y, 1.0, 1e-9);
}

HeadRecording recording(std::initializer_list<HeadSample> samples) {
    return {"some.csv", samples};
}

TEST(RecordedHead, InterpolatesTheShortWayWhateverTheSigns) {
    const glm::dquat a = orientation_of_unity_angles(0, 350, 0);
    const glm::dquat b = -orientation_of_unity_angles(0, 10, 0); // the same as +10
    const RecordedHead head(recording({{0, {}, a}, {10 * kMs, {2, 0, 0}, b}}));
    const HeadSample middle = head.at(5 * kMs);
    EXPECT_NEAR(angles_of_direction(middle.orientation * glm::dvec3(0, 0, -1)).x, 0.0, 1e-9);
    EXPECT_NEAR(middle.position.x, 1.0, 1e-12);
    EXPECT_EQ(head.at(99 * kMs).time_ns, 10 * kMs);
    EXPECT_EQ(head.at(-5).time_ns, 0);
}

TEST(RecordedHead, StartsWhereThePathIsAndKeepsItsOwnPitch) {
    // In the room the recording looks 90 degrees to the right and 20 down.
    const glm::dquat first = orientation_of_unity_angles(20, 90, 0);
    const RecordedHead head(recording({{7, {5, 1, 3}, first}}));
    const Camera base = looking({10, 2, 0}, {20, 2, 0}); // along +x
    const Camera camera = head.on(base, 0, 100.0);
    EXPECT_EQ(camera.eye, base.eye);
    EXPECT_NEAR(angle_degrees(forward_of(camera),
                              {std::cos(glm::radians(20.0)), -std::sin(glm::radians(20.0)), 0.0}),
                0.0, 1e-4);
}

TEST(RecordedHead, MotionIsRelativeToTheFirstHeading) {
    const glm::dquat facing_right = orientation_of_unity_angles(0, 90, 0);
    const glm::dquat further = orientation_of_unity_angles(0, 120, 0);
    // In the room: steps along where it faces (+x) by 0.5 m and turns 30 degrees to the right.
    const RecordedHead head(recording({{0, {1, 0, 0}, facing_right}, {kMs, {1.5, 0, 0}, further}}));
    const Camera base = looking({0, 0, 0}, {0, 0, -1});
    const Camera camera = head.on(base, kMs, 2.0);
    EXPECT_NEAR(camera.eye.z, -1.0, 1e-6);
    EXPECT_NEAR(camera.eye.x, 0.0, 1e-6);
    EXPECT_NEAR(angles_of_direction(forward_of(camera)).x, 30.0, 1e-4);
}

TEST(HeadCsv, RoundTrip) {
    const HeadRecording r = parse_head_csv("time_ns,quat_w,quat_x,quat_y,quat_z,pos_x,pos_y,pos_z\n"
                                           "3,-1,0,0,0,1,2,3\n9,0.7071068,0,0.7071068,0,4,5,6\n",
                                           "some.csv");
    const HeadRecording again = parse_head_csv(to_csv(r), "again.csv");
    ASSERT_EQ(again.samples.size(), 2u);
    EXPECT_EQ(again.samples[1].time_ns, 9);
    EXPECT_EQ(again.samples[1].position, glm::dvec3(4, 5, 6));
    EXPECT_EQ(again.samples[0].orientation.w, 1.0);
    EXPECT_NEAR(glm::dot(again.samples[1].orientation, r.samples[1].orientation), 1.0, 1e-8);
}

TEST(HeadCsv, ErrorsNameFileAndLine) {
    const auto from = [](const char* text) {
        return [text] { RecordedHead(parse_head_csv(text, "some.csv")); };
    };
    EXPECT_THAT(from("time_ns,quat_w,quat_x,quat_y\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.csv:1"), HasSubstr("quat_z"))));
    EXPECT_THAT(from("time_ns,quat_w,quat_x,quat_y,quat_z\n0,0,0,0,0\n"),
                ThrowsMessage<SceneError>(AllOf(HasSubstr("some.csv:2"), HasSubstr("rotation"))));
    EXPECT_THAT(from("time_ns,quat_w,quat_x,quat_y,quat_z\n5,1,0,0,0\n4,1,0,0,0\n"),
                ThrowsMessage<SceneError>(HasSubstr("some.csv:3")));
    EXPECT_THAT(from("time_ns,quat_w,quat_x,quat_y,quat_z\n"),
                ThrowsMessage<SceneError>(HasSubstr("no samples")));
    EXPECT_THAT(from("time_ns,quat_w,quat_x,quat_y,quat_z,pos_x\n"),
                ThrowsMessage<SceneError>(HasSubstr("pos_y")));
}

} // namespace
} // namespace macula::scene
