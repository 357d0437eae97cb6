// Streets, lots and houses.
#include <algorithm>
#include <cstdlib>

#include "scenes/procedural/voxel.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kStorey = 4; // three blocks of room and a floor

// Splits by streets, wide ones first, until a rectangle is small enough to be a lot.
void split(Lot area, Random& random, std::vector<Lot>& lots) {
    const int longer = std::max(area.width(), area.depth());
    const int shorter = std::min(area.width(), area.depth());
    if (shorter < 7)
        return;
    const int largest = random.between(14, 22);
    if (longer <= largest) {
        lots.push_back(area);
        return;
    }
    const int street = longer > 70 ? 5 : longer > 40 ? 3 : 2;
    const int share = random.between(38, 62);
    const int cut = longer * share / 100;
    Lot first = area, second = area;
    if (area.width() >= area.depth()) {
        first.x1 = area.x0 + cut - 1;
        second.x0 = first.x1 + 1 + street;
    } else {
        first.z1 = area.z0 + cut - 1;
        second.z0 = first.z1 + 1 + street;
    }
    split(first, random, lots);
    split(second, random, lots);
}

bool overlaps(const Lot& a, const Lot& b, int margin) {
    return a.x0 <= b.x1 + margin && b.x0 <= a.x1 + margin && a.z0 <= b.z1 + margin &&
           b.z0 <= a.z1 + margin;
}

bool usable(const TownPlan& plan, const Lot& lot) {
    const float limit = plan.walled() ? plan.radius - 7.0f : 1.35f * plan.radius;
    for (const int x : {lot.x0, lot.x1})
        for (const int z : {lot.z0, lot.z1}) {
            const float away =
                plan.distance_from_middle(static_cast<float>(x), static_cast<float>(z));
            if (away > limit || plan.river(static_cast<float>(x), static_cast<float>(z)) < 2.0f)
                return false;
        }
    const Lot cathedral = cathedral_lot(plan);
    return !(cathedral.x0 <= cathedral.x1 && overlaps(lot, cathedral, 9));
}

struct HouseStyle {
    Block wall, frame, roof, ground_floor;
    int storeys;
    bool stepped_out; // upper storeys reach one block over the street
};

HouseStyle choose_style(const TownPlan& plan, const Lot& lot, Random& random) {
    constexpr Block kWalls[] = {Block::white_plaster, Block::ochre_plaster, Block::rose_plaster,
                                Block::blue_plaster,  Block::brick,         Block::white_plaster};
    constexpr Block kRoofs[] = {Block::red_roof, Block::red_roof, Block::slate_roof,
                                Block::red_roof};
    HouseStyle style;
    style.wall = kWalls[random.below(6)];
    style.roof = kRoofs[random.below(4)];
    style.frame = style.wall == Block::brick ? Block::pale_stone : Block::timber;
    style.ground_floor = random.chance(0.45f) ? Block::stone_brick : style.wall;
    const float away = plan.distance_from_middle(0.5f * static_cast<float>(lot.x0 + lot.x1),
                                                 0.5f * static_cast<float>(lot.z0 + lot.z1));
    const int most = away < 0.45f * plan.radius ? 5 : away < 0.75f * plan.radius ? 4 : 3;
    style.storeys = random.between(std::max(1, most - 2), most);
    style.stepped_out = random.chance(0.35f);
    return style;
}

// The four walls of a storey, with windows and a frame of timber.
void walls(VoxelGrid& grid, const Lot& lot, int y, const HouseStyle& style, bool ground_floor,
           Random& random) {
    const Block wall = ground_floor ? style.ground_floor : style.wall;
    const int phase = random.between(2, 3);
    const auto put = [&](int x, int z, int along, int length) {
        const bool corner = along == 0 || along == length - 1;
        const bool post = corner || (!ground_floor && along % 4 == 0);
        const bool window = !corner && along % 4 == phase % 4;
        grid.fill({x, y, z}, {x, y + kStorey - 1, z}, post ? style.frame : wall);
        if (window)
            grid.fill({x, y + 1, z}, {x, y + 2, z}, Block::glass);
        grid.set(x, y + kStorey - 1, z, style.frame);
    };
    for (int x = lot.x0; x <= lot.x1; ++x)
        for (const int z : {lot.z0, lot.z1})
            put(x, z, x - lot.x0, lot.width());
    for (int z = lot.z0; z <= lot.z1; ++z)
        for (const int x : {lot.x0, lot.x1})
            put(x, z, z - lot.z0, lot.depth());
}

// A gable roof with its ridge along the longer side, reaching one block over the walls.
void gable_roof(VoxelGrid& grid, const Lot& lot, int y, Block roof, Block gable) {
    const bool along_x = lot.width() >= lot.depth();
    const int span = along_x ? lot.depth() : lot.width();
    const int length = along_x ? lot.width() : lot.depth();
    const auto put = [&](int along, int across, int height, Block block) {
        const int x = lot.x0 + (along_x ? along : across), z = lot.z0 + (along_x ? across : along);
        grid.set(x, y + height, z, block);
    };
    for (int along = -1; along <= length; ++along)
        for (int across = -1; across <= span; ++across) {
            const int height = std::min(across, span - 1 - across);
            put(along, across, height, roof);
            // One block does not close the step to the next row.
            if (height >= 0)
                put(along, across, height - 1, roof);
            const bool end = along == 0 || along == length - 1;
            for (int h = 0; end && h < height - 1; ++h)
                put(along, across, h, gable);
        }
    const int middle = span / 2;
    for (const int along : {0, length - 1})
        if (middle > 3)
            put(along, middle, middle / 2, Block::glass);
}

void flat_roof(VoxelGrid& grid, const Lot& lot, int y, Block parapet) {
    grid.fill({lot.x0, y, lot.z0}, {lot.x1, y, lot.z1}, Block::paving);
    for (int x = lot.x0; x <= lot.x1; ++x)
        for (int z = lot.z0; z <= lot.z1; ++z) {
            const bool edge = x == lot.x0 || x == lot.x1 || z == lot.z0 || z == lot.z1;
            if (edge)
                grid.fill({x, y + 1, z}, {x, y + 1 + ((x + z) % 2 == 0 ? 1 : 0), z}, parapet);
        }
}

void garden(VoxelGrid& grid, const TownPlan& plan, const Lot& lot, Random& random) {
    for (int z = lot.z0; z <= lot.z1; ++z)
        for (int x = lot.x0; x <= lot.x1; ++x)
            grid.set(x, plan.ground_at(x, z) - 1, z, Block::grass);
    const int trees = random.between(1, 4);
    for (int i = 0; i < trees; ++i) {
        const int x = random.between(lot.x0 + 2, lot.x1 - 2);
        const int z = random.between(lot.z0 + 2, lot.z1 - 2);
        plant_tree(grid, x, plan.ground_at(x, z), z, random);
    }
}

// Level ground for a house: soil dug away above, stone laid below.
int lay_foundation(VoxelGrid& grid, const TownPlan& plan, const Lot& lot) {
    int level = 0;
    for (int z = lot.z0; z <= lot.z1; ++z)
        for (int x = lot.x0; x <= lot.x1; ++x)
            level = std::max(level, plan.ground_at(x, z));
    for (int z = lot.z0; z <= lot.z1; ++z)
        for (int x = lot.x0; x <= lot.x1; ++x)
            grid.fill({x, plan.ground_at(x, z) - 1, z}, {x, level - 1, z}, Block::stone_brick);
    return level;
}

} // namespace

std::vector<Lot> plan_lots(const TownPlan& plan, Random& random) {
    const int reach = static_cast<int>(plan.radius), middle = plan.size / 2;
    const int gap = kAvenueHalfWidth + 3;
    std::vector<Lot> all, lots;
    for (const int sx : {-1, 1})
        for (const int sz : {-1, 1}) {
            const int near_x = middle + sx * gap, far_x = middle + sx * reach;
            const int near_z = middle + sz * gap, far_z = middle + sz * reach;
            split({std::min(near_x, far_x), std::min(near_z, far_z), std::max(near_x, far_x),
                   std::max(near_z, far_z)},
                  random, all);
        }
    std::copy_if(all.begin(), all.end(), std::back_inserter(lots),
                 [&](const Lot& lot) { return usable(plan, lot); });
    return lots;
}

void build_house(VoxelGrid& grid, const TownPlan& plan, const Lot& lot, Random& random) {
    if (random.chance(0.07f)) {
        garden(grid, plan, lot, random);
        return;
    }
    const HouseStyle style = choose_style(plan, lot, random);
    const int base = lay_foundation(grid, plan, lot);
    Lot storey{lot.x0 + 1, lot.z0 + 1, lot.x1 - 1, lot.z1 - 1};
    int y = base;
    for (int i = 0; i < style.storeys; ++i, y += kStorey) {
        if (i == 1 && style.stepped_out)
            storey = lot;
        walls(grid, storey, y, style, i == 0, random);
        grid.fill({storey.x0 + 1, y - 1, storey.z0 + 1}, {storey.x1 - 1, y - 1, storey.z1 - 1},
                  Block::planks);
        if (i == 1 && style.stepped_out)
            grid.fill({storey.x0, y - 1, storey.z0}, {storey.x1, y - 1, storey.z1}, Block::timber);
    }
    const int door = storey.x0 + storey.width() / 2;
    grid.fill({door, base, lot.z0 + 1}, {door, base + 2, lot.z0 + 1}, Block::air);
    grid.fill({storey.x0, y - 1, storey.z0}, {storey.x1, y - 1, storey.z1}, Block::planks);
    if (random.chance(0.06f)) {
        flat_roof(grid, storey, y, Block::pale_stone);
        return;
    }
    gable_roof(grid, storey, y, style.roof, style.wall);
    const int x = storey.x0 + 1 + static_cast<int>(random.below(2)) * (storey.width() - 3);
    const int peak = y + std::min(storey.width(), storey.depth()) / 2 + 2;
    const int z = storey.z0 + storey.depth() / 2;
    grid.fill({x, y, z}, {x, peak, z}, Block::brick);
}

} // namespace macula::scene::procedural
