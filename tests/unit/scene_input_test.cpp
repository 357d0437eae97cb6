// Reading and unpacking of files: damage, limits, and what is no file.
#include <sys/stat.h>

#include <zlib.h>
#include <zstd.h>

#include "scenes/input.hpp"
#include "scenes/text.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

std::string zstd(const std::string& text) {
    std::string packed(ZSTD_compressBound(text.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
    return packed;
}

std::string gzip(const std::string& text) {
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, text.size()) + 32, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

std::string sample() {
    std::string text;
    for (int i = 0; i < 40000; ++i)
        text += std::to_string(i * 7919) + "\n";
    return text;
}

struct Packer {
    const char* name;
    Compression kind;
    std::string (*pack)(const std::string&);
};
const Packer kPackers[] = {{"zstd", Compression::zstd, zstd}, {"gzip", Compression::gzip, gzip}};

class Unpacking : public testing::TestWithParam<Packer> {};

TEST_P(Unpacking, ReturnsWhatWasPacked) {
    const std::string text = sample();
    EXPECT_EQ(decompress(GetParam().pack(text), GetParam().kind, 1 << 30, "x"), text);
    EXPECT_EQ(decompress(GetParam().pack(""), GetParam().kind, 1 << 30, "x"), "");
}

TEST_P(Unpacking, JoinsConcatenatedFrames) {
    const std::string two = GetParam().pack("first ") + GetParam().pack("second");
    EXPECT_EQ(decompress(two, GetParam().kind, 100, "x"), "first second");
}

TEST_P(Unpacking, StopsExactlyAtTheLimit) {
    const std::string text(100000, 'a'), packed = GetParam().pack(text);
    EXPECT_EQ(decompress(packed, GetParam().kind, text.size(), "x").size(), text.size());
    EXPECT_THROW(decompress(packed, GetParam().kind, text.size() - 1, "x"), SceneError);
}

TEST_P(Unpacking, BombIsRefusedWithoutUnpackingIt) {
    const std::string packed = GetParam().pack(std::string(std::size_t{256} << 20, '\0'));
    EXPECT_LT(packed.size(), 1u << 19);
    EXPECT_THROW(decompress(packed, GetParam().kind, 1 << 20, "bomb"), SceneError);
}

TEST_P(Unpacking, TruncatedAnywhereIsAnError) {
    const std::string packed = GetParam().pack(sample());
    for (std::size_t length = 0; length < packed.size(); length += 1 + packed.size() / 400)
        EXPECT_THROW(decompress(packed.substr(0, length), GetParam().kind, 1 << 30, "x"),
                     SceneError)
            << length;
}

TEST_P(Unpacking, FlippedBytesNeverCrash) {
    const std::string packed = GetParam().pack(sample());
    for (std::size_t at = 0; at < packed.size(); at += 1 + packed.size() / 300) {
        std::string damaged = packed;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        try {
            decompress(damaged, GetParam().kind, 1 << 22, "x");
        } catch (const SceneError&) {
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Unpacking, testing::ValuesIn(kPackers),
                         [](const auto& test) { return std::string(test.param.name); });

using Input = SceneFolder;

TEST_F(Input, CompressedScenesAreLoaded) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write("a.obj.zst", zstd(text));
    write("b.OBJ.GZ", gzip(text));
    EXPECT_EQ(load_written("a.obj.zst").triangle_count(), 1u);
    EXPECT_EQ(load_written("b.OBJ.GZ").triangle_count(), 1u);
}

TEST_F(Input, MissingFilesDirectoriesAndDevicesAreNamed) {
    std::filesystem::create_directories(path("folder.obj"));
    mkfifo(path("pipe.obj").c_str(), 0600);
    EXPECT_NE(error_of("gone.obj").find("gone.obj: no such file"), std::string::npos);
    EXPECT_NE(error_of("folder.obj").find("is a directory"), std::string::npos);
    EXPECT_NE(error_of("pipe.obj").find("not a regular file"), std::string::npos);
}

TEST_F(Input, UnknownKindsAreRefused) {
    write("a.fbx", "x");
    write("a", "x");
    EXPECT_NE(error_of("a.fbx").find("unknown kind of file"), std::string::npos);
    EXPECT_NE(error_of("a").find("unknown kind of file"), std::string::npos);
    EXPECT_THROW(load("no_such_scene"), SceneError);
}

TEST_F(Input, FilesBeyondTheLimitAreNotRead) {
    write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    LoadOptions options;
    options.max_input_bytes = 10;
    EXPECT_NE(error_of("a.obj", options).find("limit of 10"), std::string::npos);
}

TEST(PathBelow, KeepsReferencesInsideTheirFolder) {
    EXPECT_EQ(path_below("s", "a/b.png"), "s/a/b.png");
    EXPECT_EQ(path_below("s", "a\\b c.png"), "s/a/b c.png");
    EXPECT_EQ(path_below("s", "a/../b.png"), "s/b.png");
    EXPECT_EQ(path_below("s", "./b.png"), "s/b.png");
    for (const char* outside : {"", "..", "../b", "a/../../b", "/b", "\\b", "C:\\b", "c:b"})
        EXPECT_TRUE(path_below("s", outside).empty()) << outside;
}

TEST(Text, NumbersAsObjWritesThem) {
    for (const char* good : {"0", "-1", "+.5", "1.", "3.4e-003", "1E5", "00012"})
        EXPECT_TRUE(is_number(good)) << good;
    for (const char* bad :
         {"", ".", "-", "e5", "1e", "1e+", "nan", "inf", "0x1", "1.2.3", "1,5", "--1"})
        EXPECT_FALSE(is_number(bad)) << bad;
}

} // namespace
} // namespace macula::scene
