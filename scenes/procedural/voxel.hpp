// A town of unit blocks: the grid, its surface as a mesh, and the parts of the town. x and z run
// over the grid's side, y is up; block (x, y, z) fills [x, x + 1) and so on.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/procedural/random.hpp"
#include "scenes/scene.hpp"

namespace macula::scene::procedural {

enum class Block : std::uint8_t {
    air,
    grass,
    dirt,
    rock,
    sand,
    water,
    snow,
    gravel,
    cobble,
    paving,
    field,
    wheat,
    oak_leaves,
    pine_leaves,
    autumn_leaves,
    log,
    timber,
    planks,
    white_plaster,
    ochre_plaster,
    rose_plaster,
    blue_plaster,
    brick,
    stone_brick,
    pale_stone,
    red_roof,
    slate_roof,
    copper_roof,
    glass,
    stained_glass,
    lamp,
    canvas,
    iron,
    count
};

class VoxelGrid {
  public:
    VoxelGrid(int size, int height);
    int size() const { return size_; }
    int height() const { return height_; }
    bool contains(int x, int y, int z) const {
        return x >= 0 && x < size_ && z >= 0 && z < size_ && y >= 0 && y < height_;
    }
    // Air outside the grid.
    Block at(int x, int y, int z) const {
        return contains(x, y, z) ? blocks_[index(x, y, z)] : Block::air;
    }
    // Nothing happens outside the grid.
    void set(int x, int y, int z, Block block) {
        if (contains(x, y, z))
            blocks_[index(x, y, z)] = block;
    }
    // Both corners included.
    void fill(glm::ivec3 lo, glm::ivec3 hi, Block block);
    // One above the highest block of the column, 0 if there is none or it lies outside.
    int top(int x, int z) const;
    // The blocks of layer y, row after row of x.
    const Block* layer(int y) const { return blocks_.data() + index(0, y, 0); }

  private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
                static_cast<std::size_t>(z)) *
                   static_cast<std::size_t>(size_) +
               static_cast<std::size_t>(x);
    }
    int size_, height_;
    std::vector<Block> blocks_;
};

// Tones of a block's colour, chosen by its position: materials are block-major, kTones each.
inline constexpr std::uint32_t kTones = 3;

// The faces between a block and air, with one vertex at each lattice point that they touch; the
// grid's floor is left out, since nothing can look at it from below. No normals, no uvs.
Mesh voxel_surface(const VoxelGrid& grid);

// The lie of the land, fixed before anything is built.
struct TownPlan {
    int size = 0;
    float radius = 0.0f; // of the town, about its middle
    std::uint32_t seed = 0;
    std::vector<std::int16_t> ground; // height of the first air above the soil, z-major

    float middle() const { return 0.5f * static_cast<float>(size); }
    int ground_at(int x, int z) const;
    float distance_from_middle(float x, float z) const;
    // Distance to the river's middle line over its half width: below 1 is water.
    float river(float x, float z) const;
    // Within the two avenues, which cross in the middle; `margin` blocks more to each side.
    bool on_avenue(int x, int z, int margin = 0) const;
    bool in_town(int x, int z) const;
    // Small towns are villages: no wall, no cathedral.
    bool walled() const { return size >= 200; }
};

inline constexpr int kWaterLevel = 26;   // first air above the river
inline constexpr int kTownLevel = 30;    // about the ground in the town
inline constexpr int kVoxelHeight = 112; // of the grid
inline constexpr int kAvenueHalfWidth = 4;

struct Lot {
    int x0, z0, x1, z1; // both included
    int width() const { return x1 - x0 + 1; }
    int depth() const { return z1 - z0 + 1; }
};

TownPlan plan_town(int size, std::uint32_t seed);
void build_terrain(VoxelGrid& grid, const TownPlan& plan);
// Splits the town by streets; the lots lie on land, off the avenues and the squares.
std::vector<Lot> plan_lots(const TownPlan& plan, Random& random);
void build_house(VoxelGrid& grid, const TownPlan& plan, const Lot& lot, Random& random);
void build_landmarks(VoxelGrid& grid, const TownPlan& plan, Random& random);
void build_nature(VoxelGrid& grid, const TownPlan& plan, Random& random);
void plant_tree(VoxelGrid& grid, int x, int y, int z, Random& random);

// The cathedral's lot, on a square beside the avenues; empty (x1 < x0) in small towns.
Lot cathedral_lot(const TownPlan& plan);

} // namespace macula::scene::procedural
