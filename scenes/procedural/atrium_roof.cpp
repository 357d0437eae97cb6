// The tiled roof over the galleries and the timber that carries it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

constexpr float kOverhang = 0.9f;
constexpr float kTileWidth = 0.36f;
constexpr int kCourses = 5, kCellsATile = 3;
constexpr float kStep = 0.06f;

// Height of the roof plane at `out` from the arcades' centre lines.
float roof_height(float out) {
    return glm::mix(kEaves, kRidge, (out + kOverhang) / (kGallery + kOverhang));
}

// One slope: local x along the eaves, +z into the court; cut by the hips at |x| = half + out.
void tiles(MeshBuilder& b, float half, Finish finish) {
    const int columns = static_cast<int>(std::ceil(2.0f * (half + kGallery) / kTileWidth));
    const int cells = columns * kCellsATile;
    for (int course = 0; course < kCourses; ++course) {
        const auto point = [&](float s, float t, float lift) {
            const float out =
                -kOverhang + (kGallery + kOverhang) * (static_cast<float>(course) + t) / kCourses;
            const float x = (2.0f * s - 1.0f) * 0.5f * static_cast<float>(columns) * kTileWidth;
            const float wave = std::fabs(sin_cos_turns(0.5f * x / kTileWidth).x);
            const float limit = half + out;
            return glm::vec3{std::clamp(x, -limit, limit), roof_height(out) + 0.09f * wave + lift,
                             -out};
        };
        // A course lies on the one below it and ends in a step.
        const auto slope = [&](float s, float t) { return point(s, t, kStep * (1.0f - t)); };
        const auto step = [&](float s, float t) { return point(s, 0.0f, kStep * t); };
        const auto uv = [&](float s, float t) {
            const glm::vec3 at = point(s, t, 0.0f);
            return glm::vec2{at.x, -1.1f * at.z} / finish.tile;
        };
        surface(b, {cells, 1}, slope, uv, finish.material);
        surface(
            b, {cells, 1}, step,
            [&](float s, float t) {
                return uv(s, 0.0f) + glm::vec2{0.0f, kStep * t};
            },
            finish.material);
    }
}

void rafter(MeshBuilder& b, Finish finish) {
    constexpr float kWidth = 0.07f, kDepth = 0.2f, kGap = 0.12f;
    const float near = kOverhang - 0.1f, far = -kGallery;
    const float y0 = roof_height(-near) - kGap, y1 = roof_height(-far) - kGap;
    const auto at = [&](float x, float z, float drop) {
        return glm::vec3{x, (z == near ? y0 : y1) - drop, z};
    };
    b.face({at(-kWidth, far, kDepth), at(kWidth, far, kDepth), at(kWidth, near, kDepth),
            at(-kWidth, near, kDepth)},
           finish);
    b.face({at(kWidth, near, kDepth), at(kWidth, far, kDepth), at(kWidth, far, 0.0f),
            at(kWidth, near, 0.0f)},
           finish);
    b.face({at(-kWidth, far, kDepth), at(-kWidth, near, kDepth), at(-kWidth, near, 0.0f),
            at(-kWidth, far, 0.0f)},
           finish);
    b.face({at(-kWidth, near, kDepth), at(kWidth, near, kDepth), at(kWidth, near, 0.0f),
            at(-kWidth, near, 0.0f)},
           finish);
}

void slope(MeshBuilder& b, const Palette& p, float half) {
    tiles(b, half, p.roof);
    const float low = roof_height(-kOverhang) - 0.1f, high = roof_height(kGallery) - 0.1f;
    b.face({{-(half + kGallery), high, -kGallery},
            {half + kGallery, high, -kGallery},
            {half - kOverhang, low, kOverhang},
            {-(half - kOverhang), low, kOverhang}},
           p.wood);
    // Fascia with a gutter.
    box(b, {-(half - kOverhang), low - 0.06f, kOverhang - 0.03f},
        {half - kOverhang, low + 0.14f, kOverhang}, p.wood, kBack);
    const Placement at = b.place;
    const int rafters = static_cast<int>(2.0f * half);
    for (int i = 0; i <= rafters; ++i) {
        const float x = -half + static_cast<float>(i);
        b.place.origin = at.point({x + (x < 0.0f ? 0.95f : x > 0.0f ? -0.95f : 0.0f), 0.0f, 0.0f});
        rafter(b, p.wood);
    }
    b.place = at;
}

} // namespace

void build_roof(MeshBuilder& b, const Palette& p) {
    const std::array<std::pair<Placement, float>, 4> slopes{
        {{upright({0.0f, 0.0f, -kCourtZ}, 0.0f), kCourtX},
         {upright({0.0f, 0.0f, kCourtZ}, 0.5f), kCourtX},
         {upright({-kCourtX, 0.0f, 0.0f}, 0.25f), kCourtZ},
         {upright({kCourtX, 0.0f, 0.0f}, 0.75f), kCourtZ}}};
    for (const auto& [place, half] : slopes) {
        b.place = place;
        slope(b, p, half);
    }
    b.place = {};
    // Ridge tiles along the hips.
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            const auto at = [&](float out) {
                return glm::vec3{x * (kCourtX + out), roof_height(out) + 0.08f,
                                 z * (kCourtZ + out)};
            };
            const std::array<glm::vec3, 2> hip{at(-kOverhang), at(kGallery)};
            tube(b, hip, 0.13f, 10, p.roof);
        }
}

} // namespace macula::scene::procedural
