// What moves in a scene, as data: key frames of a tree of nodes, and bodies that physics moves.
// Time is in frames, as in scene::CameraPath. scenes/mover.hpp says where things are in a frame.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace macula::scene {

struct Scene;
struct Transform;

// From a node's space to its parent's: scaled, turned, then moved.
struct Pose {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; // w, x, y, z; unit length
    glm::vec3 scale{1.0f};
};

// As in glTF 2.0, appendix C. `cubic` has three values a key: the tangent that arrives, the value,
// and the tangent that leaves; tangents are for one frame.
enum class Interpolation : std::uint8_t { step, linear, cubic };

// Key frames of one part of a pose. Before the first and after the last key it stands still.
template <typename T>
struct Track {
    Interpolation interpolation = Interpolation::linear; // rotations: spherical
    std::vector<float> frames;                           // strictly increasing; empty: no keys
    std::vector<T> values;
};

inline constexpr std::uint32_t kNoNode = 0xffffffffu;

struct MotionNode {
    std::uint32_t parent = kNoNode; // index of a node before this one; kNoNode: the world
    Pose rest;                      // of the parts without keys
    Track<glm::vec3> translation;
    Track<glm::quat> rotation;
    Track<glm::vec3> scale;
};

// The instance's world_from_object is that of the node after `node_from_object`. Each instance at
// most once.
struct MovedInstance {
    std::uint32_t instance = 0;       // index into Scene::instances
    std::uint32_t node = 0;           // index into Motion::nodes
    glm::mat4 node_from_object{1.0f}; // affine
};

struct Motion {
    std::vector<MotionNode> nodes;
    std::vector<MovedInstance> instances;
    float period = 0.0f; // frames after which it begins again; 0: it plays once
};

// World from node of every node in a frame, which need not be whole. The motion must have passed
// validate().
void place_nodes(const Motion& motion, float frame, std::vector<glm::mat4>& world_from_node);
Transform transform_of(const glm::mat4& affine);
// Where the instance is when its nodes are there.
Transform placed(const MovedInstance& moved, const std::vector<glm::mat4>& world_from_node);
// Places the instances that key frames move as they are in `frame`.
void place_instances(Scene& scene, float frame);

// How finely the spheres meet the obstacles, by their eccentricity: the angle in degrees between
// the gaze and the nearest edge of the sphere, seen from the eye. docs/physics.md has the rule.
struct CollisionAcuity {
    float exact_degrees = 5.0f;       // up to there triangles are met, 0..180; 180: everywhere
    float levels_per_degree = 1.0f;   // levels of the obstacle's tree left out beyond, 0..100
    std::uint32_t coarsest_level = 7; // never less deep than this; 0: the box of all (the paper's)
};

// Spheres that fall on what stands still (Smith et al. 2014, section 3.3).
struct Physics {
    // Instances that move: their meshes are spheres of `radius` about the object space's origin.
    // They start from their transforms, whose scale is 1.
    std::vector<std::uint32_t> spheres;
    float radius = 0.1f;                   // world units, above 0
    std::vector<std::uint32_t> obstacles;  // instances that stand still, as triangle meshes
    glm::vec3 gravity{0.0f, -9.81f, 0.0f}; // world units / s^2
    float frame_rate = 60.0f;              // frames a second, 1..1000
    std::uint32_t seed = 0;                // of the spheres' first velocities
    float speed = 0.0f;                    // world units / s, of the first velocities; at least 0
    float restitution = 0.3f;              // of every contact, 0..1
    float friction = 0.5f;                 // of every contact, at least 0
    // A sphere farther than this from where it started starts again, once there is room; 0: none.
    float reach = 0.0f;
    CollisionAcuity acuity;
};

} // namespace macula::scene
