#include "scenes/defaults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/occupancy.hpp"

namespace macula::scene {
namespace {

constexpr int kResolution = 112;
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

// Whether a scene is looked at from outside: most of what is first met from there faces outwards,
// and it is no closed box with a room in it.
bool is_object(const Occupancy& grid) {
    const Bounds& box = grid.bounds();
    const glm::vec3 centre = 0.5f * (box.lo + box.hi);
    const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
    float front = 0.0f, hits = 0.0f;
    for (const glm::vec3& from : sphere_directions(64)) {
        if (from.y < -0.2f) // nobody looks from below, where landscapes and bases are open
            continue;
        for (const glm::vec3& aside : sphere_directions(32)) {
            const GridHit hit = grid.cast(centre + from * (2.0f * radius) + aside * (0.6f * radius),
                                          -from, 6.0f * radius);
            hits += hit.hit ? 1.0f : 0.0f;
            front += !hit.hit ? 0.0f : hit.facing > 0.1f ? 1.0f : hit.facing < -0.1f ? 0.0f : 0.5f;
        }
    }
    return hits == 0.0f || front > 0.6f * hits;
}

Camera object_camera(const Bounds& box) {
    Camera camera;
    camera.name = "default";
    const glm::vec3 extent = box.hi - box.lo;
    const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
    camera.target = 0.5f * (box.lo + box.hi);
    camera.vertical_fov_degrees = kObjectFov;
    // Flat scenes (landscapes, cities) from higher up than tall ones.
    const bool flat = extent.y < 0.5f * std::max(extent.x, extent.z);
    const glm::vec3 from =
        glm::normalize(flat ? glm::vec3(0.75f, 0.6f, 1.0f) : glm::vec3(0.5f, 0.3f, 1.0f));
    const float half = 0.5f * kObjectFov * std::numbers::pi_v<float> / 180.0f;
    camera.eye = camera.target + from * (radius / std::sin(half) * (flat ? 0.75f : 0.95f));
    return camera;
}

// How much there is to see: the mean of what the rays of a view find, more for far and varied
// depths, less for empty space, for the backs of surfaces and for what is too near.
float view_score(const Occupancy& grid, const glm::vec3& eye, const glm::vec3& forward) {
    constexpr int kColumns = 12, kRows = 8;
    constexpr float kHalfHeight = 0.6f, kHalfWidth = 0.9f; // tangents
    const float diagonal = grid.bounds().diagonal();
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    float sum = 0.0f, depth_sum = 0.0f, depth_square = 0.0f;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) / kColumns * 2.0f - 1.0f;
            const float y = (static_cast<float>(row) + 0.5f) / kRows * 2.0f - 1.0f;
            const glm::vec3 direction =
                glm::normalize(forward + right * (x * kHalfWidth) + up * (y * kHalfHeight));
            const GridHit hit = grid.cast(eye, direction, diagonal);
            const float depth = std::log2(1.0f + hit.distance / (0.03f * diagonal));
            if (!hit.hit) {
                sum += 0.8f;
                continue;
            }
            sum += hit.facing < -0.3f ? -0.5f : hit.distance < 0.04f * diagonal ? -1.0f : depth;
            depth_sum += depth;
            depth_square += depth * depth;
        }
    constexpr float kRays = kColumns * kRows;
    const float variance = depth_square / kRays - depth_sum * depth_sum / (kRays * kRays);
    return sum / kRays + 0.5f * std::sqrt(std::max(0.0f, variance));
}

bool has_clearance(const Occupancy& grid, const glm::vec3& eye, float clearance) {
    static const std::vector<glm::vec3> kDirections = sphere_directions(26);
    if (grid.solid(eye))
        return false;
    return std::none_of(kDirections.begin(), kDirections.end(), [&](const glm::vec3& d) {
        return grid.cast(eye, d, clearance).hit &&
               grid.cast(eye, d, clearance).distance < clearance;
    });
}

Camera interior_camera(const Occupancy& grid) {
    constexpr int kSteps = 14, kYaws = 16;
    constexpr std::array kHeights = {0.12f, 0.2f, 0.3f, 0.45f};
    const Bounds& box = grid.bounds();
    const glm::vec3 extent = box.hi - box.lo;
    Camera best = object_camera(box);
    float best_score = -1e30f;
    for (const float height : kHeights)
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                // From a little outside, for rooms that are open at a side.
                const glm::vec3 at((static_cast<float>(i) + 0.5f) / kSteps * 1.4f - 0.2f, height,
                                   (static_cast<float>(j) + 0.5f) / kSteps * 1.4f - 0.2f);
                const glm::vec3 eye = box.lo + at * extent;
                if (!has_clearance(grid, eye, 2.5f * grid.cell_size()))
                    continue;
                for (int k = 0; k < kYaws; ++k) {
                    const float yaw =
                        2.0f * std::numbers::pi_v<float> * static_cast<float>(k) / kYaws;
                    const glm::vec3 forward =
                        glm::normalize(glm::vec3(std::cos(yaw), -0.04f, std::sin(yaw)));
                    const float score = view_score(grid, eye, forward);
                    if (score <= best_score)
                        continue;
                    best_score = score;
                    best.eye = eye;
                    best.target = eye + forward * (0.25f * box.diagonal());
                    best.vertical_fov_degrees = kInteriorFov;
                }
            }
    return best;
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
    light.position = below + glm::vec3(0.0f, 0.75f * height, 0.0f);
    light.radius = 0.01f * box.diagonal();
    return light;
}

} // namespace

Camera default_camera(const Scene& scene) {
    const Occupancy grid(scene, kResolution);
    return is_object(grid) ? object_camera(grid.bounds()) : interior_camera(grid);
}

std::vector<Light> default_lights(const Scene& scene, const Camera& camera) {
    const Bounds box = scene.bounds();
    const bool narrow = camera.vertical_fov_degrees < kInteriorFov;
    if (!contains(box, camera.eye) && narrow) {
        const float distance = glm::distance(camera.eye, camera.target);
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
        Light key;
        key.position = camera.eye + (0.8f * camera.up - 0.6f * right) * distance;
        key.radius = 0.1f * std::max(box.diagonal(), 1e-6f);
        return {key};
    }
    const Occupancy grid(scene, kResolution);
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const float free = grid.cast(camera.eye, forward, box.diagonal()).distance;
    Light key = ceiling_light(grid, camera, 0.25f * free);
    const float height = key.position.y - camera.eye.y;
    if (free < 3.0f * height)
        return {ceiling_light(grid, camera, 0.45f * free)};
    // A long hall: one light would leave its far end dark.
    Light second = ceiling_light(grid, camera, 0.7f * free);
    key.colour = second.colour = glm::vec3(0.65f);
    return {key, second};
}

} // namespace macula::scene
