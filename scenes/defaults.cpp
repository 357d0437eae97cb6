#include "scenes/defaults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/occupancy.hpp"

namespace macula::scene {
namespace {

constexpr int kResolution = 96;
// Of the diagonal: in closed spaces the usual 15 % would darken every surface.
constexpr float kInteriorOcclusion = 0.06f;
constexpr float kObjectFov = 45.0f, kInteriorFov = 75.0f; // degrees, vertical

// `count` unit directions spread evenly over the sphere (a Fibonacci lattice).
std::vector<glm::vec3> sphere_directions(int count) {
    std::vector<glm::vec3> directions;
    const float golden = std::numbers::pi_v<float> * (3.0f - std::sqrt(5.0f));
    for (int i = 0; i < count; ++i) {
        const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
        const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
        const float angle = golden * static_cast<float>(i);
        directions.emplace_back(r * std::cos(angle), y, r * std::sin(angle));
    }
    return directions;
}

struct FreePoint {
    glm::vec3 position;
    bool enclosed; // surrounded by front faces, as one is inside a room
};

// Points on a lattice in the bounds that keep some distance from every surface.
std::vector<FreePoint> free_points(const Occupancy& grid) {
    constexpr int kSteps = 14, kDirections = 48;
    constexpr std::array kHeights = {0.12f, 0.2f, 0.3f, 0.45f, 0.6f};
    constexpr float kEnclosed = 0.55f; // of the directions
    static const std::vector<glm::vec3> directions = sphere_directions(kDirections);
    const Bounds& box = grid.bounds();
    const float clearance = 2.5f * grid.cell_size();
    std::vector<FreePoint> points;
    for (const float height : kHeights)
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const glm::vec3 at((static_cast<float>(i) + 0.5f) / kSteps, height,
                                   (static_cast<float>(j) + 0.5f) / kSteps);
                const glm::vec3 position = box.lo + at * (box.hi - box.lo);
                if (grid.solid(position))
                    continue;
                int fronts = 0;
                bool clear = true;
                for (const glm::vec3& direction : directions) {
                    const GridHit hit = grid.cast(position, direction, box.diagonal());
                    clear = clear && !(hit.hit && hit.distance < clearance);
                    fronts += hit.hit && hit.facing > 0.1f;
                }
                if (clear)
                    points.push_back(
                        {position, static_cast<float>(fronts) > kEnclosed * kDirections});
            }
    return points;
}

// Whether a scene is a room or a hall, to be looked at from inside. In those a good part of the
// free space within the bounds is enclosed; around objects, landscapes and streets it is open.
bool is_interior(const std::vector<FreePoint>& points) {
    const auto enclosed =
        std::count_if(points.begin(), points.end(), [](const FreePoint& p) { return p.enclosed; });
    return static_cast<std::size_t>(enclosed) * 4 >= points.size() && enclosed > 0;
}

// From the front, a little to the right and above, as near as the whole bounds stay in the picture.
Camera object_camera(const Bounds& box) {
    constexpr float kAspect = 1.2f;
    Camera camera;
    camera.name = "default";
    camera.target = 0.5f * (box.lo + box.hi);
    camera.vertical_fov_degrees = kObjectFov;
    const glm::vec3 half = 0.5f * (box.hi - box.lo);
    // Flat scenes (landscapes, cities) from higher up than tall ones.
    const bool flat = half.y < 0.5f * std::max(half.x, half.z);
    const glm::vec3 back =
        glm::normalize(flat ? glm::vec3(0.75f, 0.6f, 1.0f) : glm::vec3(0.5f, 0.3f, 1.0f));
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
    const glm::vec3 up = glm::cross(back, right);
    const float tangent = std::tan(0.5f * kObjectFov * std::numbers::pi_v<float> / 180.0f);
    const float margin = flat ? 0.75f : 1.08f; // flat scenes leave their bounds' corners empty
    float distance = 1e-6f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 offset =
            half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float needed =
            std::max(std::fabs(glm::dot(offset, up)), std::fabs(glm::dot(offset, right)) / kAspect);
        distance = std::max(distance, margin * needed / tangent + glm::dot(offset, back));
    }
    camera.eye = camera.target + back * distance;
    return camera;
}

// How much there is to see: the mean over the rays of a view, more for far depths, less for empty
// space, for the backs of surfaces and for what is too near; and more for a varied picture, where
// neighbouring rays often end at quite different depths.
template <int kColumns, int kRows>
float view_score(const Occupancy& grid, const glm::vec3& eye, const glm::vec3& forward) {
    constexpr float kHalfHeight = 0.6f, kHalfWidth = 0.9f; // tangents
    constexpr float kJump = 0.6f;                          // octaves
    const float diagonal = grid.bounds().diagonal();
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    float sum = 0.0f;
    int jumps = 0;
    std::array<float, kColumns> above{};
    for (int row = 0; row < kRows; ++row) {
        float before = 0.0f;
        for (int column = 0; column < kColumns; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) / kColumns * 2.0f - 1.0f;
            const float y = (static_cast<float>(row) + 0.5f) / kRows * 2.0f - 1.0f;
            const glm::vec3 direction =
                glm::normalize(forward + right * (x * kHalfWidth) + up * (y * kHalfHeight));
            const GridHit hit = grid.cast(eye, direction, diagonal);
            const float depth = std::log2(1.0f + hit.distance / (0.03f * diagonal));
            sum += !hit.hit                          ? 0.8f
                   : hit.facing < -0.3f              ? -0.5f
                   : hit.distance < 0.04f * diagonal ? -1.0f
                                                     : depth;
            jumps += column > 0 && std::fabs(depth - before) > kJump;
            jumps += row > 0 && std::fabs(depth - above[static_cast<std::size_t>(column)]) > kJump;
            before = above[static_cast<std::size_t>(column)] = depth;
        }
    }
    constexpr float kRays = kColumns * kRows;
    return sum / kRays + 3.0f * static_cast<float>(jumps) / (2.0f * kRays);
}

struct View {
    glm::vec3 eye;
    float yaw, score;
};

glm::vec3 direction_of(float yaw) {
    constexpr float kSlope = -0.04f; // slightly down
    return glm::normalize(glm::vec3(std::cos(yaw), kSlope, std::sin(yaw)));
}

// Judges all views with few rays, then the best of them, and those beside them, with more.
Camera interior_camera(const Occupancy& grid, const std::vector<FreePoint>& points) {
    constexpr int kYaws = 8;
    constexpr std::size_t kKept = 32;
    constexpr float kStep = 2.0f * std::numbers::pi_v<float> / kYaws;
    std::vector<View> views;
    for (const FreePoint& point : points)
        for (int k = 0; point.enclosed && k < kYaws; ++k) {
            const float yaw = kStep * static_cast<float>(k);
            views.push_back(
                {point.position, yaw, view_score<6, 4>(grid, point.position, direction_of(yaw))});
        }
    const auto better = [](const View& a, const View& b) { return a.score > b.score; };
    std::stable_sort(views.begin(), views.end(), better);
    views.resize(std::min(views.size(), kKept));
    View best{views.front().eye, views.front().yaw, -1e30f};
    for (const View& view : views)
        for (const float turn : {0.0f, -0.5f * kStep, 0.5f * kStep}) {
            const float yaw = view.yaw + turn;
            const float score = view_score<12, 8>(grid, view.eye, direction_of(yaw));
            if (score > best.score)
                best = {view.eye, yaw, score};
        }
    Camera camera;
    camera.name = "default";
    camera.vertical_fov_degrees = kInteriorFov;
    camera.eye = best.eye;
    camera.target = best.eye + direction_of(best.yaw) * (0.25f * grid.bounds().diagonal());
    return camera;
}

bool contains(const Bounds& box, const glm::vec3& p) {
    return glm::all(glm::greaterThanEqual(p, box.lo)) && glm::all(glm::lessThanEqual(p, box.hi));
}

// Under the ceiling, `along` world units ahead of an interior camera, nearer when something is in
// the way.
Light ceiling_light(const Occupancy& grid, const Camera& camera, float along) {
    const Bounds& box = grid.bounds();
    glm::vec3 forward = camera.target - camera.eye;
    forward.y = 0.0f;
    forward = glm::length(forward) > 0.0f ? glm::normalize(forward) : glm::vec3(1, 0, 0);
    const float free = grid.cast(camera.eye, forward, box.diagonal()).distance;
    const glm::vec3 below = camera.eye + forward * std::min(along, 0.85f * free);
    const float roof = std::max(box.hi.y - below.y, 4.0f * grid.cell_size());
    const float height = grid.cast(below, glm::vec3(0, 1, 0), roof).distance;
    Light light;
    light.colour = glm::vec3(0.8f);
    light.position = below + glm::vec3(0.0f, 0.75f * height, 0.0f);
    light.radius = 0.01f * box.diagonal();
    return light;
}

std::vector<Light> default_lights(const Occupancy& grid, const Camera& camera) {
    const Bounds& box = grid.bounds();
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    if (!contains(box, camera.eye)) {
        const float distance = glm::distance(camera.eye, 0.5f * (box.lo + box.hi));
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
        Light key;
        key.colour = glm::vec3(0.9f);
        key.position = camera.eye + (0.8f * glm::cross(right, forward) - 0.6f * right) * distance;
        key.radius = 0.1f * std::max(box.diagonal(), 1e-6f);
        return {key};
    }
    const float free = grid.cast(camera.eye, forward, box.diagonal()).distance;
    Light key = ceiling_light(grid, camera, 0.25f * free);
    const float height = key.position.y - camera.eye.y;
    if (free < 3.0f * height)
        return {ceiling_light(grid, camera, 0.45f * free)};
    // A long hall: one light would leave its far end dark.
    Light second = ceiling_light(grid, camera, 0.7f * free);
    key.colour = second.colour = glm::vec3(0.5f);
    return {key, second};
}

// Files give emission without an exposure. Lamps that would leave the scene dark, at a quarter of
// its diagonal, are made brighter; their colours and ratios stay.
void brighten(std::vector<Light>& lights, const Bounds& box) {
    constexpr float kLeast = 0.6f; // irradiance, in units that a white surface reflects as 1
    const float reach = std::max(0.25f * box.diagonal(), 1e-6f);
    float total = 0.0f;
    for (const Light& light : lights)
        total += std::max({light.colour.r, light.colour.g, light.colour.b}) / (reach * reach);
    for (Light& light : lights)
        if (total > 0.0f && total < kLeast)
            light.colour *= kLeast / total;
}

} // namespace

void add_default_view(Scene& scene) {
    if (scene.lights.empty()) {
        scene.lights = lights_of_emissive_quads(scene);
        brighten(scene.lights, scene.bounds());
    }
    if (!scene.lights.empty() && !scene.cameras.empty())
        return;
    const Occupancy grid(scene, kResolution);
    if (scene.cameras.empty()) {
        const std::vector<FreePoint> points = free_points(grid);
        const bool interior = is_interior(points);
        scene.cameras.push_back(interior ? interior_camera(grid, points)
                                         : object_camera(grid.bounds()));
        if (interior && scene.ambient_occlusion_radius == 0.0f)
            scene.ambient_occlusion_radius = kInteriorOcclusion * grid.bounds().diagonal();
    }
    if (scene.lights.empty())
        scene.lights = default_lights(grid, scene.cameras.front());
}

} // namespace macula::scene
