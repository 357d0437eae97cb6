#include "scenes/physics/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/physics/acuity.hpp"
#include "scenes/physics/dynamics.hpp"
#include "scenes/physics/sphere_contact.hpp"

namespace macula::scene::physics {
namespace {

constexpr float kFarthestStep = 0.25f; // of the radius, in one step

// The spheres' space is centred on the obstacles, where most of them are.
Units units_of(const Scene& scene) {
    glm::vec3 lo(INFINITY), hi(-INFINITY);
    for (const std::uint32_t index : scene.physics->obstacles) {
        const Instance& instance = scene.instances[index];
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions) {
            const glm::vec3 at = instance.world_from_object.apply(p);
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
    }
    Units units;
    units.scale = kSimulatedRadius / scene.physics->radius;
    if (lo.x <= hi.x)
        units.origin = 0.5f * (lo + hi);
    return units;
}

glm::vec3 start_of(const Scene& scene, std::uint32_t instance) {
    return scene.instances[instance].world_from_object.apply(glm::vec3(0.0f));
}

// World units / s: of a sphere that falls from the highest start to the lowest obstacle.
float greatest_speed(const Scene& scene) {
    const Physics& physics = *scene.physics;
    const float strength = glm::length(physics.gravity);
    if (!(strength > 0.0f))
        return physics.speed;
    const glm::vec3 up = physics.gravity / -strength;
    float highest = -INFINITY, lowest = INFINITY;
    for (const std::uint32_t sphere : physics.spheres)
        highest = std::max(highest, glm::dot(start_of(scene, sphere), up));
    for (const std::uint32_t index : physics.obstacles) {
        const Instance& instance = scene.instances[index];
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions)
            lowest = std::min(lowest, glm::dot(instance.world_from_object.apply(p), up));
    }
    const float height = std::max(highest - lowest, 0.0f);
    const bool falls = std::isfinite(height);
    return std::sqrt(physics.speed * physics.speed + (falls ? 2.0f * strength * height : 0.0f));
}

int substeps_of(const Scene& scene, float greatest) {
    const Physics& physics = *scene.physics;
    const float needed = greatest / physics.frame_rate / (kFarthestStep * physics.radius);
    if (!(needed <= World::kMostSubsteps))
        throw SceneError(scene.name + ": physics: spheres of radius " +
                         std::to_string(physics.radius) + " become as fast as " +
                         std::to_string(greatest) + " a second; at " +
                         std::to_string(physics.frame_rate) +
                         " frames a second this is too fast to keep them out of the obstacles "
                         "(weaker gravity, larger spheres or more frames a second help)");
    return std::max(1, static_cast<int>(std::ceil(needed)));
}

} // namespace

struct World::Parts {
    Parts(const Scene& scene, Contacts contacts_)
        : contacts(contacts_), physics(*scene.physics), units(units_of(scene)),
          greatest(greatest_speed(scene)), substeps(substeps_of(scene, greatest)) {
        for (const std::uint32_t instance : physics.obstacles) {
            obstacles.push_back(std::make_unique<Obstacle>(scene, instance, units));
            obstacles.back()->set_coarsest_level(static_cast<int>(physics.acuity.coarsest_level));
        }
        for (const std::uint32_t sphere : physics.spheres)
            starts.push_back(scene.instances[sphere].world_from_object);
    }

    Contacts contacts;
    Physics physics;
    Units units;
    float greatest;
    int substeps;
    std::vector<std::unique_ptr<Obstacle>> obstacles;
    std::vector<Transform> starts;
    std::unique_ptr<Dynamics> dynamics;
    std::uint32_t frame = 0;
};

World::World(const Scene& scene, Contacts contacts)
    : parts_(std::make_unique<Parts>(scene, contacts)) {
    restart();
}

World::~World() = default;

void World::restart() {
    Parts& p = *parts_;
    p.frame = 0;
    p.dynamics.reset(); // the old one goes before the new one comes
    p.dynamics = std::make_unique<Dynamics>(p.physics, p.units, p.starts, p.obstacles, p.contacts);
}

void World::step(const Observer& observer) {
    Parts& p = *parts_;
    if (p.contacts == Contacts::perceptual)
        for (std::size_t i = 0; i < spheres(); ++i) {
            const float angle = eccentricity(observer, p.dynamics->centre(i), p.physics.radius);
            p.dynamics->leave_out(i, physics::levels_left_out(p.physics.acuity, angle));
        }
    p.dynamics->step(1.0f / p.physics.frame_rate, p.substeps);
    ++p.frame;
}

std::uint32_t World::frame() const {
    return parts_->frame;
}

std::size_t World::spheres() const {
    return parts_->starts.size();
}

Transform World::transform(std::size_t sphere) const {
    return parts_->frame == 0 ? parts_->starts[sphere] : parts_->dynamics->transform(sphere);
}

int World::levels_left_out(std::size_t sphere) const {
    return parts_->dynamics->left_out(sphere);
}

float World::penetration(std::size_t sphere) const {
    const Parts& p = *parts_;
    const glm::vec3 centre = p.units.from_world(p.dynamics->centre(sphere));
    float nearest = kSimulatedRadius;
    for (const std::unique_ptr<Obstacle>& obstacle : p.obstacles)
        nearest = distance(obstacle->tree(), obstacle->triangles(), centre, nearest);
    return (kSimulatedRadius - nearest) / p.units.scale;
}

float World::penetration_bound() const {
    const Parts& p = *parts_;
    const float step = p.greatest / p.physics.frame_rate / static_cast<float>(p.substeps);
    return step + kCoarseDepth / p.units.scale;
}

int World::substeps() const {
    return parts_->substeps;
}

} // namespace macula::scene::physics
