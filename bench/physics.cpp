#include "bench/physics.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "host/metric/statistics.hpp"
#include "scenes/physics/world.hpp"

namespace macula::bench {
namespace {

using scene::Observer;
using scene::physics::Contacts;
using scene::physics::World;

std::vector<Observer> gazes_of(const scene::Scene& scene, const PhysicsOptions& options) {
    const scene::Camera& camera = scene.cameras.front();
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    // The middles of the grid's cells.
    const auto along = [](int i, int count, float half) {
        return half * (2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 1.0f);
    };
    std::vector<Observer> gazes;
    for (int row = 0; row < options.rows; ++row)
        for (int column = 0; column < options.columns; ++column)
            gazes.push_back(
                {camera.eye,
                 glm::normalize(forward +
                                right * along(column, options.columns, options.half_width) +
                                up * along(row, options.rows, options.half_height))});
    return gazes;
}

Observer looking_away(const scene::Scene& scene) {
    const scene::Camera& camera = scene.cameras.front();
    return {camera.eye, glm::normalize(camera.eye - camera.target)};
}

// From frame 0 on; milliseconds a frame, of the steps alone.
double run(World& world, const Observer& observer, std::uint32_t frames) {
    using Clock = std::chrono::steady_clock;
    world.restart();
    const Clock::time_point begin = Clock::now();
    for (std::uint32_t frame = 0; frame < frames; ++frame)
        world.step(observer);
    const std::chrono::duration<double, std::milli> spent = Clock::now() - begin;
    return spent.count() / std::max(frames, 1u);
}

float deepest(World& world, const Observer& observer, std::uint32_t frames) {
    float most = 0.0f;
    world.restart();
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        world.step(observer);
        for (std::size_t i = 0; i < world.spheres(); ++i)
            most = std::max(most, world.penetration(i));
    }
    return most;
}

} // namespace

PhysicsResult measure_physics(const scene::Scene& scene, const PhysicsOptions& options) {
    World exact(scene, Contacts::plain), perceptual(scene);
    const std::vector<Observer> gazes = gazes_of(scene, options);
    const Observer away = looking_away(scene);
    std::vector<double> plain, coarse, seen;
    for (int i = 0; i < std::max(options.runs, 1); ++i) {
        plain.push_back(run(exact, away, options.frames));
        coarse.push_back(run(perceptual, away, options.frames));
        double sum = 0.0;
        for (const Observer& gaze : gazes)
            sum += run(perceptual, gaze, options.frames);
        seen.push_back(sum / static_cast<double>(gazes.size()));
    }
    PhysicsResult result;
    result.frames = options.frames;
    result.gazes = static_cast<int>(gazes.size());
    result.ms_exact = metric::median(plain);
    result.ms_perceptual = metric::median(seen);
    result.ms_coarse = metric::median(coarse);
    result.speedup = result.ms_exact / result.ms_perceptual;
    result.speedup_coarse = result.ms_exact / result.ms_coarse;

    const float radius = scene.physics->radius;
    result.bound = perceptual.penetration_bound() / radius;
    result.penetration_exact = deepest(exact, away, options.frames) / radius;
    float most = deepest(perceptual, away, options.frames);
    for (const Observer& gaze : gazes)
        most = std::max(most, deepest(perceptual, gaze, options.frames));
    result.penetration_perceptual = most / radius;
    return result;
}

} // namespace macula::bench
