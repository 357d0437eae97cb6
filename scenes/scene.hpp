// The scene model: what every loader and every procedural scene produces, and all that the engine
// knows of a scene. Plain data in host memory; world space is right-handed, +y up, in the units of
// the file (Scene::metres_per_unit says how long one is).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/motion.hpp"

namespace macula::scene {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

// One level of a mip chain: width * height texels, row-major, first row at v = 0 (top row of the
// file is v = 1 for OBJ and v = 0 for glTF: loaders flip so that this holds), 4 bytes RGBA each.
struct MipLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

struct Texture {
    std::string name;
    std::vector<MipLevel> levels; // [0] is the finest; complete down to 1 x 1
    bool srgb = true;             // colour channels are sRGB-encoded (alpha never is)
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool has_alpha = false; // some texel of level 0 has alpha < 255
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

inline constexpr std::uint32_t kNoTexture = 0xffffffffu;

// Phong (Weier et al. 2016, section 3.1) with what the Whitted methods add. Colours: linear RGB.
struct Material {
    std::string name;
    glm::vec3 diffuse{0.8f};
    glm::vec3 specular{0.0f};
    float shininess = 32.0f; // Phong exponent, > 0
    glm::vec3 emission{0.0f};
    float opacity = 1.0f; // 0..1, used by AlphaMode::blend
    float index_of_refraction = 1.5f;
    glm::vec3 reflectivity{0.0f}; // weight of a mirror ray
    glm::vec3 transmission{0.0f}; // weight of a refracted ray
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f; // AlphaMode::mask: a texel is solid when alpha >= cutoff
    std::uint32_t diffuse_texture = kNoTexture; // RGB; A is the mask unless alpha_texture is set
    std::uint32_t alpha_texture = kNoTexture;   // R channel
    std::uint32_t specular_texture = kNoTexture;
    // Tangent space: x along increasing u, y along increasing v, encoded as 0.5 * n + 0.5. Bump
    // maps are converted, and glTF's maps, whose y is -v, are turned around.
    std::uint32_t normal_texture = kNoTexture;
    std::uint32_t emission_texture = kNoTexture;
};

// Indexed triangles in object space. positions, normals, uvs have equal length, except that
// normals and uvs may be empty (geometric normals; uv = 0).
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // unit length
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;            // vertex indices, each < positions.size()
    std::vector<std::uint32_t> triangle_material; // one for each triangle
};

// Row-major 3 x 4 affine transform, world from object.
struct Transform {
    glm::vec4 row[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    bool is_identity() const;
    glm::vec3 apply(const glm::vec3& object) const; // a point
    bool operator==(const Transform&) const = default;
};

// A placed mesh. Loaders flatten meshes that are used once into world space (identity transform),
// and keep instances for meshes used more than once or that move.
struct Instance {
    std::uint32_t mesh = 0;
    Transform world_from_object;
    std::string name;
};

enum class LightKind : std::uint8_t { point, directional, spherical, rectangle };

// `--lights point` renders every area light as a point light of equal power at its centre;
// `--lights area` renders a point light as a sphere of its radius where that is > 0;
// `--lights soft` does so, too, and renders a directional light as wide as its angle.
struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 position{0.0f};               // centre
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; // directional: the way light travels, unit length
    glm::vec3 colour{1.0f};                 // point/spherical: intensity (W/sr); directional:
                                            // irradiance; rectangle: intensity along its normal
    float radius = 0.0f;                    // spherical, and point when rendered as an area
    float angle = 0.27f;                    // directional: angular radius in degrees, the sun's
    glm::vec3 edge_u{0.0f}, edge_v{0.0f};   // rectangle: full edges; emits along cross(u, v)
    float attenuation_distance = 0.0f;      // 0: none (constant, as the paper's Phong); else the
                                            // distance at which inverse-square gives `colour`
};

// A camera looks from `eye` to `target`. FOV as tangents, as in shared/camera.h.
struct Camera {
    std::string name;
    glm::vec3 eye{0.0f, 0.0f, 1.0f};
    glm::vec3 target{0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vertical_fov_degrees = 60.0f; // used when no display gives tangents
};

// Key frames of a fly-through; time in frames, Catmull-Rom between keys.
struct CameraKey {
    float frame = 0.0f;
    glm::vec3 eye{0.0f}, target{0.0f};
};

struct CameraPath {
    std::vector<CameraKey> keys; // strictly increasing frames; empty: the first camera stands still
    std::uint32_t frames = 0;    // length; the benchmark's paths have 1000
};

struct Bounds {
    glm::vec3 lo{0.0f}, hi{0.0f};
    float diagonal() const { return glm::length(hi - lo); }
};

struct Scene {
    std::string name;
    float metres_per_unit = 1.0f;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Material> materials; // never empty after validate()
    std::vector<Texture> textures;
    std::vector<Light> lights;   // never empty after validate(): a headlight-like default is added
    std::vector<Camera> cameras; // never empty after validate(): one that sees the bounds is added
    CameraPath path;
    Motion motion;                         // of instances; empty: nothing moves by key frames
    std::optional<Physics> physics;        // moves instances, too, but not those of `motion`
    glm::vec3 ambient{0.1f};               // ambient radiance
    glm::vec3 background{0.0f};            // radiance of rays that miss
    float ambient_occlusion_radius = 0.0f; // 0: 15 % of the bounds' diagonal
    std::optional<std::string> display;    // preferred display: a name or a file
    std::optional<std::string> gaze;       // preferred gaze, as docs/gaze.md has it
    std::vector<std::string> warnings;     // counted, human-readable, for `macula scene`

    std::uint64_t triangle_count() const; // over instances
    Bounds bounds() const;                // world space, over the triangles of all instances
};

} // namespace macula::scene
