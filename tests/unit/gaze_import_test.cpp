// Importers of foreign recordings: small files by hand.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/gaze/import.hpp"

namespace macula::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

ImportedTrace import_text(const std::string& text, const std::string& format = "") {
    return import_trace(text, "some.txt", format);
}

constexpr const char* kVive =
    "time(100ns);eye_valid_L;eye_valid_R;gaze_direct_L.x;gaze_direct_L.y;gaze_direct_L.z;"
    "gaze_direct_R.x;gaze_direct_R.y;gaze_direct_R.z;helmet_pos_x;helmet_pos_y;helmet_pos_z;"
    "helmet_rot_x;helmet_rot_y;helmet_rot_z\r\n"
    "638342794000115346;31;31;0.1;0.2;0.97;0.1;0.2;0.97;1;2;3;0;359.9;0\r\n"
    "638342794000115347;8;31;0;0;0;0.1;0;0.99;1;2;3;0;0.1;0\r\n"
    "638342794000195346;8;24;0;0;0;0;0;0;1;2;3.5;0;30;0\r\n\r\n";

TEST(ImportVive, TicksOf18DigitsKeepTheirLastDigit) {
    const ImportedTrace t = import_text(kVive);
    EXPECT_EQ(t.format, "vive_pro_eye");
    ASSERT_EQ(t.gaze.samples.size(), 3u);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 100);
    EXPECT_EQ(t.gaze.samples[2].time_ns, 8'000'000);
}

TEST(ImportVive, GazeXPointsToTheLeftAndZeroVectorsAreNotNormalised) {
    const ImportedTrace t = import_text(kVive);
    const GazeSample& both = t.gaze.samples[0];
    EXPECT_TRUE(both.valid);
    EXPECT_LT(both.direction.x, 0.0);
    EXPECT_GT(both.direction.y, 0.0);
    EXPECT_LT(both.direction.z, 0.0);
    EXPECT_EQ(both.confidence, 1.0);
    const GazeSample& one = t.gaze.samples[1];
    EXPECT_TRUE(one.valid);
    EXPECT_FALSE(one.left.has_value());
    EXPECT_EQ(one.direction, *one.right);
    EXPECT_EQ(one.confidence, 0.5);
    EXPECT_FALSE(t.gaze.samples[2].valid);
    EXPECT_EQ(t.gaze.samples[2].direction, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(ImportVive, TheHeadIsMirroredAndItsWrapAroundIsNoJolt) {
    const ImportedTrace t = import_text(kVive);
    EXPECT_EQ(t.head.samples[0].position, glm::dvec3(1.0, 2.0, -3.0));
    // 359.9 to 0.1 degrees: the quaternions lie close together.
    EXPECT_GT(glm::dot(t.head.samples[0].orientation, t.head.samples[1].orientation), 0.99999);
    // Unity's y turns to the right.
    const glm::dvec3 forward = t.head.samples[2].orientation * glm::dvec3(0.0, 0.0, -1.0);
    EXPECT_NEAR(angles_of_direction(forward).x, 30.0, 1e-9);
}

TEST(ImportPico, TabsBlanksInNamesAndLostEyes) {
    const ImportedTrace t = import_text(
        "Timeline\tCombine Eye Gaze Vector. x\tCombine Eye Gaze Vector. y\tCombine Eye Gaze "
        "Vector. z"
        "\tLeft Eye Pose Status\tRight Eye Pose Status\tHead Position. x\tHead Position. y"
        "\tHead Position. z\tHead Rotation. x\tHead Rotation. y\tHead Rotation. z\n"
        "0.5\t0.1\t0\t0.99\t52\t52\t0\t1\t2\t20\t0\t0\n"
        "0.51\t0\t0\t0\t0\t0\t0\t1\t2\t20\t0\t0\n");
    EXPECT_EQ(t.format, "pico_neo3");
    EXPECT_GT(t.gaze.samples[0].direction.x, 0.0);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 10'000'000);
    EXPECT_FALSE(t.gaze.samples[1].valid);
    // Unity's x turns down.
    const glm::dvec3 forward = t.head.samples[0].orientation * glm::dvec3(0.0, 0.0, -1.0);
    EXPECT_NEAR(angles_of_direction(forward).y, -20.0, 1e-9);
}

TEST(ImportHeadQuaternions, LooksWhereTheViewVectorSays) {
    const ImportedTrace t =
        import_text("0,-0.0024844,-0.047941,0.011439,-0.99878,0.095709,0.0060594,"
                    "0.99539\n0.0203,0.0089977,0.046218,-0.01061,0.99883,0.092137,"
                    "0.018955,0.99557\n");
    EXPECT_EQ(t.format, "head_quaternions");
    const glm::dvec3 forward = t.head.samples[0].orientation * glm::dvec3(0.0, 0.0, -1.0);
    EXPECT_NEAR(angle_degrees(forward, {0.095709, 0.0060594, -0.99539}), 0.0, 0.01);
    // The second quaternion is -q of a neighbour: the same hemisphere after import.
    EXPECT_GT(glm::dot(t.head.samples[0].orientation, t.head.samples[1].orientation), 0.99);
}

TEST(ImportPupilCore, PointsDownInTheCameraAreDownInTheHead) {
    const ImportedTrace t = import_text(
        "gaze_timestamp,world_index,confidence,base_data,gaze_point_3d_x,gaze_point_3d_y,"
        "gaze_point_3d_z,gaze_normal0_x,gaze_normal0_y,gaze_normal0_z,gaze_normal1_x,"
        "gaze_normal1_y,gaze_normal1_z\n"
        "1234.5,0,0.9,1-1234 0-1234,100,100,1000,0,0,1,0.1,0,1\n"
        "1234.504,0,0.1,1-1234 0-1234,100,100,1000,0,0,1,0.1,0,1\n"
        "1234.508,0,0.8,1-1234,,,,,,,0.1,0,1\n");
    EXPECT_EQ(t.format, "pupil_core");
    EXPECT_GT(t.gaze.samples[0].direction.x, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.y, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.z, 0.0);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 4'000'000);
    EXPECT_FALSE(t.gaze.samples[1].valid) << "below Pupil's confidence of useful data";
    EXPECT_TRUE(t.gaze.samples[2].valid);
    EXPECT_TRUE(t.head.samples.empty());
}

TEST(ImportPupilCore, APointBehindTheCameraIsNoDirection) {
    // The eyes' axes diverge: they meet behind the head.
    const ImportedTrace t = import_text(
        "gaze_timestamp,world_index,confidence,norm_pos_x,norm_pos_y,base_data,gaze_point_3d_x,"
        "gaze_point_3d_y,gaze_point_3d_z,eye_center0_3d_x,eye_center0_3d_y,eye_center0_3d_z,"
        "gaze_normal0_x,gaze_normal0_y,gaze_normal0_z,eye_center1_3d_x,eye_center1_3d_y,"
        "eye_center1_3d_z,gaze_normal1_x,gaze_normal1_y,gaze_normal1_z\n"
        "7.5,0,0.9,0.5,0.5,1-1 0-1,-50,20,-900,20,15,-20,0.1,0,0.99,-40,15,-20,-0.06,0,0.99\n");
    EXPECT_TRUE(t.gaze.samples[0].valid);
    EXPECT_LT(t.gaze.samples[0].direction.z, -0.99);
    EXPECT_NEAR(t.gaze.samples[0].direction.x, 0.02, 0.001);
}

TEST(ImportPupilNeon, WornAsANumberAndABlinkOfAnyNumber) {
    const ImportedTrace t = import_text(
        "section id,recording id,timestamp [ns],gaze x [px],gaze y [px],worn,fixation id,"
        "blink id,azimuth [deg],elevation [deg]\n"
        "a,b,1700000000000000000,1,2,1.0,1,,10,-5\n"
        "a,b,1700000000005000000,1,2,1.0,,0,10,-5\n"
        "a,b,1700000000010000000,1,2,0.0,,,10,-5\n"
        "a,b,1700000000015000000,1,2,1.0,,,,\n");
    EXPECT_TRUE(t.gaze.samples[0].valid);
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_FALSE(t.gaze.samples[i].valid) << i;
}

TEST(ImportPupilNeon, PixelsAloneAreAnErrorThatSaysSo) {
    EXPECT_THAT([] { import_text("timestamp [ns],gaze x [px],gaze y [px]\n1,2,3\n"); },
                testing::ThrowsMessage<SceneError>(testing::HasSubstr("azimuth [deg]")));
}

TEST(ImportPupilNeon, DegreesBlinksAndNotWorn) {
    const ImportedTrace t = import_text(
        "section id,recording id,timestamp [ns],gaze x [px],gaze y [px],worn,fixation id,"
        "blink id,azimuth [deg],elevation [deg]\n"
        "a,b,1700000000000000000,1,2,True,1,,10,-5\n"
        "a,b,1700000000005000000,1,2,True,,3,10,-5\n"
        "a,b,1700000000010000000,1,2,False,,,10,-5\n");
    EXPECT_EQ(t.format, "pupil_neon");
    const glm::dvec2 angles = angles_of_direction(t.gaze.samples[0].direction);
    EXPECT_NEAR(angles.x, 10.0, 1e-9);
    EXPECT_NEAR(angles.y, -5.0, 1e-9);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 5'000'000);
    EXPECT_FALSE(t.gaze.samples[1].valid);
    EXPECT_FALSE(t.gaze.samples[2].valid);
}

std::string tobii(const std::string& rows, const std::string& time = "Recording timestamp [ms]") {
    return time +
           "\tSensor\tGaze direction left X\tGaze direction left Y\tGaze direction left Z\t"
           "Gaze direction right X\tGaze direction right Y\tGaze direction right Z\t"
           "Validity left\tValidity right\n" +
           rows;
}

TEST(ImportTobii, GlassesHaveXToTheLeftAndOtherSensorsArePassedOver) {
    const ImportedTrace t =
        import_text(tobii("0\tGyroscope\t\t\t\t\t\t\t\t\n"
                          "10\tEye Tracker\t0.1\t0.2\t0.97\t0.1\t0.2\t0.97\tValid\tValid\n"
                          "20\tEye Tracker\t\t\t\t\t\t\tInvalid\tInvalid\n"
                          "30\tEye Tracker\t0.1\t0\t0.9\t\t\t\tValid\tInvalid\n"));
    EXPECT_EQ(t.format, "tobii_pro_lab");
    ASSERT_EQ(t.gaze.samples.size(), 3u);
    EXPECT_LT(t.gaze.samples[0].direction.x, 0.0);
    EXPECT_GT(t.gaze.samples[0].direction.y, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.z, 0.0);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 10'000'000);
    EXPECT_FALSE(t.gaze.samples[1].valid);
    EXPECT_EQ(t.gaze.samples[2].confidence, 0.5);
}

TEST(ImportTobii, ScreenTrackersHaveXToTheRightAndMicroseconds) {
    const ImportedTrace t =
        import_text(tobii("0\tEye Tracker\t0.1\t0.2\t-0.97\t0.1\t0.2\t-0.97\tValid\tValid\n"
                          "4000\tEye Tracker\t0.1\t0.2\t-0.97\t0.1\t0.2\t-0.97\tValid\tValid\n",
                          "Recording timestamp"));
    EXPECT_GT(t.gaze.samples[0].direction.x, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.z, 0.0);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 4'000'000);
}

TEST(ImportTobii, WithoutAUnitTheStepTellsMillisecondsFromMicroseconds) {
    std::string rows;
    for (const char* ms : {"0", "17", "33", "50"})
        rows += std::string(ms) +
                "\tEye Tracker\t0.1\t0.2\t-0.97\t0.1\t0.2\t-0.97\tValid\tValid\n" + ms +
                "\tMouse\t\t\t\t\t\t\t\t\n";
    const ImportedTrace t = import_text(tobii(rows, "Recording timestamp"));
    EXPECT_EQ(t.gaze.samples[3].time_ns, 50'000'000);
    EXPECT_EQ(import_text(tobii(rows, "Recording timestamp [\xce\xbcs]")).gaze.samples[3].time_ns,
              50'000);
}

TEST(ImportTobii, DecimalCommasAndAByteOrderMark) {
    const ImportedTrace t =
        import_text("\xef\xbb\xbf" +
                    tobii("0\tEye Tracker\t0,1\t0,2\t-0,97\t0,1\t0,2\t-0,97\tValid\tValid\r\n"));
    EXPECT_NEAR(t.gaze.samples[0].direction.x, 0.1 / std::sqrt(0.01 + 0.04 + 0.97 * 0.97), 1e-9);
}

TEST(ImportTobii, OlderExportsNameTheDisplayWithTheEyesPositions) {
    std::string text = tobii("0\tEye Tracker\t0.1\t0.2\t-0.97\t0.1\t0.2\t-0.97\tValid\tValid\t1\n");
    text.insert(text.find('\n'), "\tEye position left X (DACSmm)");
    EXPECT_LT(import_text(text).gaze.samples[0].direction.y, 0.0);
}

TEST(ImportTobii, AnUnknownValidityIsAnError) {
    EXPECT_THAT([] { import_text(tobii("0\tEye Tracker\t0\t0\t-1\t0\t0\t-1\t0\t4\n")); },
                testing::ThrowsMessage<SceneError>(testing::HasSubstr("neither \"Valid\" nor")));
}

const std::string kSdkTitles =
    "device_time_stamp,system_time_stamp,left_gaze_point_on_display_area,"
    "left_gaze_point_in_user_coordinate_system,left_gaze_point_validity,"
    "left_gaze_origin_in_user_coordinate_system,left_gaze_origin_validity,"
    "right_gaze_point_in_user_coordinate_system,right_gaze_point_validity,"
    "right_gaze_origin_in_user_coordinate_system,right_gaze_origin_validity\n";

TEST(ImportTobiiSdk, ADirectionIsThePointLessTheOrigin) {
    const ImportedTrace t = import_text(
        kSdkTitles + "1000,5,\"(0.2, 0.5)\",\"(-88.0, 40.0, 0.0)\",1,\"(-30.0, 40.0, 580.0)\",1,"
                     "\"(32.0, 98.0, 0.0)\",1,\"(32.0, 40.0, 580.0)\",1\n"
                     "1833,6,,\"(nan, nan, nan)\",0,\"(-30.0, 40.0, 580.0)\",1,"
                     "\"(32.0, 98.0, 0.0)\",1,\"(32.0, 40.0, 580.0)\",1\n"
                     "2666,7,,\"(nan, nan, nan)\",0,\"(nan, nan, nan)\",0,"
                     "\"(nan, nan, nan)\",0,\"(nan, nan, nan)\",0\n");
    EXPECT_EQ(t.format, "tobii_sdk");
    ASSERT_EQ(t.gaze.samples.size(), 3u);
    const GazeSample& first = t.gaze.samples[0];
    EXPECT_NEAR(first.left->x, -0.1 / std::sqrt(1.01), 1e-9);
    EXPECT_NEAR(first.right->y, 0.1 / std::sqrt(1.01), 1e-9);
    EXPECT_LT(first.direction.z, -0.99);
    EXPECT_EQ(t.gaze.samples[1].time_ns, 833'000);
    EXPECT_EQ(t.gaze.samples[1].confidence, 0.5);
    EXPECT_FALSE(t.gaze.samples[2].valid);
}

TEST(ImportTobiiSdk, AColumnForEachComponentWillDo) {
    for (const std::string& ends : {std::string("xyz"), std::string("012")}) {
        std::string titles = "system_time_stamp", values = "5";
        for (const char* name :
             {"left_gaze_origin", "left_gaze_point", "right_gaze_origin", "right_gaze_point"})
            for (std::size_t i = 0; i < 3; ++i) {
                const bool point = std::string(name).find("point") != std::string::npos;
                titles += std::string(",") + name + "_in_user_coordinate_system_" + ends[i];
                values += i == 2 && !point ? ",600" : i == 0 && point ? ",60" : ",0";
            }
        const ImportedTrace t = import_text(titles + '\n' + values + '\n');
        EXPECT_NEAR(t.gaze.samples[0].direction.x, 0.1 / std::sqrt(1.01), 1e-9);
    }
}

TEST(ImportTobiiSdk, BadVectorsNameTheLine) {
    for (const char* bad : {"\"(1, 2)\"", "\"1, 2, 3\"", "\"(1, 2, x)\"", "\"(1, 2, 3, 4)\"",
                            "\"(1, 2, 1e9)\"", "\"(\"", "\"()\""})
        EXPECT_THAT([&] { import_text(kSdkTitles + "1,1,," + bad + ",1,\"(0, 0, 9)\",1,,0,,0\n"); },
                    testing::ThrowsMessage<SceneError>(testing::HasSubstr(":2: ")))
            << bad;
}

TEST(ImportTobii, DisplayCoordinatesHaveYDown) {
    std::string text = tobii("0\tEye Tracker\t0.1\t0.2\t0.97\t0.1\t0.2\t0.97\tValid\tValid\n");
    for (std::size_t at = 0; (at = text.find("Gaze direction", at)) != std::string::npos;) {
        at = text.find('\t', at);
        text.insert(at, " [DACS norm]");
    }
    const ImportedTrace t = import_text(text);
    EXPECT_GT(t.gaze.samples[0].direction.x, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.y, 0.0);
    EXPECT_LT(t.gaze.samples[0].direction.z, 0.0);
}

TEST(Import, RowsThatDoNotGoOnInTimeAreLeftOutAndCounted) {
    const ImportedTrace t = import_text("0,0,0,0,1\n0.1,0,0,0,1\n0.1,0,0,0,1\n0.05,0,0,0,1\n");
    EXPECT_EQ(t.head.samples.size(), 2u);
    ASSERT_FALSE(t.notes.empty());
    EXPECT_THAT(t.notes[0], HasSubstr("2 samples left out"));
}

TEST(Import, ErrorsNameFileAndLine) {
    const auto from = [](const std::string& text, const std::string& format) {
        return [=] { import_text(text, format); };
    };
    EXPECT_THAT(from("a,b\n1,2\n", ""), ThrowsMessage<SceneError>(HasSubstr("some.txt:1")));
    EXPECT_THAT(from("", ""), ThrowsMessage<SceneError>(HasSubstr("some.txt")));
    EXPECT_THAT(from("a\n1\n", "smi"), ThrowsMessage<std::invalid_argument>(HasSubstr("tobii")));
    EXPECT_THAT(from("0,0,0,0,1\n0.1,0,0,0\n", ""),
                ThrowsMessage<SceneError>(HasSubstr("some.txt:2")));
    EXPECT_THAT(from("0,0,0,0,0\n", ""), ThrowsMessage<SceneError>(HasSubstr("no rotation")));
    EXPECT_THAT(from("0,0,0\n", ""), ThrowsMessage<SceneError>(HasSubstr("8 values")));
    std::string vive = kVive;
    vive.replace(vive.find("0.1;0.2"), 3, "0.x");
    EXPECT_THAT(from(vive, ""), ThrowsMessage<SceneError>(
                                    AllOf(HasSubstr("some.txt:2"), HasSubstr("gaze_direct_L.x"))));
}

} // namespace
} // namespace macula::scene
