#include "scenes/physics/dynamics.hpp"

#include "scenes/physics/sphere_contact.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::physics {
namespace {

// A rolling sphere slows down as in air and on felt.
constexpr float kLinearDamping = 0.02f, kAngularDamping = 0.1f;
constexpr float kRoom = 1.05f; // of a sphere's diameter, about its start

btDefaultCollisionConstructionInfo with_our_contacts() {
    btDefaultCollisionConstructionInfo info;
    info.m_customCollisionAlgorithmMaxElementSize = sphere_contact_bytes();
    return info;
}

btVector3 to_bullet(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

glm::vec3 to_glm(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

glm::vec3 position_of(const Transform& t) {
    return {t.row[0].w, t.row[1].w, t.row[2].w};
}

btMatrix3x3 rotation_of(const Transform& t) {
    const auto& [x, y, z] = t.row;
    return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
}

} // namespace

Dynamics::Dynamics(const Physics& physics, const Units& units, std::span<const Transform> starts,
                   std::span<const std::unique_ptr<Obstacle>> obstacles, Contacts contacts)
    : physics_(physics), units_(units), starts_(starts.begin(), starts.end()),
      times_started_(starts.size(), 0), configuration_(with_our_contacts()),
      dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
      shape_(kSimulatedRadius) {
    if (contacts == Contacts::perceptual)
        use_sphere_contacts(dispatcher_);
    world_.setGravity(to_bullet(physics.gravity * units.scale));
    for (const std::unique_ptr<Obstacle>& obstacle : obstacles)
        add_obstacle(*obstacle);
    for (std::size_t i = 0; i < starts_.size(); ++i)
        add_sphere(i);
}

Dynamics::~Dynamics() {
    for (const auto& body : bodies_)
        world_.removeRigidBody(body.get());
    for (const auto& object : still_)
        world_.removeCollisionObject(object.get());
}

void Dynamics::add_obstacle(Obstacle& obstacle) {
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(&obstacle.shape());
    object->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
    object->setRestitution(1.0f); // contacts multiply both sides'
    object->setFriction(1.0f);
    world_.addCollisionObject(object.get(), btBroadphaseProxy::StaticFilter,
                              btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
    still_.push_back(std::move(object));
}

void Dynamics::add_sphere(std::size_t sphere) {
    constexpr float kMass = 1.0f;
    btVector3 inertia;
    shape_.calculateLocalInertia(kMass, inertia);
    auto body = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(kMass, nullptr, &shape_, inertia));
    body->setRestitution(physics_.restitution);
    body->setFriction(physics_.friction);
    body->setDamping(kLinearDamping, kAngularDamping);
    body->setFlags(0); // no gyroscopic torque, which spheres do not have
    body->setUserIndex(0);
    // A sphere that sleeps would stay on a coarse surface after the gaze has come.
    body->setActivationState(DISABLE_DEACTIVATION);
    bodies_.push_back(std::move(body));
    start(sphere);
    world_.addRigidBody(bodies_.back().get());
}

// Each start has a direction of its own, drawn from the seed.
void Dynamics::start(std::size_t sphere) {
    procedural::Random random((std::uint64_t{times_started_[sphere]} << 32) | physics_.seed,
                              static_cast<std::uint32_t>(sphere));
    ++times_started_[sphere];
    glm::vec3 way{};
    for (int axis = 0; axis < 3; ++axis)
        way[axis] = random.symmetric(1.0f);
    const float length = glm::length(way);
    const float speed = random.range(0.0f, physics_.speed * units_.scale);
    btRigidBody& body = *bodies_[sphere];
    const Transform& at = starts_[sphere];
    const btTransform transform(rotation_of(at), to_bullet(units_.from_world(position_of(at))));
    body.setWorldTransform(transform);
    body.setInterpolationWorldTransform(transform);
    body.setLinearVelocity(to_bullet(length > 0.0f ? way * (speed / length) : way));
    body.setAngularVelocity(btVector3(0, 0, 0));
}

bool Dynamics::has_room(std::size_t sphere) const {
    const glm::vec3 at = units_.from_world(position_of(starts_[sphere]));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const glm::vec3 other = to_glm(bodies_[i]->getWorldTransform().getOrigin());
        if (i != sphere && glm::length(other - at) < 2.0f * kSimulatedRadius * kRoom)
            return false;
    }
    return true;
}

void Dynamics::start_again() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (!(glm::length(centre(i) - position_of(starts_[i])) > physics_.reach) || !has_room(i))
            continue;
        start(i);
        broadphase_.getOverlappingPairCache()->cleanProxyFromPairs(
            bodies_[i]->getBroadphaseHandle(), &dispatcher_);
    }
}

void Dynamics::step(float seconds, int substeps) {
    // Steps of Bullet's own making would depend on how its clock rounds.
    for (int i = 0; i < substeps; ++i)
        world_.stepSimulation(seconds / static_cast<float>(substeps), 0);
    if (physics_.reach > 0.0f)
        start_again();
}

glm::vec3 Dynamics::centre(std::size_t sphere) const {
    return units_.to_world(to_glm(bodies_[sphere]->getWorldTransform().getOrigin()));
}

Transform Dynamics::transform(std::size_t sphere) const {
    const btMatrix3x3& basis = bodies_[sphere]->getWorldTransform().getBasis();
    const glm::vec3 at = centre(sphere);
    Transform t;
    for (int row = 0; row < 3; ++row) {
        const glm::vec3 turned = to_glm(basis[row]);
        t.row[row] = glm::vec4(turned, at[row]);
    }
    return t;
}

} // namespace macula::scene::physics
