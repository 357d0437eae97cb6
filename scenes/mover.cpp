#include "scenes/mover.hpp"

#include <set>

#include "scenes/physics/world.hpp"

namespace macula::scene {

std::vector<std::uint32_t> moving_instances(const Scene& scene) {
    std::set<std::uint32_t> moving;
    for (const MovedInstance& moved : scene.motion.instances)
        moving.insert(moved.instance);
    if (scene.physics)
        moving.insert(scene.physics->spheres.begin(), scene.physics->spheres.end());
    return {moving.begin(), moving.end()};
}

Mover::Mover(const Scene& scene) : moves_(!moving_instances(scene).empty()), motion_(scene.motion) {
    for (const Instance& instance : scene.instances)
        transforms_.push_back(instance.world_from_object);
    if (!scene.physics)
        return;
    spheres_ = scene.physics->spheres;
    world_ = std::make_unique<physics::World>(scene);
}

Mover::~Mover() = default;

std::span<const Transform> Mover::at(std::uint32_t frame, const Observer& observer) {
    place_nodes(motion_, static_cast<float>(frame), world_from_node_);
    for (const MovedInstance& moved : motion_.instances)
        transforms_[moved.instance] = placed(moved, world_from_node_);
    if (world_)
        place_spheres(frame, observer);
    return transforms_;
}

void Mover::place_spheres(std::uint32_t frame, const Observer& observer) {
    if (frame < world_->frame())
        world_->restart();
    while (world_->frame() < frame)
        world_->step(observer);
    for (std::size_t i = 0; i < spheres_.size(); ++i)
        transforms_[spheres_[i]] = world_->transform(i);
}

} // namespace macula::scene
