// Cars: a body lofted from cross sections, wheels, lights; placed as instances.
#include <algorithm>
#include <array>
#include <vector>

#include "scenes/procedural/city.hpp"
#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {
namespace {

// The side view: stations along z from tail to nose with the heights of sill, waist and roof.
struct Station4 {
    float z, sill, waist, roof, half; // `half`: half width at the waist
};

std::uint32_t add_paint(Scene& scene, const char* name, std::uint32_t colour) {
    const std::uint32_t index = add_material(scene, name, rgb(colour));
    scene.materials[index].specular = glm::vec3{0.5f};
    scene.materials[index].shininess = 60.0f;
    scene.materials[index].reflectivity = glm::vec3{0.12f};
    return index;
}

// Half a cross section from sill to roof, as (half width, height).
std::array<glm::vec2, 6> section(const Station4& s) {
    const float cabin = s.roof - s.waist;
    const float roof_half = s.half * (cabin > 0.1f ? 0.74f : 0.92f);
    return {{{0.9f * s.half, s.sill},
             {s.half, s.sill + 0.25f * (s.waist - s.sill)},
             {s.half, s.sill + 0.7f * (s.waist - s.sill)},
             {0.96f * s.half, s.waist},
             {roof_half, s.roof - 0.1f * cabin},
             {0.55f * roof_half, s.roof}}};
}

void body(MeshBuilder& b, std::span<const Station4> stations, std::uint32_t paint,
          std::uint32_t glass) {
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const auto back = section(stations[i]), front = section(stations[i + 1]);
        const float z0 = stations[i].z, z1 = stations[i + 1].z;
        for (const float side : {1.0f, -1.0f}) {
            const auto at = [&](glm::vec2 p, float z) { return glm::vec3{side * p.x, p.y, z}; };
            for (std::size_t k = 0; k + 1 < back.size(); ++k) {
                const bool cabin = k == 3 && stations[i].roof - stations[i].waist > 0.1f &&
                                   stations[i + 1].roof - stations[i + 1].waist > 0.1f;
                std::array<glm::vec3, 4> c{at(back[k], z0), at(back[k + 1], z0),
                                           at(front[k + 1], z1), at(front[k], z1)};
                if (side < 0.0f)
                    std::swap(c[1], c[3]);
                b.face(c, {cabin ? glass : paint, 1.0f});
            }
        }
        // The roof, bonnet or screen between both halves.
        const glm::vec2 p = back.back(), q = front.back();
        const bool screen = std::abs(p.y - q.y) > 0.25f;
        b.face({{-p.x, p.y, z0}, {-q.x, q.y, z1}, {q.x, q.y, z1}, {p.x, p.y, z0}},
               {screen ? glass : paint, 1.0f});
    }
    for (const bool nose : {false, true}) {
        const Station4& s = nose ? stations.back() : stations.front();
        const auto half = section(s);
        std::vector<glm::vec3> ring;
        ring.reserve(2 * half.size());
        for (const glm::vec2& p : half)
            ring.emplace_back(p.x, p.y, s.z);
        for (std::size_t k = half.size(); k-- > 0;)
            ring.emplace_back(-half[k].x, half[k].y, s.z);
        if (!nose)
            std::reverse(ring.begin(), ring.end());
        b.face(ring, {paint, 1.0f});
    }
}

void wheels(MeshBuilder& b, float front, float rear, float half, Finish tyre, Finish rim) {
    constexpr float kRadius = 0.34f, kWidth = 0.22f;
    constexpr std::array<glm::vec2, 4> kProfile{{{0.0f, -0.5f * kWidth},
                                                 {kRadius, -0.5f * kWidth},
                                                 {kRadius, 0.5f * kWidth},
                                                 {0.2f, 0.5f * kWidth}}};
    constexpr std::array<glm::vec2, 2> kHub{{{0.2f, 0.5f * kWidth}, {0.0f, 0.4f * kWidth}}};
    const Placement at = b.place;
    for (const float z : {front, rear})
        for (const float side : {-1.0f, 1.0f}) {
            b.place = along({side * (half - 0.12f), kRadius, z}, {side, 0.0f, 0.0f});
            revolve(b, kProfile, {12, 0.0f, 1.0f, {}}, tyre);
            revolve(b, kHub, {8, 0.0f, 1.0f, {}}, rim);
        }
    b.place = at;
}

void lights(MeshBuilder& b, const Station4& nose, const Station4& tail, std::uint32_t lamp,
            std::uint32_t red) {
    for (const float side : {-1.0f, 1.0f}) {
        const float x = side * 0.68f * nose.half;
        const float y = nose.sill + 0.62f * (nose.waist - nose.sill);
        box(b, {x - 0.16f, y - 0.07f, nose.z - 0.02f}, {x + 0.16f, y + 0.07f, nose.z + 0.03f},
            {lamp, 1.0f}, kBack);
        const float back = tail.sill + 0.7f * (tail.waist - tail.sill);
        box(b, {x - 0.14f, back - 0.06f, tail.z - 0.03f}, {x + 0.14f, back + 0.08f, tail.z + 0.02f},
            {red, 1.0f}, kFront);
    }
}

Mesh car(const char* name, std::span<const Station4> stations, float front, float rear,
         std::uint32_t paint, const CityPalette& p) {
    MeshBuilder b(name);
    body(b, stations, paint, p.glass[0]);
    wheels(b, front, rear, 0.86f, {p.dark_metal.material, 1.0f}, p.metal);
    lights(b, stations.back(), stations.front(), p.lamp, p.sign[0]);
    return b.take();
}

constexpr std::array<Station4, 10> kSaloon{{{-2.2f, 0.42f, 0.80f, 0.86f, 0.78f},
                                            {-2.1f, 0.30f, 0.92f, 0.98f, 0.86f},
                                            {-1.5f, 0.25f, 0.95f, 1.00f, 0.88f},
                                            {-0.9f, 0.24f, 0.95f, 1.40f, 0.89f},
                                            {-0.2f, 0.24f, 0.94f, 1.45f, 0.89f},
                                            {0.4f, 0.24f, 0.92f, 1.40f, 0.88f},
                                            {1.0f, 0.25f, 0.88f, 0.93f, 0.87f},
                                            {1.6f, 0.27f, 0.80f, 0.85f, 0.85f},
                                            {2.1f, 0.32f, 0.70f, 0.74f, 0.80f},
                                            {2.2f, 0.42f, 0.62f, 0.66f, 0.72f}}};
constexpr std::array<Station4, 8> kVan{{{-2.5f, 0.42f, 1.10f, 2.05f, 0.90f},
                                        {-2.4f, 0.32f, 1.12f, 2.15f, 0.95f},
                                        {0.2f, 0.28f, 1.12f, 2.18f, 0.96f},
                                        {1.2f, 0.28f, 1.12f, 2.10f, 0.95f},
                                        {1.9f, 0.28f, 1.08f, 1.20f, 0.94f},
                                        {2.4f, 0.30f, 0.96f, 1.04f, 0.92f},
                                        {2.6f, 0.34f, 0.84f, 0.90f, 0.88f},
                                        {2.66f, 0.42f, 0.74f, 0.80f, 0.82f}}};

} // namespace

std::vector<Mesh> build_cars(Scene& scene, const CityPalette& p) {
    constexpr std::array<std::pair<const char*, std::uint32_t>, 5> kPaints{
        {{"car_red", 0x9c2a26},
         {"car_blue", 0x2c4a78},
         {"car_white", 0xdcdcd6},
         {"car_black", 0x23262a},
         {"taxi_yellow", 0xe2ae28}}};
    std::vector<Mesh> cars;
    cars.reserve(kPaints.size() + 1);
    for (const auto& [name, colour] : kPaints)
        cars.push_back(car(name, kSaloon, 1.35f, -1.35f, add_paint(scene, name, colour), p));
    cars.push_back(car("van", kVan, 1.6f, -1.5f, add_paint(scene, "van_green", 0x486a58), p));
    return cars;
}

void place_cars(Scene& scene, std::uint32_t first_mesh, std::uint32_t count, Random random) {
    const auto place = [&](glm::vec3 at, float turns) {
        const Placement frame = upright(at, turns);
        Transform t;
        for (int row = 0; row < 3; ++row)
            t.row[row] = {frame.x[row], frame.y[row], frame.z[row], frame.origin[row]};
        const std::uint32_t mesh = first_mesh + random.below(count);
        scene.instances.push_back({mesh, t, "car_" + std::to_string(scene.instances.size())});
    };
    constexpr float kSpace = 7.0f, kLane = 2.4f, kParked = 0.5f * kStreet - 1.25f;
    const auto line = [&](glm::vec3 start, glm::vec3 along_street, float length, float turns) {
        const glm::vec3 right = glm::cross(along_street, glm::vec3{0, 1, 0});
        const int places = static_cast<int>((length - 24.0f) / kSpace) + 1;
        for (int i = 0; i < places; ++i)
            for (const float side : {-1.0f, 1.0f}) {
                const float at = 12.0f + kSpace * static_cast<float>(i);
                const float heading = side > 0.0f ? turns : turns + 0.5f;
                const float jitter = random.symmetric(0.6f);
                const glm::vec3 here = start + along_street * (at + jitter);
                if (random.chance(0.32f))
                    place(here + right * (side * kParked), heading);
                else if (random.chance(0.1f))
                    place(here + right * (side * kLane), heading);
            }
    };
    const float edge = 0.5f * kStreet;
    for (int j = 0; j < kBlocksZ; ++j)
        for (int i = 0; i <= kBlocksX; ++i)
            line({street_x(i), 0.0f, street_z(j) + edge}, {0, 0, 1}, kBlockZ, 0.0f);
    for (int j = 0; j <= kBlocksZ; ++j)
        for (int i = 0; i < kBlocksX; ++i)
            line({street_x(i) + edge, 0.0f, street_z(j)}, {1, 0, 0}, kBlockX, 0.25f);
}

} // namespace macula::scene::procedural
