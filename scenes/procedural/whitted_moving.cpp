// The Whitted scene in motion: both spheres revolve about each other, and around them a ball
// rolls, another bounces, a globe with a moon circles and a box tumbles.
#include <array>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/patterns.hpp"
#include "scenes/procedural/rails.hpp"
#include "scenes/procedural/random.hpp"
#include "scenes/procedural/whitted.hpp"

namespace macula::scene::procedural {
namespace {

constexpr float kPeriod = 500.0f; // frames: the camera's path has two of them
constexpr glm::vec3 kMiddle{0.6f, 0.0f, -0.1f};
constexpr glm::vec3 kX{1, 0, 0}, kY{0, 1, 0};
constexpr glm::ivec2 kBallCells{96, 48};
constexpr float kOneRepeat = 1e3f; // of a texture around a ball; its v ends at 0.5

struct Latitude {
    float turn, height; // around; 0 at the south pole, 1 at the north pole
};

Latitude latitude_of(glm::vec2 uv) {
    return {uv.x, uv.y < 0.5f ? 2.0f * uv.y : 2.0f - 2.0f * uv.y};
}

Texel beach_ball(glm::vec2 uv) {
    static constexpr std::array<std::uint32_t, 3> kColours{0xd8342c, 0xf2f0e6, 0x1f5fb8};
    const Latitude at = latitude_of(uv);
    if (at.height < 0.07f || at.height > 0.93f)
        return {rgb(0xf2c230)};
    return {rgb(kColours[static_cast<std::size_t>(at.turn * 6.0f) % kColours.size()])};
}

Texel checks(glm::vec2 uv) {
    const Latitude at = latitude_of(uv);
    const bool odd = (static_cast<int>(at.turn * 12.0f) + static_cast<int>(at.height * 6.0f)) % 2;
    return {odd ? rgb(0x174a3c) : rgb(0xe9e4d2)};
}

Texel globe(glm::vec2 uv, std::uint32_t seed) {
    const Latitude at = latitude_of(uv);
    const glm::vec2 tilt = sin_cos_turns(0.5f * at.height - 0.25f), turn = sin_cos_turns(at.turn);
    const glm::vec3 p{tilt.x * turn.x, tilt.y, tilt.x * turn.y};
    const float ground = fractal_noise(1.9f * p, 5, seed);
    const float pole = tilt.y < 0.0f ? -tilt.y : tilt.y;
    if (pole + 0.1f * ground > 0.93f)
        return {rgb(0xf0f4f6)};
    if (ground < 0.03f)
        return {rgb(ground < -0.12f ? 0x143f7a : 0x2467a8)};
    const glm::vec3 land = ground > 0.26f ? rgb(0x9a7b4f) : rgb(0x4f8a3c);
    return {land * (0.9f + 0.5f * ground)};
}

std::uint32_t add_ball(Scene& scene, const std::string& name, glm::vec3 centre, float radius,
                       const Painter& painter) {
    const std::uint32_t texture = add_texture(scene, name, {512, 512}, painter);
    const std::uint32_t material =
        add_material(scene, name, Maps{texture, kNoTexture}, 0.25f, 60.0f);
    MeshBuilder b(name);
    sphere(b, centre, radius, kBallCells, {material, kOneRepeat});
    scene.meshes.push_back(b.take());
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t add_sphere(Scene& scene, const std::string& name, float radius,
                         std::uint32_t material) {
    MeshBuilder b(name);
    sphere(b, glm::vec3{0.0f}, radius, kSphereCells, {material, 1.0f});
    scene.meshes.push_back(b.take());
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

// From their places in Whitted's picture, once round.
void add_spheres(Scene& scene, Rails& rails) {
    const std::uint32_t carousel = rails.node(kNoNode, {kMiddle});
    rails.spin(carousel, kY, 1);
    const std::uint32_t glass = rails.node(carousel, {kGlassCentre - kMiddle});
    rails.bob(glass, 3, 0.35f);
    rails.carry(glass, add_sphere(scene, "glass sphere", kGlassRadius, add_glass(scene)),
                "glass sphere");
    const std::uint32_t mirror = rails.node(carousel, {kMirrorCentre - kMiddle});
    rails.carry(mirror, add_sphere(scene, "mirror sphere", kMirrorRadius, add_mirror(scene)),
                "mirror sphere");
}

// Without slipping: on a circle of seven radii, seven turns a round.
void add_rolling_ball(Scene& scene, Rails& rails) {
    constexpr float kRadius = 0.5f;
    constexpr int kRadii = 7, kRounds = 2;
    const std::uint32_t orbit = rails.node(kNoNode, {kMiddle, turned_about(kY, 0.1f)});
    rails.spin(orbit, kY, -kRounds);
    const std::uint32_t ball = rails.node(orbit, {{kRadii * kRadius, kRadius, 0.0f}});
    rails.spin(ball, kX, kRounds * kRadii);
    rails.carry(ball, add_ball(scene, "rolling ball", {}, kRadius, beach_ball), "rolling ball");
}

void add_bouncing_ball(Scene& scene, Rails& rails) {
    constexpr float kRadius = 0.45f;
    const std::uint32_t ball = rails.node(kNoNode, {{-2.9f, 0.0f, -3.4f}});
    rails.bounce(ball, 10, 1.7f, 0.3f);
    const std::uint32_t turning = rails.node(ball);
    rails.spin(turning, kY, 4);
    // It stands on its node, and is squashed against the board.
    rails.carry(turning, add_ball(scene, "bouncing ball", {0, kRadius, 0}, kRadius, checks),
                "bouncing ball");
}

void add_globe_and_moon(Scene& scene, Rails& rails, std::uint32_t seed) {
    const std::uint32_t plane = rails.node(
        kNoNode, {kMiddle + glm::vec3{0, 3.1f, 0}, turned_about({0.8f, 0.0f, 0.6f}, 0.03f)});
    const std::uint32_t orbit = rails.node(plane, {{}, turned_about(kY, 0.3f)});
    rails.spin(orbit, kY, 3);
    const std::uint32_t place = rails.node(orbit, {{3.1f, 0.0f, 0.0f}});
    const std::uint32_t globe_node = rails.node(place);
    rails.spin(globe_node, {0.28f, 0.96f, 0.0f}, 8);
    rails.carry(globe_node,
                add_ball(scene, "globe", {}, 0.42f, [=](glm::vec2 uv) { return globe(uv, seed); }),
                "globe");
    const std::uint32_t moon_orbit = rails.node(place);
    rails.spin(moon_orbit, {0.0f, 0.8f, 0.6f}, -11);
    const std::uint32_t moon = rails.node(moon_orbit, {{0.65f, 0.0f, 0.0f}});
    const auto stone = [=](glm::vec2 uv) { return limestone(uv, rgb(0xc9c4b8), seed); };
    rails.carry(moon, add_ball(scene, "moon", {}, 0.13f, stone), "moon");
}

void add_box(Scene& scene, Rails& rails, std::uint32_t seed) {
    constexpr float kHalf = 0.42f;
    const std::uint32_t texture = add_texture(scene, "box", {256, 256}, [=](glm::vec2 uv) {
        return damask(uv, rgb(0x7d1330), rgb(0xe0b040), seed);
    });
    const std::uint32_t material = add_material(scene, "box", Maps{texture, kNoTexture}, 0.1f);
    MeshBuilder b("box");
    block(b, glm::vec3{-kHalf}, glm::vec3{kHalf}, 0.04f, {material, 2.0f * kHalf});
    scene.meshes.push_back(b.take());
    const std::uint32_t node =
        rails.node(kNoNode, {kMiddle + glm::vec3{0, 3.55f, 0}, turned_about(kX, 0.08f)});
    rails.spin(node, {0.48f, 0.6f, 0.64f}, 5);
    rails.carry(node, static_cast<std::uint32_t>(scene.meshes.size() - 1), "box");
}

} // namespace

Scene make_whitted_moving(const SceneParams& params) {
    const std::uint32_t seed = fold_seed(params.seed);
    Scene scene;
    MeshBuilder b("board");
    add_board(b, scene);
    scene.meshes.push_back(b.take());
    scene.instances.push_back({0, {}, "board"});
    Rails rails(scene, kPeriod);
    add_spheres(scene, rails);
    add_rolling_ball(scene, rails);
    add_bouncing_ball(scene, rails);
    add_globe_and_moon(scene, rails, seed);
    add_box(scene, rails, seed);
    add_whitted_view(scene);
    scene.path = round_tour(1.75f, {9.0f, 3.1f}, {0.6f, 1.0f});
    return scene;
}

} // namespace macula::scene::procedural
