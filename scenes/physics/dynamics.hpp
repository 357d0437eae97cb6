// Bullet's side of a World: the simulation from its first step on.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "scenes/error.hpp"
#include "scenes/physics/obstacle.hpp"
#include "scenes/physics/world.hpp"

namespace macula::scene::physics {

class Dynamics {
  public:
    // Positions in world space; `obstacles` must outlive it.
    Dynamics(const Physics& physics, const Units& units, std::span<const Transform> starts,
             std::span<const std::unique_ptr<Obstacle>> obstacles, Contacts contacts);
    ~Dynamics();
    Dynamics(const Dynamics&) = delete;
    Dynamics& operator=(const Dynamics&) = delete;

    // `seconds` in `substeps` steps of equal length; then spheres out of reach start again.
    void step(float seconds, int substeps);

    glm::vec3 centre(std::size_t sphere) const;
    Transform transform(std::size_t sphere) const;
    void leave_out(std::size_t sphere, int levels) { bodies_[sphere]->setUserIndex(levels); }
    int left_out(std::size_t sphere) const { return bodies_[sphere]->getUserIndex(); }

  private:
    void add_obstacle(Obstacle& obstacle);
    void add_sphere(std::size_t sphere);
    void start(std::size_t sphere);
    bool has_room(std::size_t sphere) const;
    void start_again();

    const Physics physics_;
    const Units units_;
    std::vector<Transform> starts_;
    std::vector<std::uint32_t> times_started_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    btSphereShape shape_;
    std::vector<std::unique_ptr<btCollisionObject>> still_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

} // namespace macula::scene::physics
