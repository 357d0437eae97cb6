#include "scenes/head/pose.hpp"

#include <cmath>

namespace macula::scene {

glm::dmat3 world_from_head(const Camera& head) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(head.target) - glm::dvec3(head.eye));
    glm::dvec3 right = glm::cross(forward, glm::normalize(glm::dvec3(head.up)));
    if (!(glm::dot(right, right) >= 1e-12))
        right = glm::cross(forward,
                           std::fabs(forward.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), -forward};
}

Camera eye_camera(const Camera& head, const EyeView& eye, double units_per_metre) {
    if (eye.offset == glm::dvec3(0.0) && eye.head_from_eye == glm::dmat3(1.0))
        return head;
    const glm::dmat3 axes = world_from_head(head), turned = axes * eye.head_from_eye;
    const double distance = glm::length(glm::dvec3(head.target) - glm::dvec3(head.eye));
    const glm::dvec3 position = glm::dvec3(head.eye) + axes * eye.offset * units_per_metre;
    Camera camera = head;
    camera.eye = glm::vec3(position);
    camera.target = glm::vec3(position - turned[2] * distance);
    camera.up = glm::vec3(turned[1]);
    return camera;
}

} // namespace macula::scene
