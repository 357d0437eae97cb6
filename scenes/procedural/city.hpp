// The parts of the city: metres, +y up, streets along x and z, the ground at y = 0.
#pragma once

#include <vector>

#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {

inline constexpr int kBlocksX = 6, kBlocksZ = 6;
inline constexpr float kBlockX = 64.0f, kBlockZ = 46.0f; // between kerbs
inline constexpr float kStreet = 14.0f;                  // kerb to kerb
inline constexpr float kPitchX = kBlockX + kStreet, kPitchZ = kBlockZ + kStreet;
inline constexpr float kKerb = 0.15f, kSidewalk = 3.5f;

struct CityPalette {
    Finish brick[3], stone, concrete, pale_concrete, trim, pavement, asphalt, marking, gravel,
        metal, dark_metal, awning[3], bark, wood, lawn;
    std::uint32_t glass[4] = {}, leaves[2] = {}, lamp = 0, country = 0, sign[3] = {};
};
CityPalette paint_city(Scene& scene, std::uint32_t seed);

// The middle of the street before block column (row) i, 0..kBlocks, along x (z).
float street_x(int i);
float street_z(int i);

// A wall from x = 0 to width and y0 up in the local frame, looking to +z.
struct Wall {
    float width, y0;
    int floors;
    float storey; // height of one floor
};
void punched_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, bool balconies,
                  Random& random);
// Flush windows in a plain wall: the side to the yard.
void rear_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random);
void ribbon_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random);
void curtain_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Random& random);
void pier_wall(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random);
// One storey of shop windows with awnings and signs.
void shop_front(MeshBuilder& b, const CityPalette& p, const Wall& w, Finish wall, Random& random);

// Sides of a plot that light reaches: the others stand against a neighbour.
enum PlotSide : unsigned { kSouth = 1, kEast = 2, kNorth = 4, kWest = 8, kAllSides = 15 };

// A rectangle of ground: x and z of its corners. South is +z.
struct Plot {
    glm::vec2 lo, hi;
    unsigned open = kAllSides;
    unsigned rear = 0; // open sides that face a yard
    glm::vec2 size() const { return hi - lo; }
};
void build_building(MeshBuilder& b, const CityPalette& p, const Plot& plot, float height,
                    Random& random);
void build_park(MeshBuilder& b, const CityPalette& p, const Plot& plot, Random& random);
// Roadway, markings, pavements, kerbs, lamps, street trees.
void build_streets(MeshBuilder& b, const CityPalette& p, Random random);
void street_tree(MeshBuilder& b, const CityPalette& p, float height, Random& random);

// Cars and a van, each a mesh of its own with z along the driving direction; and where they stand
// in the streets, as instances of the meshes numbered from `first_mesh`.
std::vector<Mesh> build_cars(Scene& scene, const CityPalette& p);
void place_cars(Scene& scene, std::uint32_t first_mesh, std::uint32_t count, Random random);

} // namespace macula::scene::procedural
