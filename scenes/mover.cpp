#include "scenes/mover.hpp"

#include <set>

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
}

std::span<const Transform> Mover::at(std::uint32_t frame, const Observer& /*observer*/) {
    place_nodes(motion_, static_cast<float>(frame), world_from_node_);
    for (const MovedInstance& moved : motion_.instances)
        transforms_[moved.instance] = placed(moved, world_from_node_);
    return transforms_;
}

} // namespace macula::scene
