#include "scenes/physics/box_tree.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <BulletCollision/BroadphaseCollision/btQuantizedBvh.h>

namespace macula::scene::physics {
namespace {

glm::vec3 to_glm(const btVector3& v) {
    return {v.x(), v.y(), v.z()};
}

} // namespace

BoxTree::BoxTree(btQuantizedBvh& bvh) {
    // Bullet's nodes stand in depth-first order, and an inner node knows how many follow below it.
    const QuantizedNodeArray& packed = bvh.getQuantizedNodeArray();
    std::vector<int> level(static_cast<std::size_t>(packed.size()), 0);
    nodes_.reserve(level.size());
    for (int i = 0; i < packed.size(); ++i) {
        const btQuantizedBvhNode& from = packed[i];
        BoxNode node{to_glm(bvh.unQuantize(from.m_quantizedAabbMin)),
                     to_glm(bvh.unQuantize(from.m_quantizedAabbMax)), 0};
        if (from.isLeafNode()) {
            node.second_or_triangle = -1 - from.getTriangleIndex();
        } else {
            const int first = i + 1;
            const int second =
                first + (packed[first].isLeafNode() ? 1 : packed[first].getEscapeIndex());
            node.second_or_triangle = second;
            level[static_cast<std::size_t>(first)] = level[static_cast<std::size_t>(second)] =
                level[static_cast<std::size_t>(i)] + 1;
        }
        nodes_.push_back(node);
    }
    height_ = level.empty() ? 0 : *std::max_element(level.begin(), level.end());
    if (height_ > kMaxHeight)
        throw std::runtime_error("physics: the tree of an obstacle has " + std::to_string(height_) +
                                 " levels; at most " + std::to_string(kMaxHeight) +
                                 " are possible");
}

} // namespace macula::scene::physics
