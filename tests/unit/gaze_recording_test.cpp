// The canonical gaze CSV and its replay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/gaze/csv.hpp"
#include "scenes/gaze/recording.hpp"

namespace macula::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

GazeRecording parse(const std::string& text) {
    return parse_gaze_csv(text, "some.csv");
}

auto fails_with(const char* place, const char* what) {
    return ThrowsMessage<SceneError>(AllOf(HasSubstr(place), HasSubstr(what)));
}

TEST(GazeCsv, ColumnsInAnyOrderWithWindowsLineEndsAndAByteOrderMark) {
    const GazeRecording r = parse("\xef\xbb\xbfz,valid,time_ns,y,x\r\n-1,1,5,0,0\r\n\r\n"
                                  "0,0,9,0,0\r\n-2,1,12,0,2\r\n\r\n");
    ASSERT_EQ(r.samples.size(), 3u);
    EXPECT_EQ(r.samples[0].direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_FALSE(r.samples[1].valid);
    EXPECT_NEAR(glm::length(r.samples[2].direction), 1.0, 1e-15);
    EXPECT_NEAR(angles_of_direction(r.samples[2].direction).x, 45.0, 1e-12);
}

TEST(GazeCsv, TheMeanOfTheEyesIsTheCommonDirection) {
    const GazeRecording r = parse("time_ns,left_x,left_y,left_z,right_x,right_y,right_z\n"
                                  "0,0.1,0,-1,-0.1,0,-1\n"
                                  "1,0.1,0,-1,,,\n"
                                  "2,,,,,,\n");
    EXPECT_NEAR(angle_degrees(r.samples[0].direction, {0.0, 0.0, -1.0}), 0.0, 1e-9);
    EXPECT_GT(r.samples[0].of(Eye::left).x, 0.0);
    EXPECT_LT(r.samples[0].of(Eye::right).x, 0.0);
    EXPECT_EQ(r.samples[1].of(Eye::right), r.samples[1].of(Eye::left));
    EXPECT_FALSE(r.samples[2].valid);
}

TEST(GazeCsv, AZeroDirectionIsInvalidAndNeverNormalised) {
    const GazeRecording r = parse("time_ns,x,y,z\n0,0,0,0\n");
    EXPECT_FALSE(r.samples[0].valid);
    EXPECT_EQ(r.samples[0].direction, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(GazeCsv, ErrorsNameFileAndLine) {
    const auto from = [](const char* text) { return [text] { parse(text); }; };
    EXPECT_THAT(from(""), fails_with("some.csv", "empty"));
    EXPECT_THAT(from("time,x,y,z\n0,0,0,-1\n"), fails_with("some.csv:1", "'time_ns'"));
    EXPECT_THAT(from("time_ns,x,y\n0,0,0\n"), fails_with("some.csv:1", "'z'"));
    EXPECT_THAT(from("time_ns\n0\n"), fails_with("some.csv:1", "no direction"));
    EXPECT_THAT(from("time_ns,x,y,z\n0,0,0,-1\n\n1,0,0\n"), fails_with("some.csv:4", "3 values"));
    EXPECT_THAT(from("time_ns,x,y,z\n0,0,1e,-1\n"), fails_with("some.csv:2", "'y'"));
    EXPECT_THAT(from("time_ns,x,y,z\n0,0,inf,-1\n"), fails_with("some.csv:2", "finite"));
    EXPECT_THAT(from("time_ns,x,y,z\n1.5,0,0,-1\n"), fails_with("some.csv:2", "whole number"));
    EXPECT_THAT(from("time_ns,x,y,z\n99999999999999999999,0,0,-1\n"),
                fails_with("some.csv:2", "64 bits"));
    EXPECT_THAT(from("time_ns,x,y,z\n-1,0,0,-1\n"), fails_with("some.csv:2", "time"));
    EXPECT_THAT(from("time_ns,x,y,z\n5,0,0,-1\n5,0,0,-1\n"), fails_with("some.csv:3", "not after"));
    EXPECT_THAT(from("time_ns,x,y,z,valid\n0,0,0,-1,2\n"), fails_with("some.csv:2", "0 or 1"));
    EXPECT_THAT(from("time_ns,x,y,z,valid\n0,0,0,0,1\n"), fails_with("some.csv:2", "no direction"));
    EXPECT_THAT(from("time_ns,x,y,z,confidence\n0,0,0,-1,1.5\n"),
                fails_with("some.csv:2", "confidence"));
}

TEST(GazeCsv, WrittenAndReadAgainIsTheSame) {
    const GazeRecording r =
        parse("time_ns,left_x,left_y,left_z,right_x,right_y,right_z,confidence\n"
              "0,0.1,0.2,-1,-0.1,0,-1,0.5\n7,,,,,,,0\n");
    const GazeRecording again = parse(to_csv(r));
    ASSERT_EQ(again.samples.size(), 2u);
    EXPECT_NEAR(glm::length(again.samples[0].direction - r.samples[0].direction), 0.0, 1e-8);
    EXPECT_NEAR(glm::length(*again.samples[0].left - *r.samples[0].left), 0.0, 1e-8);
    EXPECT_EQ(again.samples[0].confidence, 0.5);
    EXPECT_FALSE(again.samples[1].valid);
    EXPECT_EQ(again.samples[1].time_ns, 7);
}

TEST(CsvTable, QuotesMayHoldSeparatorsAndUnitsFollowNames) {
    const CsvTable t("\"a,b\",time [ms],x (mm)\n\"1,5\",7,8\n", "t.csv", ',',
                     CsvTable::Header::present);
    EXPECT_EQ(t.columns(), 3u);
    EXPECT_EQ(t.text(0, 0), "1,5");
    EXPECT_EQ(t.column("time"), 1u);
    EXPECT_EQ(t.column("x"), 2u);
    EXPECT_FALSE(t.find("tim").has_value());
}

TEST(RecordedGaze, TheNewestSampleNotAfterTheTimeIsGiven) {
    const GazePointer gaze =
        recorded_gaze(parse("time_ns,x,y,z\n100,0,0,-1\n110,1,0,-1\n130,0,1,-1\n"), AtEnd::hold);
    EXPECT_EQ(gaze->at(0).time_ns, 0);
    EXPECT_EQ(gaze->at(9).time_ns, 0);
    EXPECT_EQ(gaze->at(10).time_ns, 10);
    EXPECT_NEAR(angles_of_direction(gaze->at(29).direction).x, 45.0, 1e-12);
    EXPECT_EQ(gaze->at(1'000'000).time_ns, 30);
    EXPECT_EQ(gaze->at(-5).time_ns, 0);
}

TEST(RecordedGaze, RepeatsOneMeanGapAfterItsLastSample) {
    const GazePointer gaze =
        recorded_gaze(parse("time_ns,x,y,z\n100,0,0,-1\n110,1,0,-1\n130,0,1,-1\n"), AtEnd::repeat);
    EXPECT_EQ(gaze->at(44).time_ns, 30);
    EXPECT_EQ(gaze->at(45).time_ns, 45);
    EXPECT_EQ(gaze->at(45).direction, gaze->at(0).direction);
    EXPECT_EQ(gaze->at(4500 + 12).direction, gaze->at(12).direction);
}

TEST(RecordedGaze, OneSampleIsEnoughAndNoneIsAnError) {
    EXPECT_EQ(recorded_gaze(parse("time_ns,x,y,z\n3,0,0,-1\n"), AtEnd::repeat)->at(50).time_ns, 50);
    EXPECT_THAT([] { recorded_gaze(parse("time_ns,x,y,z\n"), AtEnd::hold); },
                fails_with("some.csv", "no samples"));
}

} // namespace
} // namespace macula::scene
