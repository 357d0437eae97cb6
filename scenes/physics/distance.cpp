#include "scenes/physics/distance.hpp"

#include <algorithm>

namespace macula::scene::physics {

glm::vec3 nearest_point(const Triangle& triangle, const glm::vec3& p) {
    const auto& [a, b, c] = triangle;
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f)
        return a;
    const glm::vec3 bp = p - b;
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3)
        return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f)
        return d1 - d3 > 0.0f ? a + ab * (d1 / (d1 - d3)) : a;
    const glm::vec3 cp = p - c;
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6)
        return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f)
        return d2 - d6 > 0.0f ? a + ac * (d2 / (d2 - d6)) : a;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
        const float along = (d4 - d3) + (d5 - d6);
        return along > 0.0f ? b + (c - b) * ((d4 - d3) / along) : b;
    }
    const float area = va + vb + vc;
    if (!(area > 0.0f)) // rounding, of a triangle without area
        return a;
    const float inverse = 1.0f / area;
    return a + ab * (vb * inverse) + ac * (vc * inverse);
}

glm::vec3 nearest_point(const BoxNode& box, const glm::vec3& p) {
    return glm::clamp(p, box.lo, box.hi);
}

float distance(const BoxTree& tree, std::span<const Triangle> triangles, const glm::vec3& p,
               float most) {
    const std::span<const BoxNode> nodes = tree.nodes();
    std::int32_t stack[BoxTree::kMaxHeight + 2];
    int waiting = 0;
    if (!nodes.empty())
        stack[waiting++] = 0;
    while (waiting > 0) {
        const std::int32_t index = stack[--waiting];
        const BoxNode& node = nodes[static_cast<std::size_t>(index)];
        if (glm::length(nearest_point(node, p) - p) >= most)
            continue;
        if (node.leaf()) {
            const Triangle& t = triangles[static_cast<std::size_t>(node.triangle())];
            most = std::min(most, glm::length(nearest_point(t, p) - p));
            continue;
        }
        stack[waiting++] = node.second_or_triangle;
        stack[waiting++] = index + 1;
    }
    return most;
}

} // namespace macula::scene::physics
