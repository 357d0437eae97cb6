// What stands out of the roofs: cathedral, town wall, towers, bridges, boats, street lamps.
#include <algorithm>
#include <cmath>

#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kWallHeight = 9;

void ring_of_walls(VoxelGrid& grid, glm::ivec3 lo, glm::ivec3 hi, Block block) {
    grid.fill(lo, {hi.x, hi.y, lo.z}, block);
    grid.fill({lo.x, lo.y, hi.z}, hi, block);
    grid.fill(lo, {lo.x, hi.y, hi.z}, block);
    grid.fill({hi.x, lo.y, lo.z}, hi, block);
}

// A square spire on half width `half`, two blocks up for each block in.
void spire(VoxelGrid& grid, int x, int y, int z, int half, Block block) {
    for (int step = 0; half - step / 2 >= 0; ++step) {
        const int r = half - step / 2;
        ring_of_walls(grid, {x - r, y + step, z - r}, {x + r, y + step, z + r}, block);
    }
    grid.fill({x, y + 2 * half, z}, {x, y + 2 * half + 4, z}, Block::iron);
}

void bell_tower(VoxelGrid& grid, int x, int y, int z, int half, int height) {
    ring_of_walls(grid, {x - half, y, z - half}, {x + half, y + height, z + half},
                  Block::pale_stone);
    for (int level = 6; level + 8 < height; level += 12)
        for (const int side : {-half, half}) {
            grid.fill({x - 1, y + level, z + side}, {x + 1, y + level + 6, z + side},
                      Block::stained_glass);
            grid.fill({x + side, y + level, z - 1}, {x + side, y + level + 6, z + 1},
                      Block::stained_glass);
        }
    // The open belfry.
    for (const int side : {-half, half}) {
        grid.fill({x - half + 2, y + height - 6, z + side},
                  {x + half - 2, y + height - 2, z + side}, Block::air);
        grid.fill({x + side, y + height - 6, z - half + 2},
                  {x + side, y + height - 2, z + half - 2}, Block::air);
    }
    grid.fill({x - half, y + height - 7, z - half}, {x + half, y + height - 7, z + half},
              Block::paving);
    ring_of_walls(grid, {x - half - 1, y + height, z - half - 1},
                  {x + half + 1, y + height, z + half + 1}, Block::stone_brick);
    spire(grid, x, y + height + 1, z, half, Block::copper_roof);
}

void cathedral(VoxelGrid& grid, const TownPlan& plan, const Lot& lot) {
    int y = 0;
    for (int z = lot.z0; z <= lot.z1; ++z)
        for (int x = lot.x0; x <= lot.x1; ++x)
            y = std::max(y, plan.ground_at(x, z));
    grid.fill({lot.x0 - 2, y - 6, lot.z0 - 2}, {lot.x1 + 2, y - 1, lot.z1 + 2}, Block::paving);
    const int middle = (lot.x0 + lot.x1) / 2, half = lot.width() / 2, rise = half + 10;
    const int nave = half - 3; // half width of the nave between its aisles
    const int z0 = lot.z0 + 10;
    for (int z = z0; z <= lot.z1; ++z) {
        const bool buttress = (z - z0) % 6 == 0;
        for (const int side : {-1, 1}) {
            // Aisle wall, clerestory, buttress.
            grid.fill({middle + side * half, y, z}, {middle + side * half, y + 8, z},
                      buttress ? Block::stone_brick : Block::pale_stone);
            grid.fill({middle + side * nave, y + 9, z}, {middle + side * nave, y + rise, z},
                      Block::pale_stone);
            if (buttress) {
                grid.fill({middle + side * (half + 1), y, z},
                          {middle + side * (half + 1), y + 5, z}, Block::stone_brick);
                grid.fill({middle + side * nave, y, z}, {middle + side * nave, y + 8, z},
                          Block::pale_stone);
            } else if ((z - z0) % 6 != 5 && (z - z0) % 6 != 1) {
                grid.fill({middle + side * half, y + 2, z}, {middle + side * half, y + 6, z},
                          Block::stained_glass);
                grid.fill({middle + side * nave, y + 11, z},
                          {middle + side * nave, y + rise - 2, z}, Block::stained_glass);
            }
            for (int k = 0; k <= half - nave; ++k)
                grid.set(middle + side * (nave + k), y + 9 + (half - nave - k), z,
                         Block::slate_roof);
        }
        for (int k = -nave - 1; k <= nave + 1; ++k) {
            const int top = y + rise + (nave + 1 - std::abs(k));
            grid.fill({middle + k, top, z}, {middle + k, top + 1, z}, Block::slate_roof);
            const bool end = z == z0 || z == lot.z1;
            if (end)
                grid.fill({middle + k, y, z}, {middle + k, top - 1, z}, Block::pale_stone);
        }
    }
    // West front: portal and rose window between two towers.
    grid.fill({middle - 1, y, z0}, {middle + 1, y + 5, z0}, Block::air);
    for (int dy = -4; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx)
            if (dx * dx + dy * dy <= 17)
                grid.set(middle + dx, y + rise - 4 + dy, z0, Block::stained_glass);
    for (const int side : {-1, 1})
        bell_tower(grid, middle + side * (half - 2), y, lot.z0 + 5, 5, rise + 24);
}

void round_tower(VoxelGrid& grid, const TownPlan& plan, int x, int z, int radius) {
    const int y = plan.ground_at(x, z), top = y + kWallHeight + 6;
    for (int dz = -radius; dz <= radius; ++dz)
        for (int dx = -radius; dx <= radius; ++dx) {
            const int d = dx * dx + dz * dz;
            if (d > radius * radius + 1)
                continue;
            const bool shell = d > (radius - 1) * (radius - 1);
            if (shell)
                grid.fill({x + dx, y - 4, z + dz}, {x + dx, top, z + dz}, Block::stone_brick);
            grid.set(x + dx, top - 2, z + dz, Block::planks);
            const float away = std::sqrt(static_cast<float>(d));
            const int cone = static_cast<int>(1.8f * (static_cast<float>(radius) + 1.0f - away));
            grid.fill({x + dx, top + std::max(1, cone - 1), z + dz}, {x + dx, top + cone, z + dz},
                      Block::red_roof);
        }
}

void town_wall(VoxelGrid& grid, const TownPlan& plan) {
    const float r = plan.radius - 2.5f;
    for (int z = 0; z < plan.size; ++z)
        for (int x = 0; x < plan.size; ++x) {
            const float away = plan.distance_from_middle(static_cast<float>(x) + 0.5f,
                                                         static_cast<float>(z) + 0.5f) -
                               r;
            const int ground = plan.ground_at(x, z);
            if (std::fabs(away) > 1.6f || plan.on_avenue(x, z, 1) || ground <= kWaterLevel)
                continue;
            const bool outer = away > 0.5f;
            const int merlon = outer ? ((x + z) % 4 < 2 ? 2 : 1) : 0;
            grid.fill({x, ground - 3, z}, {x, kTownLevel + kWallHeight + merlon, z},
                      Block::stone_brick);
        }
    const int towers = std::max(8, static_cast<int>(plan.radius / 9.0f));
    for (int i = 0; i < towers; ++i) {
        const glm::vec2 at = plan.middle() + r * sin_cos_turns((static_cast<float>(i) + 0.5f) /
                                                               static_cast<float>(towers));
        const int x = static_cast<int>(at.x), z = static_cast<int>(at.y);
        if (plan.ground_at(x, z) > kWaterLevel && !plan.on_avenue(x, z, 8))
            round_tower(grid, plan, x, z, 4);
    }
}

// Carries both avenues over water and hollows at the level of the town.
void bridges(VoxelGrid& grid, const TownPlan& plan) {
    for (int along = 0; along < plan.size; ++along)
        for (int across = -kAvenueHalfWidth; across <= kAvenueHalfWidth; ++across)
            for (const bool along_x : {true, false}) {
                const int x = along_x ? along : plan.size / 2 + across;
                const int z = along_x ? plan.size / 2 + across : along;
                const int ground = plan.ground_at(x, z);
                if (plan.river(static_cast<float>(x), static_cast<float>(z)) > 2.6f ||
                    ground >= kTownLevel)
                    continue;
                const bool pier = along % 9 < 2;
                const int arch = along % 9 == 2 || along % 9 == 8 ? 3 : 2;
                grid.fill({x, pier ? 0 : kTownLevel - arch, z}, {x, kTownLevel - 1, z},
                          Block::pale_stone);
                if (std::abs(across) == kAvenueHalfWidth)
                    grid.set(x, kTownLevel, z, Block::stone_brick);
            }
}

void boat(VoxelGrid& grid, int x, int z) {
    constexpr int kHalf = 6;
    for (int along = -kHalf; along <= kHalf; ++along) {
        const int beam = std::abs(along) == kHalf ? 0 : std::abs(along) >= kHalf - 2 ? 1 : 2;
        const int sheer = std::abs(along) >= kHalf - 1 ? 1 : 0;
        grid.fill({x - beam, kWaterLevel - 1, z + along}, {x + beam, kWaterLevel - 1, z + along},
                  Block::planks);
        for (const int side : {-beam, beam})
            grid.fill({x + side, kWaterLevel, z + along},
                      {x + side, kWaterLevel + sheer, z + along}, Block::timber);
    }
    grid.fill({x, kWaterLevel, z}, {x, kWaterLevel + 12, z}, Block::log);
    for (int dy = 4; dy <= 10; ++dy)
        grid.fill({x - 3, kWaterLevel + dy, z + 1}, {x + 3, kWaterLevel + dy, z + 1},
                  Block::canvas);
}

void street_lamps(VoxelGrid& grid, const TownPlan& plan) {
    const int side = kAvenueHalfWidth + 1;
    for (int along = 6; along < plan.size - 6; along += 11)
        for (const int across : {-side, side})
            for (const bool along_x : {true, false}) {
                const int x = along_x ? along : plan.size / 2 + across;
                const int z = along_x ? plan.size / 2 + across : along;
                const bool crossing = std::abs(along - plan.size / 2) <= side + 2;
                if (crossing || !plan.in_town(x, z) || plan.ground_at(x, z) <= kWaterLevel)
                    continue;
                const int y = plan.ground_at(x, z);
                grid.fill({x, y, z}, {x, y + 3, z}, Block::iron);
                grid.set(x, y + 4, z, Block::lamp);
            }
}

} // namespace

Lot cathedral_lot(const TownPlan& plan) {
    if (!plan.walled())
        return {0, 0, -1, -1};
    const int x0 = plan.size / 2 + kAvenueHalfWidth + 14,
              z0 = plan.size / 2 + kAvenueHalfWidth + 12;
    return {x0, z0, x0 + 22, z0 + 62};
}

void build_landmarks(VoxelGrid& grid, const TownPlan& plan, Random& random) {
    if (plan.walled())
        town_wall(grid, plan);
    bridges(grid, plan);
    street_lamps(grid, plan);
    const Lot lot = cathedral_lot(plan);
    if (lot.x0 <= lot.x1)
        cathedral(grid, plan, lot);
    for (int z = 20; z < plan.size - 20; z += random.between(26, 60)) {
        if (std::abs(z - plan.size / 2) < 24)
            continue;
        int best = -1;
        for (int x = 0; x < plan.size && best < 0; ++x)
            if (plan.river(static_cast<float>(x), static_cast<float>(z)) < 0.2f)
                best = x;
        if (best >= 0)
            boat(grid, best, z);
    }
}

} // namespace macula::scene::procedural
