#include "bench/judge.hpp"

#include <algorithm>
#include <cmath>

namespace macula::bench {
namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

glm::dvec3 to_world(const scene::Transform& transform, const glm::vec3& object) {
    glm::dvec3 world;
    for (int r = 0; r < 3; ++r) {
        const glm::dvec4 row(transform.row[r]);
        world[r] = glm::dot(glm::dvec3(row), glm::dvec3(object)) + row.w;
    }
    return world;
}

// Distance between the segment a..b and the line through `origin` along `direction`.
double distance_to_line(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& origin,
                        const glm::dvec3& direction) {
    // Seen along the line, it is a point and the segment a segment of a plane.
    const glm::dvec3 d = glm::normalize(direction);
    const auto flat = [&](const glm::dvec3& p) {
        return (p - origin) - d * glm::dot(p - origin, d);
    };
    const glm::dvec3 fa = flat(a), fb = flat(b), along = fb - fa;
    const double length2 = glm::dot(along, along);
    const double s = length2 > 0.0 ? std::clamp(-glm::dot(fa, along) / length2, 0.0, 1.0) : 0.0;
    return glm::length(fa + along * s);
}

bool close(double a, double b, double slack) {
    return std::abs(a - b) <= kRelativeT * std::max(std::abs(a), std::abs(b)) + slack;
}

} // namespace

// A ray and a triangle in double precision.
struct Judge::Meeting {
    double t = 0.0;        // with the triangle's plane
    double b[3] = {};      // barycentric weights there
    double edge = 0.0;     // distance from the ray's line to the nearest edge, world units
    double slack = 0.0;    // what rounding may move the ray or the triangle by, world units
    double t_slack = 0.0;  // what that may move t by
    double b_slack = 0.0;  // and the barycentric weights
    bool parallel = false; // no t: the ray lies along the plane
    bool grazes() const { return edge <= slack; }
    // The ray does hit the triangle, at this t.
    bool confirms(double hit_t) const {
        const bool inside = b[0] >= 0.0 && b[1] >= 0.0 && b[2] >= 0.0;
        return !parallel && (inside || grazes()) && close(t, hit_t, t_slack);
    }
};

Judge::Judge(const scene::Scene& scene) : scene_(scene), masks_(frame::make_mask_bitmaps(scene)) {}

Judge::Meeting Judge::meet(const TestRay& ray, const Surface& surface) const {
    const scene::Mesh& mesh = scene_.meshes[surface.mesh];
    const scene::Transform& transform = scene_.instances[surface.instance].world_from_object;
    glm::dvec3 p[3];
    Meeting m;
    m.slack = largest(ray.origin);
    for (int i = 0; i < 3; ++i) {
        p[i] = to_world(transform, mesh.positions[mesh.triangles[surface.triangle][i]]);
        m.slack = std::max(m.slack, largest(p[i]));
    }
    m.slack *= kRounding;
    m.edge = HUGE_VAL;
    for (int i = 0; i < 3; ++i)
        m.edge =
            std::min(m.edge, distance_to_line(p[i], p[(i + 1) % 3], ray.origin, ray.direction));
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double area2 = glm::length(normal), along = glm::dot(ray.direction, normal);
    m.parallel = along == 0.0;
    if (m.parallel)
        return m;
    m.t = glm::dot(p[0] - ray.origin, normal) / along;
    const glm::dvec3 q = ray.origin + ray.direction * m.t;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 part = glm::cross(p[(i + 1) % 3] - q, p[(i + 2) % 3] - q);
        m.b[i] = glm::dot(part, normal) / (area2 * area2);
    }
    m.t_slack = m.slack * area2 / std::abs(along);
    const double side =
        std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    m.b_slack = m.t_slack * glm::length(ray.direction) * side / area2;
    return m;
}

bool Judge::near_texel_border(const Surface& surface, const Meeting& meeting) const {
    const scene::Mesh& mesh = scene_.meshes[surface.mesh];
    const std::uint32_t mask = masks_.of_material[mesh.triangle_material[surface.triangle]];
    if (mask == frame::kNoMask)
        return false;
    const shared::MaskTriangle corners = masked_triangle(masks_, mesh, surface.triangle);
    const shared::MaskTexture& texture = masks_.textures[mask];
    const double sizes[2] = {double(texture.width), double(texture.height)};
    for (int axis = 0; axis < 2; ++axis) {
        double x = 0.0, greatest = 1.0, span = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double value = corners.uv[i][axis];
            x += meeting.b[i] * value;
            greatest = std::max(greatest, std::abs(value));
            span = std::max(span, std::abs(value - corners.uv[0][axis]));
        }
        const double slack = kRounding * greatest + meeting.b_slack * 2.0 * span;
        const double texels = x * sizes[axis];
        if (std::abs(texels - std::round(texels)) <= slack * sizes[axis])
            return true;
    }
    return false;
}

Verdict Judge::closest(const TestRay& ray, const TestHit& ours, const TestHit& theirs) const {
    if (!ours.surface && !theirs.surface)
        return Verdict::same;
    const bool both = ours.surface && theirs.surface;
    if (both && *ours.surface == *theirs.surface) {
        if (close(ours.t, theirs.t, 0.0))
            return Verdict::same;
        const Meeting m = meet(ray, *ours.surface);
        const bool explained = m.parallel || close(ours.t, theirs.t, m.t_slack);
        return explained ? Verdict::rounding : Verdict::mismatch;
    }
    if (both) {
        const Meeting a = meet(ray, *ours.surface), b = meet(ray, *theirs.surface);
        if (a.confirms(ours.t) && b.confirms(theirs.t)) {
            if (close(ours.t, theirs.t, 0.0))
                return Verdict::tie;
            if (close(ours.t, theirs.t, a.t_slack + b.t_slack))
                return Verdict::rounding;
        }
    }
    // One of the two found a triangle that the other passed by.
    const bool ours_disputed = ours.surface && (!both || ours.t < theirs.t);
    const Surface& disputed = ours_disputed ? *ours.surface : *theirs.surface;
    const Meeting m = meet(ray, disputed);
    if (!m.parallel && !close(m.t, ours_disputed ? ours.t : theirs.t, m.t_slack))
        return Verdict::mismatch;
    const bool at_an_end = std::abs(m.t - ray.t_min) <= m.t_slack ||
                           std::abs(m.t - ray.t_max) <= m.t_slack + kRounding * ray.t_max;
    if (m.parallel || m.grazes() || at_an_end || near_texel_border(disputed, m))
        return Verdict::rounding;
    return Verdict::mismatch;
}

} // namespace macula::bench
