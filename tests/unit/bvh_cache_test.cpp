// The disk cache of trees: what is read back is what was built; every damaged file is noticed.
#include "bvh/bvh.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace {
namespace fs = std::filesystem;
using namespace macula;

class BvhCache : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("macula-bvh-cache-" + std::to_string(getpid()));
        std::uint32_t state = 7;
        for (std::uint32_t i = 0; i < 300; ++i) {
            for (int axis = 0; axis < 9; ++axis) {
                state = state * 1664525u + 1013904223u;
                positions_.push_back(static_cast<float>(state >> 8) * 0x1p-24f +
                                     static_cast<float>(i % 17));
            }
            triangles_.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
    }
    void TearDown() override { fs::remove_all(folder_); }

    bvh::Geometry geometry() const { return {positions_, triangles_, {}}; }
    bvh::CacheResult build() const { return bvh::build_cached(geometry(), {}, folder_); }
    fs::path only_file() const { return fs::directory_iterator(folder_)->path(); }

    static bool same(const bvh::Tree& a, const bvh::Tree& b) {
        return a.references == b.references && a.nodes.size() == b.nodes.size() &&
               std::memcmp(a.nodes.data(), b.nodes.data(),
                           a.nodes.size() * sizeof(bvh::TreeNode)) == 0;
    }

    fs::path folder_;
    std::vector<float> positions_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

TEST_F(BvhCache, SecondBuildReadsTheSameTree) {
    const bvh::CacheResult first = build(), second = build();
    EXPECT_FALSE(first.from_cache);
    EXPECT_TRUE(second.from_cache);
    EXPECT_EQ(second.note, "");
    EXPECT_TRUE(same(first.tree, second.tree));
}

TEST_F(BvhCache, OtherGeometryOrOptionsHaveTheirOwnFile) {
    build();
    positions_[5] += 0.5f;
    EXPECT_FALSE(build().from_cache);
    bvh::BuildOptions options;
    options.spatial_splits = false;
    EXPECT_FALSE(bvh::build_cached(geometry(), options, folder_).from_cache);
}

TEST_F(BvhCache, TruncationAtAnyPlaceIsNoticedAndMended) {
    const bvh::Tree whole = build().tree;
    const auto size = fs::file_size(only_file());
    for (const std::uintmax_t length : {std::uintmax_t{0}, std::uintmax_t{7}, std::uintmax_t{55},
                                        std::uintmax_t{56}, size / 2, size - 1}) {
        fs::resize_file(only_file(), length);
        const bvh::CacheResult result = build();
        EXPECT_FALSE(result.from_cache) << length;
        EXPECT_NE(result.note, "") << length;
        EXPECT_TRUE(same(result.tree, whole));
        EXPECT_TRUE(build().from_cache) << "mended after " << length;
    }
}

TEST_F(BvhCache, FlippedBytesAreNoticed) {
    build();
    const auto size = fs::file_size(only_file());
    for (std::uintmax_t at = 0; at < size; at += 1 + size / 40) {
        {
            std::fstream file(only_file(), std::ios::in | std::ios::out | std::ios::binary);
            file.seekg(static_cast<std::streamoff>(at));
            const char byte = static_cast<char>(file.get() ^ 0x10);
            file.seekp(static_cast<std::streamoff>(at));
            file.put(byte);
        }
        const bvh::CacheResult result = build();
        EXPECT_FALSE(result.from_cache) << at;
        EXPECT_NE(result.note, "") << at;
    }
}

TEST_F(BvhCache, AFolderThatCannotBeWrittenIsSaidAndTheTreeIsThere) {
    std::ofstream(folder_) << "a file where the folder should be";
    const bvh::CacheResult result = build();
    EXPECT_FALSE(result.from_cache);
    EXPECT_NE(result.note, "");
    EXPECT_FALSE(result.tree.nodes.empty());
}

} // namespace
