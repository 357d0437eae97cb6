#include "scenes/validate_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "scenes/error.hpp"
#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

constexpr float kMaxFrame = 1e9f;

bool finite(float x) {
    return std::isfinite(x) && std::fabs(x) < kMaxCoordinate;
}
bool finite(const glm::vec3& p) {
    return finite(p.x) && finite(p.y) && finite(p.z);
}
bool finite(const glm::quat& q) {
    return finite(q.x) && finite(q.y) && finite(q.z) && finite(q.w);
}

// What is known of a node in all frames: how far it moves its origin, and how it scales.
struct Range {
    double distance = 0.0, least = 1.0, most = 1.0;

    Range inside(const Range& parent) const {
        return {parent.distance + parent.most * distance, parent.least * least, parent.most * most};
    }
};

class NodeCheck {
  public:
    NodeCheck(MotionNode& node, std::string where) : node_(node), where_(std::move(where)) {}

    Range run() {
        check_keys(node_.translation, "translation");
        check_keys(node_.rotation, "rotation");
        check_keys(node_.scale, "scale");
        if (!finite(node_.rest.translation) || !finite(node_.rest.rotation) ||
            !finite(node_.rest.scale))
            fail("its pose at rest is not finite");
        bring_to_unit_length(node_.rest.rotation);
        const bool cubic = node_.rotation.interpolation == Interpolation::cubic;
        for (std::size_t i = cubic ? 1 : 0; i < node_.rotation.values.size(); i += cubic ? 3 : 1)
            bring_to_unit_length(node_.rotation.values[i]);
        Range range;
        range.distance = farthest();
        range.least = std::numeric_limits<double>::infinity();
        range.most = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            add_scale(axis, range);
        return range;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw SceneError(where_ + ": " + what);
    }

    template <typename T>
    void check_keys(const Track<T>& track, const char* part) const {
        const std::size_t values = track.interpolation == Interpolation::cubic ? 3 : 1;
        if (track.values.size() != values * track.frames.size())
            fail(std::string(part) + ": " + std::to_string(track.values.size()) + " values for " +
                 std::to_string(track.frames.size()) + " key frames");
        for (std::size_t i = 0; i < track.frames.size(); ++i) {
            if (!(std::fabs(track.frames[i]) <= kMaxFrame))
                fail(std::string(part) + ": key " + std::to_string(i) + " is at no finite frame");
            if (i > 0 && !(track.frames[i] > track.frames[i - 1]))
                fail(std::string(part) + ": key " + std::to_string(i) +
                     " is not after the one before");
        }
        for (const T& value : track.values)
            if (!finite(value))
                fail(std::string(part) + ": a value is not finite");
    }

    void bring_to_unit_length(glm::quat& q) const {
        const double length = glm::length(glm::dquat(q));
        if (!(length > 1e-6))
            fail("a rotation has no length");
        if (std::fabs(length - 1.0) > 1e-6)
            q = glm::quat(glm::dquat(q) / length);
    }

    // Calls visit(a, b, c, d) with the control points of the Bezier curve of each piece; with four
    // times the same of what stands still, and twice two of what is linear or steps.
    template <typename Visit>
    void for_each_piece(const Track<glm::vec3>& track, const glm::vec3& rest, int axis,
                        Visit&& visit) const {
        const auto value = [&](std::size_t i) { return double{track.values[i][axis]}; };
        if (track.frames.empty())
            return visit(double{rest[axis]}, double{rest[axis]}, double{rest[axis]},
                         double{rest[axis]});
        const bool cubic = track.interpolation == Interpolation::cubic;
        const auto key = [&](std::size_t i) { return value(cubic ? 3 * i + 1 : i); };
        if (track.frames.size() == 1)
            visit(key(0), key(0), key(0), key(0));
        for (std::size_t i = 0; i + 1 < track.frames.size(); ++i) {
            const double third = (double{track.frames[i + 1]} - track.frames[i]) / 3.0;
            if (cubic)
                visit(key(i), key(i) + third * value(3 * i + 2),
                      key(i + 1) - third * value(3 * i + 3), key(i + 1));
            else if (track.interpolation == Interpolation::linear)
                visit(key(i), key(i), key(i + 1), key(i + 1));
            else {
                visit(key(i), key(i), key(i), key(i));
                visit(key(i + 1), key(i + 1), key(i + 1), key(i + 1));
            }
        }
    }

    double farthest() const {
        double most = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            for_each_piece(
                node_.translation, node_.rest.translation, axis,
                [&](double a, double b, double c, double d) {
                    most = std::max({most, std::fabs(a), std::fabs(b), std::fabs(c), std::fabs(d)});
                });
        return most * std::sqrt(3.0);
    }

    // A scale must keep its sign. The control points bound a curve; where they disagree it is
    // halved a few times.
    void add_scale(int axis, Range& range) const {
        constexpr int kHalvings = 12;
        for_each_piece(node_.scale, node_.rest.scale, axis,
                       [&](double a, double b, double c, double d) {
                           add_piece({a, b, c, d}, kHalvings, range);
                       });
    }

    void add_piece(const std::array<double, 4>& p, int halvings, Range& range) const {
        const auto [lo, hi] = std::minmax_element(p.begin(), p.end());
        if (*lo > 0.0 || *hi < 0.0) {
            range.least = std::min({range.least, std::fabs(*lo), std::fabs(*hi)});
            range.most = std::max({range.most, std::fabs(*lo), std::fabs(*hi)});
            return;
        }
        if (p[0] * p[3] <= 0.0 || halvings == 0)
            fail("its scale becomes 0");
        const double ab = (p[0] + p[1]) / 2, bc = (p[1] + p[2]) / 2, cd = (p[2] + p[3]) / 2;
        const double abc = (ab + bc) / 2, bcd = (bc + cd) / 2, middle = (abc + bcd) / 2;
        add_piece({p[0], ab, abc, middle}, halvings - 1, range);
        add_piece({middle, bcd, cd, p[3]}, halvings - 1, range);
    }

    MotionNode& node_;
    std::string where_;
};

bool finite(const glm::mat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!finite(m[column][row]))
                return false;
    return true;
}

double size_of(const glm::mat4& affine) {
    const glm::dmat4 m(affine);
    double most = 0.0;
    for (int column = 0; column < 3; ++column)
        most = std::max(most, glm::length(glm::dvec3(m[column])));
    return most * std::sqrt(3.0);
}

double radius_of(const Mesh& mesh) {
    double most = 0.0;
    for (const glm::vec3& p : mesh.positions)
        most = std::max(most, glm::length(glm::dvec3(p)));
    return most;
}

class MotionCheck {
  public:
    explicit MotionCheck(Scene& scene) : scene_(scene), motion_(scene.motion) {}

    void run() {
        if (!std::isfinite(motion_.period) || motion_.period < 0.0f || motion_.period > kMaxFrame)
            throw SceneError(scene_.name + ": the period of its motion is no number of frames");
        for (std::size_t i = 0; i < motion_.nodes.size(); ++i) {
            const std::string where = scene_.name + ": moving node " + std::to_string(i);
            if (motion_.nodes[i].parent != kNoNode && motion_.nodes[i].parent >= i)
                throw SceneError(where + ": its parent " + std::to_string(motion_.nodes[i].parent) +
                                 " is no node before it");
            const Range local = NodeCheck(motion_.nodes[i], where).run();
            const std::uint32_t parent = motion_.nodes[i].parent;
            ranges_.push_back(parent == kNoNode ? local : local.inside(ranges_[parent]));
        }
        std::vector<bool> moved(scene_.instances.size());
        for (const MovedInstance& instance : motion_.instances)
            check(instance, moved);
        place_instances(scene_, 0.0f);
    }

  private:
    void check(const MovedInstance& moved, std::vector<bool>& seen) const {
        const std::string where =
            scene_.name + ": moving instance " + std::to_string(moved.instance);
        if (moved.instance >= scene_.instances.size())
            throw SceneError(where + ": there are " + std::to_string(scene_.instances.size()));
        if (moved.node >= motion_.nodes.size())
            throw SceneError(where + ": node " + std::to_string(moved.node) + " of " +
                             std::to_string(motion_.nodes.size()));
        if (seen[moved.instance])
            throw SceneError(where + ": it is moved twice");
        seen[moved.instance] = true;
        if (!finite(moved.node_from_object) ||
            !std::isnormal(glm::determinant(glm::mat3(moved.node_from_object))))
            throw SceneError(where + ": its transform is not finite or singular");
        check_reach(moved, where);
    }

    // No frame may take a triangle out of the space, or flatten it.
    void check_reach(const MovedInstance& moved, const std::string& where) const {
        const Mesh& mesh = scene_.meshes[scene_.instances[moved.instance].mesh];
        const glm::vec3 offset(moved.node_from_object[3]);
        const double radius =
            radius_of(mesh) * size_of(moved.node_from_object) + glm::length(offset);
        const auto [distance, least, most] = ranges_[moved.node];
        if (!(distance + most * radius < kMaxCoordinate))
            throw SceneError(where + ": it may move beyond the largest coordinate, 1e18");
        const double volume =
            std::fabs(glm::determinant(glm::dmat3(glm::mat3(moved.node_from_object))));
        if (!(least * least * least * volume >= double{std::numeric_limits<float>::min()}) ||
            !(most * most * most * volume <= double{std::numeric_limits<float>::max()}))
            throw SceneError(where + ": its scale becomes too small or too large");
    }

    Scene& scene_;
    Motion& motion_;
    std::vector<Range> ranges_; // of the nodes, in the world
};

// Whether the transform keeps all lengths.
bool is_rigid(const Transform& t) {
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k <= i; ++k) {
            const float dot = glm::dot(glm::vec3(t.row[i]), glm::vec3(t.row[k]));
            if (!(std::fabs(dot - (i == k ? 1.0f : 0.0f)) < 1e-3f))
                return false;
        }
    return true;
}

// Of physics: Bullet needs about a hundred bytes for each, and every instance has its own.
constexpr std::uint64_t kMostObstacleTriangles = std::uint64_t{1} << 24;

void check_spheres(const Scene& scene, const Physics& physics, std::vector<bool>& moved) {
    for (const std::uint32_t sphere : physics.spheres) {
        const std::string where = scene.name + ": sphere " + std::to_string(sphere) + " of physics";
        if (sphere >= scene.instances.size())
            throw SceneError(where + ": there are " + std::to_string(scene.instances.size()) +
                             " instances");
        if (moved[sphere])
            throw SceneError(where + ": it is moved twice");
        moved[sphere] = true;
        const Instance& instance = scene.instances[sphere];
        if (!is_rigid(instance.world_from_object))
            throw SceneError(where + ": its transform must have the scale 1");
        const double radius = radius_of(scene.meshes[instance.mesh]);
        if (!(std::fabs(radius - physics.radius) <= 0.01 * physics.radius))
            throw SceneError(where + ": its mesh is no sphere of radius " +
                             std::to_string(physics.radius) + " about its origin");
    }
}

void validate_physics(const Scene& scene, const Physics& physics) {
    const std::string where = scene.name + ": physics: ";
    if (!(physics.radius > 0.0f) || !finite(physics.radius))
        throw SceneError(where + "the radius must be above 0");
    if (!finite(physics.gravity))
        throw SceneError(where + "gravity is not finite");
    if (!(physics.frame_rate >= 1.0f && physics.frame_rate <= 1000.0f))
        throw SceneError(where + "the frame rate must lie between 1 and 1000");
    const CollisionAcuity& acuity = physics.acuity;
    if (!(physics.speed >= 0.0f) || !finite(physics.speed) || !(physics.reach >= 0.0f) ||
        !finite(physics.reach) || !(physics.friction >= 0.0f) || !finite(physics.friction))
        throw SceneError(where + "speed, reach and friction must be at least 0");
    if (!(physics.restitution >= 0.0f && physics.restitution <= 1.0f))
        throw SceneError(where + "the restitution must lie between 0 and 1");
    if (!(acuity.exact_degrees >= 0.0f && acuity.exact_degrees <= 180.0f) ||
        !(acuity.levels_per_degree >= 0.0f && acuity.levels_per_degree <= 100.0f))
        throw SceneError(where + "the acuity of collisions is out of range");
    std::vector<bool> moved(scene.instances.size());
    for (const MovedInstance& instance : scene.motion.instances)
        moved[instance.instance] = true;
    check_spheres(scene, physics, moved);
    std::uint64_t triangles = 0;
    for (const std::uint32_t obstacle : physics.obstacles) {
        if (obstacle >= scene.instances.size())
            throw SceneError(where + "obstacle " + std::to_string(obstacle) + " of " +
                             std::to_string(scene.instances.size()) + " instances");
        if (moved[obstacle])
            throw SceneError(where + "obstacle " + std::to_string(obstacle) + " moves");
        triangles += scene.meshes[scene.instances[obstacle].mesh].triangles.size();
    }
    if (triangles > kMostObstacleTriangles)
        throw SceneError(where + "the obstacles have " + std::to_string(triangles) +
                         " triangles, each instance's counted; at most " +
                         std::to_string(kMostObstacleTriangles) + " are possible");
}

} // namespace

void validate_motion(Scene& scene) {
    MotionCheck(scene).run();
    if (scene.physics)
        validate_physics(scene, *scene.physics);
}

void renumber_moving(Scene& scene, const std::vector<std::uint32_t>& renumbered) {
    const auto renumber = [&](std::uint32_t& instance) {
        instance = renumbered[instance];
        return instance == kNoTexture;
    };
    std::erase_if(scene.motion.instances, [&](MovedInstance& m) { return renumber(m.instance); });
    if (!scene.physics)
        return;
    std::erase_if(scene.physics->spheres, renumber);
    std::erase_if(scene.physics->obstacles, renumber);
}

} // namespace macula::scene
