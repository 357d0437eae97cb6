// The rules of the frame graph, with stages that fill buffers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "host/frame/graph.hpp"

namespace {
using namespace macula;
using frame::Graph;
using frame::GraphError;
using frame::Resource;

using frame::Stage;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

struct Log {
    std::vector<std::string> lines;
};

Stage stage(Log& log, std::string name, std::vector<std::string> reads,
            std::vector<std::string> writes) {
    Stage s;
    s.name = name;
    s.reads = std::move(reads);
    for (const std::string& resource : writes)
        s.writes.push_back({resource, 4, 1});
    s.prepare = [&log, name] {
        log.lines.push_back("prepare " + name);
        return [&log, name](frame::Run& run) {
            log.lines.push_back("run " + name + " " + std::to_string(run.sample()));
        };
    };
    return s;
}

shared::FrameParams params(std::uint32_t samples) {
    shared::FrameParams p{};
    p.samples_per_pixel = samples;
    return p;
}

class GraphTest : public testing::Test {
  protected:
    compute::Device device = compute::open();
    Log log;
    Graph graph{"test", "a method for a test"};
};

TEST_F(GraphTest, TwoWritersOfOneResourceAreAnError) {
    graph.add(stage(log, "first", {}, {"colour"}));
    EXPECT_THAT([&] { graph.add(stage(log, "second", {}, {"colour"})); },
                ThrowsMessage<GraphError>(
                    AllOf(HasSubstr("first"), HasSubstr("second"), HasSubstr("colour"))));
}

TEST_F(GraphTest, OneStageThatNamesAResourceTwiceIsAnError) {
    EXPECT_THROW(graph.add(stage(log, "first", {}, {"colour", "colour"})), GraphError);
}

TEST_F(GraphTest, ReadBeforeWriteIsAnError) {
    EXPECT_THAT([&] { graph.add(stage(log, "shade", {"hits"}, {"colour"})); },
                ThrowsMessage<GraphError>(AllOf(HasSubstr("shade"), HasSubstr("hits"))));
}

TEST_F(GraphTest, AStageDoesNotReadItsOwnOutput) {
    EXPECT_THROW(graph.add(stage(log, "shade", {"colour"}, {"colour"})), GraphError);
}

TEST_F(GraphTest, HistoryMayBeReadBeforeItIsWritten) {
    Stage reader = stage(log, "reproject", {}, {"reprojected"});
    reader.reads_last = {"colour"};
    graph.add(reader);
    graph.add(stage(log, "shade", {"reprojected"}, {"colour"}));
    EXPECT_NO_THROW(graph.compile(device, {"colour"}));
}

TEST_F(GraphTest, HistoryThatNobodyWritesIsAnError) {
    Stage reader = stage(log, "reproject", {}, {"reprojected"});
    reader.reads_last = {"coluor"};
    graph.add(reader);
    EXPECT_THAT([&] { graph.compile(device, {"reprojected"}); },
                ThrowsMessage<GraphError>(HasSubstr("coluor")));
}

TEST_F(GraphTest, AnUnknownOutputIsAnErrorThatListsTheKnownOnes) {
    graph.add(stage(log, "shade", {}, {"colour"}));
    EXPECT_THAT([&] { graph.compile(device, {"color"}); },
                ThrowsMessage<GraphError>(AllOf(HasSubstr("color"), HasSubstr("colour"))));
}

TEST_F(GraphTest, WhatNobodyReadsIsNeitherPreparedNorRun) {
    graph.add(stage(log, "trace", {}, {"hits", "spare"}));
    graph.add(stage(log, "motion", {"hits"}, {"motion"}));
    graph.add(stage(log, "shade", {"hits"}, {"colour"}));
    graph.compile(device, {"colour"});
    graph.execute(params(1));
    const std::vector<std::string> expected{"prepare trace", "prepare shade", "run trace 0",
                                            "run shade 0"};
    EXPECT_EQ(log.lines, expected);
    EXPECT_TRUE(graph.result("colour"));
    EXPECT_TRUE(graph.result("hits"));
    EXPECT_FALSE(graph.result("spare"));
    EXPECT_FALSE(graph.result("motion"));
}

TEST_F(GraphTest, StagesOfASampleRunInTurnForEachSample) {
    graph.add(stage(log, "clear", {}, {"sum"}));
    graph.for_each_sample(
        {stage(log, "trace", {}, {"hits"}), stage(log, "shade", {"hits", "sum"}, {"colour"})});
    graph.add(stage(log, "resolve", {"colour"}, {"image"}));
    graph.compile(device, {"image"});
    log.lines.clear();
    graph.execute(params(2));
    const std::vector<std::string> expected{"run clear 0", "run trace 0", "run shade 0",
                                            "run trace 1", "run shade 1", "run resolve 0"};
    EXPECT_EQ(log.lines, expected);
}

// Counts frames in a resource of its own: one more than last frame's.
TEST_F(GraphTest, HistoryIsLastFramesAndZeroAtFirst) {
    Stage count;
    count.name = "count";
    count.reads_last = {"frames"};
    count.writes = {{"frames", 4, 1}};
    count.prepare = [] {
        return [](frame::Run& run) {
            const auto before = run.last("frames").read_one<std::uint32_t>();
            run["frames"].write_one(before + 1);
        };
    };
    graph.add(count);
    graph.compile(device, {"frames"});
    for (std::uint32_t frame = 1; frame <= 3; ++frame) {
        graph.execute(params(1));
        EXPECT_EQ(graph.result("frames").read_one<std::uint32_t>(), frame);
    }
    graph.forget();
    graph.execute(params(1));
    EXPECT_EQ(graph.result("frames").read_one<std::uint32_t>(), 1u);
}

Stage writer_in(Log& log, const std::string& name, std::vector<std::string> reads,
                const std::string& resource, std::uint64_t count = 1) {
    Stage s = stage(log, name, std::move(reads), {});
    s.writes = {{resource, 4, count, "place"}};
    return s;
}

TEST_F(GraphTest, ResourcesOfOneStorageTakeTurnsInIt) {
    graph.add(writer_in(log, "first", {}, "level 1"));
    graph.add(writer_in(log, "second", {"level 1"}, "level 2"));
    EXPECT_THAT([&] { graph.add(stage(log, "late", {"level 1"}, {"x"})); },
                ThrowsMessage<GraphError>(AllOf(HasSubstr("late"), HasSubstr("level 2"))));
    graph.add(stage(log, "shade", {"level 2"}, {"colour"}));
    graph.compile(device, {"colour"});
    EXPECT_EQ(graph.result("level 1").state().get(), graph.result("level 2").state().get());
}

TEST_F(GraphTest, ResourcesOfOneStorageHaveOneSize) {
    graph.add(writer_in(log, "first", {}, "level 1"));
    graph.add(writer_in(log, "second", {"level 1"}, "level 2", 2));
    EXPECT_THAT([&] { graph.compile(device, {"level 2"}); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("level 2")));
}

TEST_F(GraphTest, HistoryHasItsOwnStorage) {
    Stage first = writer_in(log, "first", {}, "level 1");
    first.reads_last = {"level 2"};
    graph.add(first).add(writer_in(log, "second", {"level 1"}, "level 2"));
    EXPECT_THAT([&] { graph.compile(device, {"level 2"}); },
                ThrowsMessage<GraphError>(AllOf(HasSubstr("level 1"), HasSubstr("level 2"))));
}

TEST_F(GraphTest, ScratchOfOneNameIsSharedAndAsLargeAsTheLargest) {
    Stage a = stage(log, "a", {}, {"x"}), b = stage(log, "b", {"x"}, {"y"});
    a.scratch = {{"rays", 4, 10}};
    b.scratch = {{"rays", 8, 100}};
    const void* seen = nullptr;
    std::uint64_t bytes = 0;
    a.prepare = [&] { return [&](frame::Run& run) { seen = run.scratch("rays").state().get(); }; };
    b.prepare = [&] {
        return [&](frame::Run& run) {
            EXPECT_EQ(run.scratch("rays").state().get(), seen);
            bytes = run.scratch("rays").size();
        };
    };
    graph.add(a).add(b);
    graph.compile(device, {"y"});
    graph.execute(params(1));
    EXPECT_EQ(bytes, 800u);
}

TEST_F(GraphTest, AnAbsurdSizeIsAnErrorThatNamesTheResource) {
    Stage s = stage(log, "trace", {}, {});
    s.writes = {{"hits", 256, ~std::uint64_t{0} / 2}};
    graph.add(s);
    EXPECT_THAT([&] { graph.compile(device, {"hits"}); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("hits")));
}

TEST_F(GraphTest, RunningBeforeCompilingIsAnError) {
    graph.add(stage(log, "shade", {}, {"colour"}));
    EXPECT_THROW(graph.execute(params(1)), GraphError);
    EXPECT_THROW(graph.result("colour"), GraphError);
}

TEST_F(GraphTest, ExplainTellsTheStagesInOrderAndWhatIsLeftOut) {
    Stage reproject = stage(log, "reproject", {}, {"reprojected"});
    reproject.reads_last = {"colour"};
    graph.add(reproject);
    graph.for_each_sample({stage(log, "trace", {}, {"hits", "spare"}),
                           stage(log, "move", {"hits"}, {"motion"}),
                           stage(log, "shade", {"hits", "reprojected"}, {"colour"})});
    EXPECT_THAT(graph.explain(), Not(HasSubstr("left out")));
    graph.compile(device, {"colour"});
    EXPECT_EQ(graph.explain(), "test: a method for a test\n"
                               "  reproject\n"
                               "      reads  last frame's colour\n"
                               "      writes reprojected\n"
                               "  for each pixel sample:\n"
                               "    trace\n"
                               "        writes hits, (spare)\n"
                               "    move (left out: nobody reads it)\n"
                               "        reads  hits\n"
                               "        writes motion\n"
                               "    shade\n"
                               "        reads  hits, reprojected\n"
                               "        writes colour\n");
}

} // namespace
