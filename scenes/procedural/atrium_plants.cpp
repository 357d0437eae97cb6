// Masked foliage: ivy, palms, bushes, lemon trees; and the masked chains of the lanterns.
#include <array>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

glm::vec3 random_direction(Random& random) {
    const float turn = random.uniform(), y = random.symmetric(1.0f);
    const glm::vec2 cs = sin_cos_turns(turn);
    const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
    return {r * cs.x, y, r * cs.y};
}

// A leaf card: its stem at `stem`, growing along `growth`, facing `facing` (need not be
// orthogonal), folded along the middle.
void leaf(MeshBuilder& b, glm::vec3 stem, glm::vec3 growth, glm::vec3 facing, float size,
          std::uint32_t material) {
    const glm::vec3 up = glm::normalize(growth);
    const glm::vec3 side = glm::normalize(glm::cross(up, facing + glm::vec3{1e-3f, 2e-3f, 0.0f}));
    const glm::vec3 front = glm::cross(side, up);
    const glm::vec3 fold = 0.18f * size * front, half = 0.5f * size * side, rise = size * up;
    const std::array<glm::vec2, 4> left_uv{{{0, 0}, {0.5f, 0}, {0.5f, 1}, {0, 1}}};
    const std::array<glm::vec2, 4> right_uv{{{0.5f, 0}, {1, 0}, {1, 1}, {0.5f, 1}}};
    const std::array<glm::vec3, 4> left{stem - half + fold, stem, stem + rise,
                                        stem + rise - half + fold};
    const std::array<glm::vec3, 4> right{stem, stem + half + fold, stem + rise + half + fold,
                                         stem + rise};
    b.card(left, left_uv, material);
    b.card(right, right_uv, material);
}

// A palm leaf that arches outwards, as a strip of cards.
void arching_frond(MeshBuilder& b, float turn, float length, float droop, std::uint32_t material) {
    const glm::vec2 cs = sin_cos_turns(turn);
    const glm::vec3 out{cs.x, 0.0f, -cs.y}, side{cs.y, 0.0f, cs.x};
    const auto point = [&](float s, float t) {
        const float reach = length * (0.25f + 0.55f * droop) * t,
                    rise = length * (0.95f * t - (0.35f + 0.6f * droop) * t * t);
        const float across = 2.0f * s - 1.0f;
        const glm::vec3 fold{0.0f, 0.1f * length * std::abs(across), 0.0f};
        return out * reach + glm::vec3{0.0f, rise, 0.0f} + side * (0.3f * length * across) + fold;
    };
    surface(
        b, {2, 5}, point,
        [](float s, float t) {
            return glm::vec2{s, t};
        },
        material);
}

// Ivy around an upright of this radius, thinning out towards the top.
void ivy_on_column(MeshBuilder& b, const Palette& p, float radius, float height, int leaves,
                   Random& random) {
    const float lean = random.uniform();
    for (int i = 0; i < leaves; ++i) {
        const float climb = random.uniform() * random.uniform();
        const float turn = lean + 0.5f * climb + random.symmetric(0.42f * (1.0f - 0.6f * climb));
        const glm::vec2 cs = sin_cos_turns(turn);
        const glm::vec3 out{cs.x, 0.0f, -cs.y};
        const glm::vec3 stem = out * (radius + random.range(0.01f, 0.09f)) +
                               glm::vec3{0.0f, 0.05f + height * climb, 0.0f};
        const glm::vec3 wild = random_direction(random);
        const float size = random.range(0.13f, 0.24f);
        leaf(b, stem, glm::vec3{0.0f, -0.6f, 0.0f} + 0.5f * wild + 0.3f * out, out + 0.5f * wild,
             size, p.ivy);
    }
}

// Ivy spilling over a balustrade's rail, in the bay's frame.
void ivy_over_rail(MeshBuilder& b, const Palette& p, int leaves, Random& random) {
    const float middle = random.symmetric(0.8f);
    for (int i = 0; i < leaves; ++i) {
        const float x = middle + random.symmetric(1.0f) * random.uniform();
        const float drop = 1.5f * random.uniform() * (1.0f - 0.6f * std::abs(x - middle));
        const float z = 0.18f + random.range(0.0f, 0.1f) + (drop > 0.85f ? 0.45f : 0.0f);
        const glm::vec3 wild = random_direction(random);
        leaf(b, {x, kUpperFloor + 1.0f - drop, z}, glm::vec3{0, -0.7f, 0.1f} + 0.5f * wild,
             glm::vec3{0, 0.2f, 1} + 0.5f * wild, random.range(0.13f, 0.22f), p.ivy);
    }
}

void lemon_tree(MeshBuilder& b, const Palette& p, Random& random) {
    flower_pot(b, p, 0.45f, 0.7f);
    std::vector<glm::vec3> trunk{{0, 0.6f, 0}};
    for (int i = 1; i <= 4; ++i) {
        const float x = random.symmetric(0.06f), z = random.symmetric(0.06f);
        trunk.emplace_back(x, 0.6f + 0.35f * static_cast<float>(i), z);
    }
    tube(b, trunk, 0.05f, 8, p.bark);
    for (int i = 0; i < 5; ++i) {
        const glm::vec3 reach = random_direction(random) * 0.55f;
        const std::array<glm::vec3, 2> limb{{trunk.back() - glm::vec3{0.0f, 0.15f, 0.0f},
                                             trunk.back() + glm::vec3{reach.x, 0.5f, reach.z}}};
        tube(b, limb, 0.025f, 6, p.bark);
    }
    bush(b, {0.0f, 2.5f, 0.0f}, {0.85f, 0.75f, 0.85f}, 340, 0.42f, p.spray, random);
}

} // namespace

void hanging_chain(MeshBuilder& b, const Palette& p, float length) {
    constexpr float kHalf = 0.035f, kRepeat = 0.14f;
    const std::array<glm::vec2, 4> uvs{
        {{0, -length / kRepeat}, {1, -length / kRepeat}, {1, 0}, {0, 0}}};
    const std::array<glm::vec3, 4> wide{
        {{-kHalf, -length, 0}, {kHalf, -length, 0}, {kHalf, 0, 0}, {-kHalf, 0, 0}}};
    const std::array<glm::vec3, 4> deep{
        {{0, -length, kHalf}, {0, -length, -kHalf}, {0, 0, -kHalf}, {0, 0, kHalf}}};
    // The second card shows the links that the first one shows from the edge.
    std::array<glm::vec2, 4> shifted = uvs;
    for (glm::vec2& uv : shifted)
        uv.y += 0.5f;
    b.card(wide, uvs, p.chain);
    b.card(deep, shifted, p.chain);
}

void palm(MeshBuilder& b, const Palette& p, Random& random, int fronds, float length) {
    for (int i = 0; i < fronds; ++i) {
        const float ring = static_cast<float>(i) / static_cast<float>(fronds);
        const float turn = 0.381966f * static_cast<float>(i) + random.symmetric(0.04f);
        const float size = length * random.range(0.75f, 1.1f);
        arching_frond(b, turn, size, 0.25f + 0.75f * ring, p.frond);
    }
}

void bush(MeshBuilder& b, glm::vec3 centre, glm::vec3 radii, int leaves, float size,
          std::uint32_t material, Random& random) {
    for (int i = 0; i < leaves; ++i) {
        const glm::vec3 out = random_direction(random);
        const float depth = 1.0f - 0.5f * random.uniform() * random.uniform();
        const glm::vec3 wild = random_direction(random);
        const float length = size * random.range(0.7f, 1.2f);
        const glm::vec3 growth = out + 0.6f * wild + glm::vec3{0.0f, 0.35f, 0.0f};
        leaf(b, centre + out * radii * depth * 0.75f, growth, wild + glm::vec3{0.0f, 0.6f, 0.0f},
             length, material);
    }
}

void build_plants(MeshBuilder& b, const Palette& p, Random random) {
    const std::vector<Placement> nodes = court_nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        b.place = nodes[i];
        if (i % 5 == 1)
            ivy_on_column(b, p, 0.36f, 3.3f, 330, random);
        if (i % 3 == 0) {
            b.place.origin = nodes[i].point({0.0f, kCourtFloor, 1.25f});
            flower_pot(b, p, 0.34f, 0.55f);
            b.place.origin = nodes[i].point({0.0f, kCourtFloor + 0.5f, 1.25f});
            palm(b, p, random, 18, 1.25f);
        }
    }
    for (const Bay& bay : court_bays()) {
        b.place = bay.place;
        if ((bay.index + bay.side) % 3 == 1)
            ivy_over_rail(b, p, 260, random);
        if (bay.side < 2 && bay.index % 2 == 0) {
            b.place.origin = bay.place.point({0.0f, 0.0f, -kGallery + 0.55f});
            flower_pot(b, p, 0.3f, 0.5f);
            bush(b, {0.0f, 0.95f, 0.0f}, {0.5f, 0.5f, 0.5f}, 90, 0.4f, p.spray, random);
        }
    }
    for (const float x : {-9.6f, 9.6f})
        for (const float z : {-3.1f, 3.1f}) {
            b.place = upright({x, kCourtFloor, z});
            lemon_tree(b, p, random);
        }
    b.place = {};
}

} // namespace macula::scene::procedural
