// The parts of the atrium: a court of 7 x 3 bays, open to the sky, with two storeys of arcades and
// galleries around it. Metres; the court's middle is the origin, its long side lies along x.
#pragma once

#include <vector>

#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {

inline constexpr float kBay = 4.0f;
inline constexpr float kCourtX = 14.0f, kCourtZ = 6.0f; // half sizes, to the arcades' centre lines
inline constexpr float kGallery = 4.5f;                 // from there to the outer walls
inline constexpr float kCourtFloor = -0.15f;            // the galleries' floor is at 0
inline constexpr float kSpring = 3.7f;                  // springing of the ground floor's arches
inline constexpr float kVaultRise = 1.75f;
inline constexpr float kUpperFloor = 6.0f;
inline constexpr float kUpperSpring = 8.9f;
inline constexpr float kEaves = 10.8f, kRidge = 13.0f;

struct Palette {
    Finish ashlar, stone, plaster, vault, floor, slabs, roof, wood, brick, bronze, clay, water,
        soil;
    Finish cloth[3], canopy, bark;
    std::uint32_t ivy = 0, frond = 0, spray = 0, chain = 0, flame = 0;
};
Palette paint_atrium(Scene& scene, std::uint32_t seed);

// One bay of the arcade: origin on the arcade's centre line at floor level, x along the arcade,
// +z into the court.
struct Bay {
    Placement place;
    int side = 0, index = 0; // side 0: z = -kCourtZ, 1: z = +kCourtZ, 2: x = -kCourtX, 3: +kCourtX
};
std::vector<Bay> court_bays();
// Where the great columns stand, with z into the court; the four corners come last.
std::vector<Placement> court_nodes();
// A straight sweep along each side of the court at this height, mitred at the corners. The section
// is (distance into the court from the arcades' centre line, height).
void court_cornice(MeshBuilder& b, float height, std::span<const glm::vec2> section, Finish finish);

// Each part is built at b.place, standing on its local y = 0.
void great_column(MeshBuilder& b, const Palette& p);
void slender_column(MeshBuilder& b, const Palette& p);
void baluster(MeshBuilder& b, const Palette& p);
void flower_pot(MeshBuilder& b, const Palette& p, float radius, float height);
void fountain(MeshBuilder& b, const Palette& p);
void lantern(MeshBuilder& b, const Palette& p, float chain_length);
void rosette(MeshBuilder& b, const Palette& p, float radius);

void build_ground_arcade(MeshBuilder& b, const Palette& p);
void build_upper_arcade(MeshBuilder& b, const Palette& p);
void build_shell(MeshBuilder& b, const Palette& p); // floors, walls, vaults
void build_roof(MeshBuilder& b, const Palette& p);
void build_cloth(MeshBuilder& b, const Palette& p, Random random);
void build_plants(MeshBuilder& b, const Palette& p, Random random);

// A chain of two crossed cut-outs hanging from the local origin.
void hanging_chain(MeshBuilder& b, const Palette& p, float length);
// A potted palm or bush on the local origin.
void palm(MeshBuilder& b, const Palette& p, Random& random, int fronds, float length);
void bush(MeshBuilder& b, glm::vec3 centre, glm::vec3 radii, int leaves, float size,
          std::uint32_t material, Random& random);

} // namespace macula::scene::procedural
