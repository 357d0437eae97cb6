// Land, river, fields, woods.
#include <algorithm>
#include <cmath>

#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

float half_river(int size) {
    return std::max(3.0f, 0.016f * static_cast<float>(size));
}

std::int16_t ground_height(const TownPlan& plan, float x, float z) {
    const float scale = 1.0f / 64.0f;
    const float away =
        smooth_step(0.95f, 1.5f, plan.distance_from_middle(x, z) / std::max(plan.radius, 1.0f));
    const glm::vec3 p{x * scale, 0.0f, z * scale};
    const float rolling = fractal_noise(p, 4, plan.seed);
    const float crest = ridged_noise(p * 0.55f, 5, plan.seed + 10);
    float height = kTownLevel + 2.0f * rolling;
    height += away * (9.0f * rolling + 44.0f * std::max(0.0f, crest - 0.45f));
    // The river's bed and its banks.
    const float river = plan.river(x, z);
    height = glm::mix(kWaterLevel - 5.0f, height, smooth_step(0.6f, 2.2f, river));
    return static_cast<std::int16_t>(std::clamp(height, 8.0f, kVoxelHeight - 24.0f));
}

Block surface_block(const TownPlan& plan, int x, int z, int ground) {
    if (ground <= kWaterLevel)
        return Block::sand;
    if (plan.in_town(x, z))
        return Block::cobble;
    if (plan.on_avenue(x, z))
        return Block::gravel;
    if (ground > 62)
        return Block::snow;
    if (ground > 52)
        return Block::rock;
    return Block::grass;
}

// Strips of crops on gentle land around the town.
bool is_field(const TownPlan& plan, int x, int z) {
    if (plan.in_town(x, z) || plan.on_avenue(x, z, 3) || plan.ground_at(x, z) <= kWaterLevel + 1)
        return false;
    const float away = plan.distance_from_middle(static_cast<float>(x), static_cast<float>(z));
    const int cell_x = x / 22, cell_z = z / 16;
    const std::uint32_t h =
        hash(static_cast<std::uint32_t>(cell_x), static_cast<std::uint32_t>(cell_z), 5u, plan.seed);
    const bool ditch = x % 22 < 2 || z % 16 < 2;
    return !ditch && away < 1.55f * plan.radius && plan.ground_at(x, z) < 42 && h % 3u != 0u;
}

} // namespace

int TownPlan::ground_at(int x, int z) const {
    x = std::clamp(x, 0, size - 1);
    z = std::clamp(z, 0, size - 1);
    return ground[static_cast<std::size_t>(z) * static_cast<std::size_t>(size) +
                  static_cast<std::size_t>(x)];
}

float TownPlan::distance_from_middle(float x, float z) const {
    return glm::length(glm::vec2{x - middle(), z - middle()});
}

float TownPlan::river(float x, float z) const {
    const float length = static_cast<float>(size);
    const glm::vec2 bend = sin_cos_turns(1.3f * z / length + 0.2f);
    const float line = 0.27f * length + 0.06f * length * bend.y + 0.015f * length * bend.x;
    return std::fabs(x - line) / half_river(size);
}

bool TownPlan::on_avenue(int x, int z, int margin) const {
    const int half = kAvenueHalfWidth + margin;
    return std::abs(x - size / 2) <= half || std::abs(z - size / 2) <= half;
}

bool TownPlan::in_town(int x, int z) const {
    return distance_from_middle(static_cast<float>(x), static_cast<float>(z)) < radius;
}

TownPlan plan_town(int size, std::uint32_t seed) {
    TownPlan plan;
    plan.size = size;
    plan.radius = (plan.walled() ? 0.37f : 0.44f) * static_cast<float>(size);
    plan.seed = seed;
    plan.ground.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    std::size_t i = 0;
    for (int z = 0; z < size; ++z)
        for (int x = 0; x < size; ++x, ++i)
            plan.ground[i] =
                ground_height(plan, static_cast<float>(x) + 0.5f, static_cast<float>(z) + 0.5f);
    return plan;
}

void build_terrain(VoxelGrid& grid, const TownPlan& plan) {
    for (int z = 0; z < plan.size; ++z)
        for (int x = 0; x < plan.size; ++x) {
            const int ground = plan.ground_at(x, z);
            grid.fill({x, 0, z}, {x, ground - 4, z}, Block::rock);
            grid.fill({x, ground - 3, z}, {x, ground - 2, z}, Block::dirt);
            grid.set(x, ground - 1, z, surface_block(plan, x, z, ground));
            grid.fill({x, ground, z}, {x, kWaterLevel - 1, z}, Block::water);
        }
}

void plant_tree(VoxelGrid& grid, int x, int y, int z, Random& random) {
    const bool pine = y > 44 || random.chance(0.25f);
    const Block leaves = pine                   ? Block::pine_leaves
                         : random.chance(0.15f) ? Block::autumn_leaves
                                                : Block::oak_leaves;
    const int trunk = pine ? random.between(6, 9) : random.between(4, 6);
    grid.fill({x, y, z}, {x, y + trunk - 1, z}, Block::log);
    const int low = pine ? 2 : trunk - 2, high = trunk + 2;
    for (int dy = low; dy <= high; ++dy) {
        const float reach = pine ? 0.4f + 0.42f * static_cast<float>(high - dy) *
                                              ((high - dy) % 2 == 0 ? 0.75f : 1.0f)
                                 : (dy == high ? 1.3f : 2.5f);
        const int r = static_cast<int>(reach);
        for (int dz = -r; dz <= r; ++dz)
            for (int dx = -r; dx <= r; ++dx) {
                const bool inside = static_cast<float>(dx * dx + dz * dz) <= reach * reach;
                const bool kept = inside && !random.chance(0.08f);
                if (kept && grid.at(x + dx, y + dy, z + dz) == Block::air)
                    grid.set(x + dx, y + dy, z + dz, leaves);
            }
    }
}

void build_nature(VoxelGrid& grid, const TownPlan& plan, Random& random) {
    for (int z = 3; z < plan.size - 3; ++z)
        for (int x = 3; x < plan.size - 3; ++x) {
            const float chance = random.uniform();
            const int ground = plan.ground_at(x, z);
            if (grid.at(x, ground - 1, z) != Block::grass || grid.top(x, z) != ground)
                continue;
            if (is_field(plan, x, z)) {
                const bool crop = hash(static_cast<std::uint32_t>(x / 22),
                                       static_cast<std::uint32_t>(z / 16), 6u, plan.seed) %
                                      2u ==
                                  0u;
                grid.set(x, ground - 1, z, Block::field);
                if (crop && z % 2 == 0)
                    grid.set(x, ground, z, Block::wheat);
                continue;
            }
            const glm::vec3 p{static_cast<float>(x) / 40.0f, 3.0f, static_cast<float>(z) / 40.0f};
            const float wood = smooth_step(-0.05f, 0.3f, fractal_noise(p, 3, plan.seed + 20));
            // Leaves reach three blocks: the avenues stay open.
            if (!plan.on_avenue(x, z, 5) && chance < 0.003f + 0.035f * wood)
                plant_tree(grid, x, ground, z, random);
        }
}

} // namespace macula::scene::procedural
