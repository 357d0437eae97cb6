// Kinds of facade, built cell by cell: windows lie back in the wall, ledges stand out of it.
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/procedural/city.hpp"

namespace macula::scene::procedural {
namespace {

void upright_face(MeshBuilder& b, glm::vec2 lo, glm::vec2 hi, float z, Finish finish) {
    b.face({{lo.x, lo.y, z}, {hi.x, lo.y, z}, {hi.x, hi.y, z}, {lo.x, hi.y, z}}, finish);
}

// The four sides of an opening that goes `depth` into the wall, and the pane at its end.
void recess(MeshBuilder& b, glm::vec2 lo, glm::vec2 hi, float depth, Finish reveal,
            std::uint32_t pane) {
    const float z = -depth;
    b.face({{lo.x, lo.y, 0}, {lo.x, lo.y, z}, {lo.x, hi.y, z}, {lo.x, hi.y, 0}}, reveal);
    b.face({{hi.x, lo.y, z}, {hi.x, lo.y, 0}, {hi.x, hi.y, 0}, {hi.x, hi.y, z}}, reveal);
    b.face({{lo.x, lo.y, 0}, {hi.x, lo.y, 0}, {hi.x, lo.y, z}, {lo.x, lo.y, z}}, reveal);
    b.face({{lo.x, hi.y, z}, {hi.x, hi.y, z}, {hi.x, hi.y, 0}, {lo.x, hi.y, 0}}, reveal);
    upright_face(b, lo, hi, z, {pane, 1.0f});
}

int cells_of(float width, float cell) {
    return std::max(1, static_cast<int>(std::floor(width / cell + 0.5f)));
}

std::uint32_t random_pane(const CityPalette& p, Random& random) {
    const std::uint32_t pick = random.below(10);
    return p.glass[pick < 4 ? 0 : pick < 7 ? 1 : pick < 9 ? 2 : 3];
}

void balcony(MeshBuilder& b, const CityPalette& p, float x0, float x1, float y) {
    constexpr float kDepth = 1.3f, kRail = 1.0f;
    box(b, {x0, y - 0.16f, 0.0f}, {x1, y, kDepth}, p.pale_concrete, kBack);
    box(b, {x0, y + kRail - 0.06f, kDepth - 0.07f}, {x1, y + kRail, kDepth}, p.dark_metal);
    for (const float x : {x0, x1 - 0.05f})
        box(b, {x, y + kRail - 0.06f, 0.0f}, {x + 0.05f, y + kRail, kDepth - 0.07f}, p.dark_metal,
            kBack | kFront);
    const int bars = static_cast<int>((x1 - x0) / 0.9f);
    for (int i = 0; i <= bars; ++i) {
        const float x =
            glm::mix(x0 + 0.03f, x1 - 0.03f, static_cast<float>(i) / static_cast<float>(bars));
        box(b, {x - 0.015f, y, kDepth - 0.05f}, {x + 0.015f, y + kRail - 0.06f, kDepth - 0.02f},
            p.dark_metal, kTop | kBottom);
    }
}

} // namespace

void punched_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, bool balconies,
                  Random& random) {
    const int cells = cells_of(w.width, 2.9f);
    const float cell = w.width / static_cast<float>(cells), half = 0.26f * cell;
    const float sill = 0.27f * w.storey, head = 0.82f * w.storey;
    const int phase = random.between(0, 1);
    for (int floor = 0; floor < w.floors; ++floor) {
        const float y = w.y0 + w.storey * static_cast<float>(floor);
        const float below = floor == 0 ? y : y - w.storey + head;
        upright_face(b, {0.0f, below}, {w.width, y + sill}, 0.0f, wall);
        float pier = 0.0f;
        for (int i = 0; i < cells; ++i) {
            const float middle = cell * (static_cast<float>(i) + 0.5f);
            const glm::vec2 lo{middle - half, y + sill}, hi{middle + half, y + head};
            upright_face(b, {pier, lo.y}, {lo.x, hi.y}, 0.0f, wall);
            pier = hi.x;
            recess(b, lo, hi, 0.22f, wall, random_pane(p, random));
            box(b, {lo.x - 0.08f, lo.y - 0.09f, 0.0f}, {hi.x + 0.08f, lo.y, 0.1f}, p.trim,
                kBack | kLeft | kRight);
            if (balconies && floor > 0 && i % 3 == phase)
                balcony(b, p, middle - 0.42f * cell, middle + 0.42f * cell, y + 0.1f);
        }
        upright_face(b, {pier, y + sill}, {w.width, y + head}, 0.0f, wall);
    }
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    upright_face(b, {0.0f, top - w.storey + head}, {w.width, top}, 0.0f, wall);
}

void rear_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random) {
    const int cells = cells_of(w.width, 3.2f);
    const float cell = w.width / static_cast<float>(cells);
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    upright_face(b, {0.0f, w.y0}, {w.width, top}, 0.0f, wall);
    for (int floor = 0; floor < w.floors; ++floor)
        for (int i = 0; i < cells; ++i) {
            // Frames stand a little before the wall.
            const float x = cell * (static_cast<float>(i) + 0.5f);
            const float y = w.y0 + w.storey * static_cast<float>(floor);
            upright_face(b, {x - 0.24f * cell, y + 0.3f * w.storey},
                         {x + 0.24f * cell, y + 0.8f * w.storey}, 0.03f,
                         {random_pane(p, random), 1.0f});
        }
}

void ribbon_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random) {
    constexpr float kCorner = 0.5f;
    const int cells = cells_of(w.width, 1.9f);
    const float cell = w.width / static_cast<float>(cells);
    for (int floor = 0; floor < w.floors; ++floor) {
        const float y = w.y0 + w.storey * static_cast<float>(floor), sill = y + 0.32f * w.storey,
                    head = y + 0.9f * w.storey;
        upright_face(b, {0.0f, y - (floor == 0 ? 0.0f : 0.1f * w.storey)}, {w.width, sill}, 0.0f,
                     wall);
        recess(b, {kCorner, sill}, {w.width - kCorner, head}, 0.2f, wall, random_pane(p, random));
        upright_face(b, {0.0f, sill}, {kCorner, head}, 0.0f, wall);
        upright_face(b, {w.width - kCorner, sill}, {w.width, head}, 0.0f, wall);
        for (int i = 1; i < cells; ++i) {
            const float x = cell * static_cast<float>(i);
            box(b, {x - 0.04f, sill, -0.2f}, {x + 0.04f, head, -0.1f}, p.metal,
                kBack | kTop | kBottom);
        }
    }
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    upright_face(b, {0.0f, top - 0.1f * w.storey}, {w.width, top}, 0.0f, wall);
}

void curtain_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Random& random) {
    const int cells = cells_of(w.width, 1.8f);
    const float cell = w.width / static_cast<float>(cells);
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    for (int floor = 0; floor < w.floors; ++floor) {
        const float y = w.y0 + w.storey * static_cast<float>(floor);
        box(b, {0.0f, y - 0.12f, 0.0f}, {w.width, y + 0.28f, 0.1f}, p.metal,
            kBack | kLeft | kRight);
        for (int i = 0; i < cells; ++i) {
            const float x = cell * static_cast<float>(i);
            upright_face(b, {x, y + 0.28f}, {x + cell, y + w.storey - 0.12f}, 0.0f,
                         {random_pane(p, random), 1.0f});
        }
    }
    box(b, {0.0f, top - 0.12f, 0.0f}, {w.width, top, 0.1f}, p.metal, kBack | kLeft | kRight);
    for (int i = 0; i <= cells; ++i) {
        const float x = cell * static_cast<float>(i);
        box(b, {x - 0.05f, w.y0, 0.0f}, {x + 0.05f, top, 0.22f}, p.metal, kBack | kTop | kBottom);
    }
}

void pier_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random) {
    const int cells = cells_of(w.width, 2.6f);
    const float cell = w.width / static_cast<float>(cells);
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    for (int i = 0; i <= cells; ++i) {
        const float x = cell * static_cast<float>(i);
        const float lo = std::max(0.0f, x - 0.42f), hi = std::min(w.width, x + 0.42f);
        box(b, {lo, w.y0, -0.3f}, {hi, top, i % 3 == 0 ? 0.35f : 0.15f}, wall, kBack | kBottom);
    }
    for (int floor = 0; floor < w.floors; ++floor) {
        const float y = w.y0 + w.storey * static_cast<float>(floor), sill = y + 0.3f * w.storey;
        upright_face(b, {0.0f, y}, {w.width, sill}, -0.15f, p.concrete);
        b.face({{0.0f, sill, -0.15f},
                {w.width, sill, -0.15f},
                {w.width, sill, -0.3f},
                {0.0f, sill, -0.3f}},
               p.trim);
        const float head = y + w.storey;
        b.face({{0.0f, head, -0.3f},
                {w.width, head, -0.3f},
                {w.width, head, -0.15f},
                {0.0f, head, -0.15f}},
               p.trim);
        for (int i = 0; i < cells; ++i) {
            const float x = cell * static_cast<float>(i);
            upright_face(b, {x + 0.3f, sill}, {x + cell - 0.3f, head}, -0.3f,
                         {random_pane(p, random), 1.0f});
        }
    }
}

void shop_front(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random) {
    const int shops = cells_of(w.width, 6.0f);
    const float cell = w.width / static_cast<float>(shops);
    const float head = w.y0 + 0.72f * w.storey, top = w.y0 + w.storey;
    for (int i = 0; i < shops; ++i) {
        const float x0 = cell * static_cast<float>(i), x1 = x0 + cell;
        upright_face(b, {x0, w.y0}, {x0 + 0.4f, head}, 0.0f, wall);
        upright_face(b, {x1 - 0.4f, w.y0}, {x1, head}, 0.0f, wall);
        upright_face(b, {x0, head}, {x1, top}, 0.0f, wall);
        upright_face(b, {x0 + 0.4f, w.y0}, {x1 - 0.4f, w.y0 + 0.5f}, 0.0f, p.dark_metal);
        recess(b, {x0 + 0.4f, w.y0 + 0.5f}, {x1 - 0.4f, head}, 0.35f, wall, p.glass[2]);
        for (int k = 1; k < 3; ++k) {
            const float x = glm::mix(x0 + 0.4f, x1 - 0.4f, static_cast<float>(k) / 3.0f);
            box(b, {x - 0.05f, w.y0 + 0.5f, -0.35f}, {x + 0.05f, head, -0.25f}, p.dark_metal,
                kBack | kTop | kBottom);
        }
        const std::uint32_t trade = random.below(3);
        box(b, {x0 + 0.6f, head + 0.1f, 0.0f}, {x1 - 0.6f, head + 0.75f, 0.12f},
            {p.sign[trade], 1.0f}, kBack);
        if (random.chance(0.6f)) {
            const glm::vec3 a{x0 + 0.5f, head + 0.05f, 0.02f}, c{x1 - 0.5f, head - 0.6f, 1.5f};
            b.face({{a.x, c.y, c.z}, {c.x, c.y, c.z}, {c.x, a.y, a.z}, {a.x, a.y, a.z}},
                   p.awning[trade]);
            b.face({{a.x, c.y - 0.25f, c.z},
                    {c.x, c.y - 0.25f, c.z},
                    {c.x, c.y, c.z},
                    {a.x, c.y, c.z}},
                   p.awning[trade]);
        }
    }
    box(b, {0.0f, top - 0.3f, 0.0f}, {w.width, top, 0.25f}, p.trim, kBack);
}

} // namespace macula::scene::procedural
