// Texture filtering: wrap modes, levels, decoding, and the same bits on device and host.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "host/frame/surfaces.hpp"
#include "host/kernel/library.hpp"
#include "lib/surface.h"
#include "lib/texture.h"

namespace {
using namespace macula;
using shared::float3;
namespace fs = std::filesystem;

scene::MipLevel level(std::uint32_t width, std::uint32_t height, std::uint32_t salt) {
    scene::MipLevel out{width, height, {}};
    for (std::uint32_t i = 0; i < 4 * width * height; ++i)
        out.rgba.push_back(static_cast<std::uint8_t>(shared::random_bits(salt, i, 0)));
    return out;
}

// A texture of random texels with a complete chain of levels.
scene::Texture texture(std::uint32_t width, std::uint32_t height, scene::Wrap u, scene::Wrap v,
                       bool srgb) {
    scene::Texture out;
    out.wrap_u = u;
    out.wrap_v = v;
    out.srgb = srgb;
    for (;;) {
        out.levels.push_back(level(width, height, width * 100 + height));
        if (width == 1 && height == 1)
            return out;
        width = std::max(width / 2, 1u);
        height = std::max(height / 2, 1u);
    }
}

scene::Scene scene_with(std::vector<scene::Texture> textures) {
    scene::Scene scene;
    for (std::uint32_t i = 0; i < textures.size(); ++i) {
        scene.materials.emplace_back();
        scene.materials.back().diffuse_texture = i;
    }
    scene.textures = std::move(textures);
    return scene;
}

struct HostTables {
    frame::TextureData data;
    std::vector<float> decode = frame::decoding_table();

    explicit HostTables(const scene::Scene& scene) : data(scene) {}
    shared::TextureTables tables() const {
        return {data.textures.data(), data.levels.data(), data.texels.data(), decode.data()};
    }
    float3 at(float u, float v, float lod, std::uint32_t index = 0) const {
        const shared::TextureTables t = tables();
        // `lod` counts from the finest level here.
        return shared::sample_texture(&t, index, u, v, lod - data.textures[index].log2_size);
    }
    float texel(std::uint32_t mip, std::uint32_t x, std::uint32_t y) const {
        const shared::ImageLevel& l = data.levels[mip];
        const std::uint32_t word = data.texels[l.first_texel + y * l.width + x];
        return decode[data.textures[0].decode + (word & 255u)];
    }
};

using scene::Wrap;

HostTables one(Wrap u, Wrap v, bool srgb = false) {
    return HostTables(scene_with({texture(8, 4, u, v, srgb)}));
}

TEST(TextureFilter, TexelCentresGiveTheTexels) {
    const HostTables t = one(Wrap::repeat, Wrap::repeat);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x)
            EXPECT_EQ(t.at((x + 0.5f) / 8, (y + 0.5f) / 4, 0).x, t.texel(0, x, y));
}

TEST(TextureFilter, HalfwayIsTheMean) {
    const HostTables t = one(Wrap::repeat, Wrap::repeat);
    EXPECT_NEAR(t.at(2.0f / 8, 1.5f / 4, 0).x, 0.5f * (t.texel(0, 1, 1) + t.texel(0, 2, 1)), 1e-6);
    EXPECT_NEAR(t.at(1.5f / 8, 2.0f / 4, 0).x, 0.5f * (t.texel(0, 1, 1) + t.texel(0, 1, 2)), 1e-6);
}

TEST(TextureFilter, RepeatBlendsTheLastColumnWithTheFirst) {
    const HostTables t = one(Wrap::repeat, Wrap::repeat);
    const float expected = 0.5f * (t.texel(0, 7, 0) + t.texel(0, 0, 0));
    for (const float u : {0.0f, 1.0f, -3.0f, 1e6f})
        EXPECT_NEAR(t.at(u, 0.5f / 4, 0).x, expected, 1e-6) << u;
}

TEST(TextureFilter, ClampHoldsTheEdge) {
    const HostTables t = one(Wrap::clamp, Wrap::clamp);
    for (const float u : {0.0f, -0.1f, -1e30f})
        EXPECT_EQ(t.at(u, 0.5f / 4, 0).x, t.texel(0, 0, 0)) << u;
    for (const float u : {1.0f, 1.1f, 1e30f})
        EXPECT_EQ(t.at(u, 0.5f / 4, 0).x, t.texel(0, 7, 0)) << u;
}

TEST(TextureFilter, MirrorRunsBackInTheNextPeriod) {
    const HostTables t = one(Wrap::mirror, Wrap::mirror);
    for (int i = 0; i < 8; ++i) {
        const float inside = (static_cast<float>(i) + 0.5f) / 8;
        const float expected = t.at(inside, 0.5f / 4, 0).x;
        EXPECT_EQ(t.at(2.0f - inside, 0.5f / 4, 0).x, expected);
        EXPECT_EQ(t.at(-inside, 0.5f / 4, 0).x, expected);
        EXPECT_EQ(t.at(2.0f + inside, 0.5f / 4, 0).x, expected);
    }
    EXPECT_EQ(t.at(1.0f, 0.5f / 4, 0).x, t.texel(0, 7, 0));
}

TEST(TextureFilter, WholeLevelsAreThatLevelAndHalvesTheirMean) {
    const HostTables t = one(Wrap::repeat, Wrap::repeat);
    EXPECT_EQ(t.at(0.125f, 0.25f, 1).x, t.texel(1, 0, 0));
    EXPECT_EQ(t.at(0.3f, 0.4f, 99).x, t.texel(3, 0, 0));
    const float between = t.at(0.125f, 0.25f, 1.5f).x;
    EXPECT_NEAR(between, 0.5f * (t.texel(1, 0, 0) + t.at(0.125f, 0.25f, 2).x), 1e-6);
    EXPECT_EQ(t.at(0.3f, 0.4f, -5).x, t.at(0.3f, 0.4f, 0).x);
}

TEST(TextureFilter, ATextureOfOneTexelIsThatTexelEverywhere) {
    const HostTables t(scene_with({texture(1, 1, Wrap::repeat, Wrap::clamp, false)}));
    for (const float u : {-7.3f, 0.0f, 0.49f, 1.0f, 12.0f})
        EXPECT_EQ(t.at(u, -u, 0.7f).x, t.texel(0, 0, 0));
}

TEST(TextureDecoding, FollowsTheSrgbCurve) {
    const std::vector<float> table = frame::decoding_table();
    for (int i = 0; i < 256; ++i) {
        const double e = i / 255.0;
        const double linear = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
        // Three rounded operations below a power of 2.4, and 2 ULP of m_pow.
        EXPECT_NEAR(table[256 + static_cast<std::size_t>(i)], linear, 5e-7 * linear);
        EXPECT_EQ(table[static_cast<std::size_t>(i)], static_cast<float>(i) / 255.0f);
    }
}

TEST(TextureData, LeavesOutWhatNoMaterialReads) {
    scene::Scene scene = scene_with({texture(2, 2, Wrap::repeat, Wrap::repeat, true),
                                     texture(4, 4, Wrap::repeat, Wrap::repeat, true)});
    scene.materials[0].diffuse_texture = scene::kNoTexture;
    const frame::TextureData data(scene);
    EXPECT_EQ(data.textures.size(), 1u);
    EXPECT_EQ(data.slot_of[0], scene::kNoTexture);
    EXPECT_EQ(data.slot_of[1], 0u);
}

TEST(TextureData, ALevelWithTooFewTexelsIsAnError) {
    scene::Scene scene = scene_with({texture(4, 4, Wrap::repeat, Wrap::repeat, true)});
    scene.textures[0].levels[0].rgba.pop_back();
    EXPECT_THROW(frame::TextureData{scene}, std::invalid_argument);
}

// The level is that at which one texel is as wide as the cone's footprint.
TEST(RayCone, PicksTheLevelOfTheFootprint) {
    const HostTables t(scene_with({texture(256, 256, Wrap::repeat, Wrap::repeat, false)}));
    shared::SurfacePoint s{};
    s.geometric_normal = {0, 0, 1};
    // A triangle that maps the unit square of the texture to a square of 2 x 2 world units.
    s.log2_density = shared::surface_log2_density(1.0f, 4.0f);
    const float texels_per_unit = 128.0f;
    for (const float texels : {1.0f, 2.0f, 4.0f, 64.0f}) {
        const float lod = shared::surface_lod(&s, texels / texels_per_unit, {0, 0, -3});
        EXPECT_NEAR(lod + t.data.textures[0].log2_size, std::log2(texels), 1e-5);
    }
    // Seen at 60 degrees the footprint is twice as long.
    const float slanted = shared::surface_lod(&s, 4.0f / texels_per_unit, {std::sqrt(3.0f), 0, -1});
    EXPECT_NEAR(slanted + t.data.textures[0].log2_size, 3.0f, 1e-5);
}

class TextureOnDevice : public testing::Test {
  protected:
    TextureOnDevice() {
        std::string pattern = (fs::temp_directory_path() / "macula_texture_XXXXXX").string();
        folder = mkdtemp(pattern.data());
        fs::create_directories(folder / "test");
        std::ofstream(folder / "test/texture.cl") << R"(#include "lib/texture.h"
kernel void filter(global const ImageTexture *textures, global const ImageLevel *levels,
                   global const uint *texels, global const float *decode,
                   global const float4 *queries, global float4 *results) {
    const uint i = get_global_id(0);
    const TextureTables tables = {textures, levels, texels, decode};
    const float4 q = queries[i];
    results[i] = (float4)(sample_texture(&tables, (uint)q.w, q.x, q.y, q.z), 0.0f);
}
)";
    }
    ~TextureOnDevice() override { fs::remove_all(folder); }
    fs::path folder;
};

TEST_F(TextureOnDevice, GivesTheHostsBits) {
    const scene::Scene scene = scene_with({texture(8, 4, Wrap::repeat, Wrap::mirror, true),
                                           texture(13, 57, Wrap::clamp, Wrap::repeat, false),
                                           texture(1, 1, Wrap::mirror, Wrap::clamp, true),
                                           texture(256, 128, Wrap::mirror, Wrap::clamp, true)});
    const HostTables host(scene);
    std::vector<std::array<float, 4>> queries;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const auto in = [&](std::uint32_t d) { return shared::random_unit(i, 0, d); };
        queries.push_back({8.0f * in(0) - 4.0f, 8.0f * in(1) - 4.0f, 12.0f * in(2) - 9.0f,
                           static_cast<float>(i % 4)});
    }
    compute::Device device = compute::open();
    kernel::LibraryOptions options = kernel::LibraryOptions::from_environment();
    options.overlay = folder;
    kernel::Library library(options);
    const auto upload = [&](const auto& v) { return device.upload(std::span(v), "test"); };
    compute::Buffer results = device.allocate(16 * queries.size(), "results");
    library.kernel(kernel::VariantKey("test/texture"), "filter", device)
        .set(upload(host.data.textures), upload(host.data.levels), upload(host.data.texels),
             upload(host.decode), upload(queries), results)
        .launch("filter", {queries.size()});
    const auto found = results.map_read<std::array<float, 4>>();
    int mismatches = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const auto& q = queries[i];
        const shared::TextureTables t = host.tables();
        const float3 expected =
            shared::sample_texture(&t, static_cast<std::uint32_t>(q[3]), q[0], q[1], q[2]);
        mismatches +=
            expected.x != found[i][0] || expected.y != found[i][1] || expected.z != found[i][2];
    }
    EXPECT_EQ(mismatches, 0);
}

} // namespace
