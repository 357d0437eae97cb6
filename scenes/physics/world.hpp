// The bodies of a scene, moved by the rigid-body dynamics of Bullet in fixed steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "scenes/mover.hpp"
#include "scenes/scene.hpp"

namespace macula::scene::physics {

// `plain` is Bullet as it comes: what `perceptual` is measured against, and must equal to the bit
// where every sphere is exact.
enum class Contacts : std::uint8_t { plain, perceptual };

class World {
  public:
    // The scene must have passed validate() and have physics; it may be destroyed afterwards.
    // Throws SceneError where an obstacle has too many triangles, or where the spheres may become
    // so fast that more than kMostSubsteps steps a frame would be needed.
    explicit World(const Scene& scene, Contacts contacts = Contacts::perceptual);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    // On to the next frame, as `observer` sees it.
    void step(const Observer& observer);
    // Back to frame 0. What follows repeats to the bit.
    void restart();

    std::uint32_t frame() const;
    std::size_t spheres() const;
    // World from object; without a step the transform of the instance.
    Transform transform(std::size_t sphere) const;
    // Levels that the sphere left out in the last step; 0: exact.
    int levels_left_out(std::size_t sphere) const;

    // How far the sphere reaches behind the obstacles' true surface, in world units; at least 0.
    float penetration(std::size_t sphere) const;
    // What penetration() never exceeds, in world units: how far a sphere moves in one step at the
    // most, and how deep coarse contacts may be.
    float penetration_bound() const;
    // Steps of equal length that a frame takes: so many that no sphere moves farther than a quarter
    // of its radius in one.
    int substeps() const;

    static constexpr int kMostSubsteps = 256;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace macula::scene::physics
