#include "scenes/triangulate.hpp"

#include <cmath>
#include <numeric>

namespace macula::scene {
namespace {

glm::vec3 scaled_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(b - a, c - a);
}

void split_quad(std::span<const glm::vec3> p, std::vector<glm::uvec3>& triangles) {
    const bool keeps_02 =
        glm::dot(scaled_normal(p[0], p[1], p[2]), scaled_normal(p[0], p[2], p[3])) > 0.0f;
    const bool keeps_13 =
        glm::dot(scaled_normal(p[0], p[1], p[3]), scaled_normal(p[1], p[2], p[3])) > 0.0f;
    const glm::vec3 d02 = p[2] - p[0], d13 = p[3] - p[1];
    const bool shorter_02 = glm::dot(d02, d02) < glm::dot(d13, d13);
    if (keeps_02 == keeps_13 ? shorter_02 : keeps_02) {
        triangles.emplace_back(0u, 1u, 2u);
        triangles.emplace_back(0u, 2u, 3u);
    } else {
        triangles.emplace_back(0u, 1u, 3u);
        triangles.emplace_back(1u, 2u, 3u);
    }
}

// The polygon seen along the largest axis of its normal, counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        normal += glm::dvec3((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x),
                             (a.x - b.x) * (a.y + b.y));
    }
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool flip = normal[axis] < 0.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& p : corners)
        flat.emplace_back(flip ? -p[u] : p[u], p[v]);
    return flat;
}

double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<unsigned>& ring,
            std::size_t at) {
    const std::size_t n = ring.size();
    const glm::dvec2 &a = flat[ring[(at + n - 1) % n]], &b = flat[ring[at]],
                     &c = flat[ring[(at + 1) % n]];
    if (!(area(a, b, c) > 0.0))
        return false;
    for (std::size_t k = 2; k + 1 < n; ++k) {
        const glm::dvec2& p = flat[ring[(at + k) % n]];
        if (p == a || p == b || p == c)
            continue;
        if (area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0)
            return false;
    }
    return true;
}

// At least 4 corners.
void clip_ears(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles) {
    const std::vector<glm::dvec2> flat = project(corners);
    std::vector<unsigned> ring(corners.size());
    std::iota(ring.begin(), ring.end(), 0u);
    for (std::size_t n = ring.size(); n > 3; --n) {
        std::size_t ear = 0;
        while (ear < n && !is_ear(flat, ring, ear))
            ++ear;
        if (ear == n)
            ear = 1; // degenerate or self-intersecting: any cut keeps the count and goes on
        triangles.emplace_back(ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.emplace_back(ring[0], ring[1], ring[2]);
}

} // namespace

void triangulate(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles) {
    const auto n = static_cast<unsigned>(corners.size());
    if (n == 4)
        split_quad(corners, triangles);
    else if (n > 4 && n <= kMaxEarClipping)
        clip_ears(corners, triangles);
    else
        for (unsigned i = 2; i < n; ++i)
            triangles.emplace_back(0u, i - 1, i);
}

} // namespace macula::scene
