#include "scenes/physics/sphere_contact.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>

#include "scenes/physics/obstacle.hpp"

namespace macula::scene::physics {
namespace {

btVector3 to_bullet(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

// What a sphere meets of one obstacle in one step.
class CoarseContacts {
  public:
    CoarseContacts(const Obstacle& obstacle, const glm::vec3& centre, int last_level, float reach,
                   btManifoldResult& result)
        : obstacle_(obstacle), centre_(centre), last_level_(last_level), reach_(reach),
          result_(result) {}

    void find() {
        const std::span<const BoxNode> nodes = obstacle_.tree().nodes();
        struct {
            std::int32_t node;
            int level;
        } stack[BoxTree::kMaxHeight + 2];
        int waiting = 0;
        stack[waiting++] = {0, 0};
        while (waiting > 0) {
            const auto [index, level] = stack[--waiting];
            const BoxNode& node = nodes[static_cast<std::size_t>(index)];
            if (answers(node, level))
                continue;
            stack[waiting++] = {node.second_or_triangle, level + 1};
            stack[waiting++] = {index + 1, level + 1};
        }
    }

  private:
    // False: its children must be asked.
    bool answers(const BoxNode& node, int level) {
        const glm::vec3 on_box = nearest_point(node, centre_);
        const glm::vec3 away = centre_ - on_box;
        const float squared = glm::dot(away, away);
        if (squared > reach_ * reach_)
            return true;
        if (node.leaf()) {
            meet(nearest_point(obstacle_.triangles()[static_cast<std::size_t>(node.triangle())],
                               centre_));
            return true;
        }
        constexpr float kNearest = kSimulatedRadius - kCoarseDepth;
        if (level < last_level_ || squared < kNearest * kNearest)
            return false;
        meet(on_box);
        return true;
    }

    void meet(const glm::vec3& point) {
        const glm::vec3 away = centre_ - point;
        const float distance = glm::length(away);
        if (distance > reach_ || !(distance > 0.0f))
            return;
        result_.addContactPoint(to_bullet(away / distance), to_bullet(point),
                                distance - kSimulatedRadius);
    }

    const Obstacle& obstacle_;
    glm::vec3 centre_;
    int last_level_;
    float reach_;
    btManifoldResult& result_;
};

class SphereContact final : public btCollisionAlgorithm {
  public:
    SphereContact(const btCollisionAlgorithmConstructionInfo& info,
                  const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                  bool swapped)
        : btCollisionAlgorithm(info), exact_(info, body0, body1, swapped), swapped_(swapped) {
        btManifoldArray manifolds;
        exact_.getAllContactManifolds(manifolds);
        manifold_ = manifolds[0];
    }

    void processCollision(const btCollisionObjectWrapper* body0,
                          const btCollisionObjectWrapper* body1, const btDispatcherInfo& info,
                          btManifoldResult* result) override {
        const btCollisionObject* sphere = (swapped_ ? body1 : body0)->getCollisionObject();
        const int left_out = sphere->getUserIndex();
        // Contacts with one level's surface mean nothing to another's.
        if (left_out != left_out_)
            exact_.clearCache();
        left_out_ = left_out;
        if (left_out == 0)
            exact_.processCollision(body0, body1, info, result);
        else
            meet_boxes(*sphere, *(swapped_ ? body0 : body1), *result);
    }

    btScalar calculateTimeOfImpact(btCollisionObject* body0, btCollisionObject* body1,
                                   const btDispatcherInfo& info,
                                   btManifoldResult* result) override {
        return exact_.calculateTimeOfImpact(body0, body1, info, result);
    }

    void getAllContactManifolds(btManifoldArray& manifolds) override {
        exact_.getAllContactManifolds(manifolds);
    }

  private:
    void meet_boxes(const btCollisionObject& sphere, const btCollisionObjectWrapper& mesh,
                    btManifoldResult& result) {
        const auto& obstacle =
            *static_cast<const Obstacle*>(mesh.getCollisionShape()->getUserPointer());
        result.setPersistentManifold(manifold_);
        result.setShapeIdentifiersA(-1, -1);
        result.setShapeIdentifiersB(-1, -1);
        const btVector3& at = sphere.getWorldTransform().getOrigin();
        const auto reach =
            static_cast<float>(kSimulatedRadius + manifold_->getContactBreakingThreshold());
        CoarseContacts(obstacle, glm::vec3(at.x(), at.y(), at.z()), obstacle.last_level(left_out_),
                       reach, result)
            .find();
        result.refreshContactPoints();
    }

    btConvexConcaveCollisionAlgorithm exact_;
    btPersistentManifold* manifold_; // of exact_, for both kinds of contacts
    bool swapped_;
    int left_out_ = 0;
};

struct Creator : btCollisionAlgorithmCreateFunc {
    explicit Creator(bool swapped) { m_swapped = swapped; }
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* body0,
                                                   const btCollisionObjectWrapper* body1) override {
        void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SphereContact));
        return new (memory) SphereContact(info, body0, body1, m_swapped);
    }
};

} // namespace

int sphere_contact_bytes() {
    return static_cast<int>(sizeof(SphereContact));
}

void use_sphere_contacts(btCollisionDispatcher& dispatcher) {
    static Creator plain(false), swapped(true);
    dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, TRIANGLE_MESH_SHAPE_PROXYTYPE,
                                           &plain);
    dispatcher.registerCollisionCreateFunc(TRIANGLE_MESH_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
                                           &swapped);
}

} // namespace macula::scene::physics
