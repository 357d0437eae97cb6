// A striped panel that can move before a striped wall which fills the view, frame by frame.
#pragma once

#include <vector>

#include "tests/support/small_scenes.hpp"

namespace macula::test {

// Upright stripes of two materials.
inline void add_stripes(scene::Mesh& mesh, glm::vec3 origin, glm::vec3 u, glm::vec3 v, int stripes,
                        std::uint32_t material) {
    const glm::vec3 part = u / static_cast<float>(stripes);
    for (int i = 0; i < stripes; ++i)
        add_quad(mesh, origin + part * static_cast<float>(i), part, v,
                 material + static_cast<std::uint32_t>(i % 2));
}

// Instance 0: the wall at z = -10, green and blue. Instance 1: the panel, red and orange, 2 x 2 at
// z = `depth`, its middle at x = y = 0. The eye is at the origin and looks along -z; without lights
// all is shaded by the ambient light alone.
inline scene::Scene panel_before_a_wall(float depth) {
    scene::Mesh wall, panel;
    add_stripes(wall, {-32, -32, -10}, {64, 0, 0}, {0, 64, 0}, 64, 0);
    add_stripes(panel, {-1, -1, depth}, {2, 0, 0}, {0, 2, 0}, 4, 2);
    scene::Scene scene = scene_of(icosphere(0), {{0, 0, 0}, {0, 0, -1}, 60.0f});
    scene.materials.resize(4, scene.materials[0]);
    const glm::vec3 colours[] = {
        {0.1f, 0.8f, 0.1f}, {0.1f, 0.6f, 0.9f}, {0.9f, 0.1f, 0.1f}, {0.9f, 0.3f, 0.1f}};
    for (std::size_t i = 0; i < 4; ++i)
        scene.materials[i].diffuse = colours[i];
    scene.meshes = {std::move(wall), std::move(panel)};
    scene.instances.push_back({1, {}, "panel"});
    return scene;
}

inline scene::Transform moved_by(glm::vec3 way) {
    scene::Transform t;
    for (int i = 0; i < 3; ++i)
        t.row[i].w = way[i];
    return t;
}

} // namespace macula::test
