// What the benchmark traces: scenes with the view and the light that go with them, and the rays of
// each class.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/embree_rays.hpp"
#include "bench/rays.hpp"

namespace macula::bench {

struct Case {
    std::string name; // the built-in scene's, or of the file's folder or stem
    scene::Scene scene;
    shared::Camera camera; // of a square image
    glm::vec3 light;       // position of the point light of shadow rays
    scene::Bounds bounds;
};

// Where named scenes are looked for: the given folders, those of MACULA_SCENE_PATH (separated by
// ':'), and ../shared/scenes.
std::vector<std::filesystem::path> scene_folders(std::span<const std::string> given);

// The scenes of a benchmark without --scene: atrium and voxel_city, and of sponza_crytek and
// minecraft_overworld those that are found.
std::vector<std::string> default_scenes(std::span<const std::filesystem::path> folders);

// A built-in scene, a file, or the name of a known scene in the folders. Views of known scenes are
// fixed; others take their first camera and light. Throws scene::SceneError.
Case open_case(const std::string& name, std::span<const std::filesystem::path> folders);

struct RayOptions {
    std::uint32_t size = 1024; // primary rays are size x size; the other classes scale with it
    std::uint64_t seed = 1;
};

// `points`: where the primary rays hit, used by shadow, ambient occlusion and diffuse rays.
RaySet make_rays(kernel::RayClass ray_class, const Case& scene_case,
                 std::span<const SurfacePoint> points, const RayOptions& options);

// Where the rays that hit something, by Embree's closest hits, did so.
std::vector<SurfacePoint> surface_points(const Case& scene_case, const RaySet& rays,
                                         const EmbreeRays& traced);

} // namespace macula::bench
