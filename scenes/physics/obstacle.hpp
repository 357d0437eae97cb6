// What stands still: an instance's triangles, as Bullet's mesh shape with its tree, and that tree's
// boxes for coarse contacts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include "scenes/physics/box_tree.hpp"
#include "scenes/physics/distance.hpp"
#include "scenes/physics/units.hpp"
#include "scenes/scene.hpp"

namespace macula::scene::physics {

class Obstacle {
  public:
    // Throws SceneError where the instance's mesh has no triangles or more than Bullet's tree can
    // number (2^21).
    Obstacle(const Scene& scene, std::uint32_t instance, const Units& units);
    Obstacle(const Obstacle&) = delete;
    Obstacle& operator=(const Obstacle&) = delete;

    btBvhTriangleMeshShape& shape() { return *shape_; } // its user pointer is this obstacle
    const BoxTree& tree() const { return *tree_; }
    std::span<const Triangle> triangles() const { return triangles_; } // simulation space

    // Of coarse contacts: the level below which a sphere that leaves out `left_out` levels (> 0)
    // does not look.
    int last_level(int left_out) const;
    void set_coarsest_level(int level) { coarsest_level_ = level; }

  private:
    std::vector<Triangle> triangles_;
    std::vector<int> indices_;
    std::unique_ptr<btTriangleIndexVertexArray> arrays_;
    std::unique_ptr<btBvhTriangleMeshShape> shape_;
    std::unique_ptr<BoxTree> tree_;
    int coarsest_level_ = 0;
};

} // namespace macula::scene::physics
