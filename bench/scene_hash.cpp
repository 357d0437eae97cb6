#include "bench/scene_hash.hpp"

#include <memory>
#include <type_traits>

#include <fmt/format.h>
#include <xxhash.h>

namespace macula::bench {
namespace {

class Digest {
  public:
    Digest() { XXH3_128bits_reset(state_.get()); }

    // Of types without padding: numbers, enumerations, vectors of them.
    template <class... T>
    void add(const T&... values) {
        (one(values), ...);
    }

    template <class T>
    void list(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::uint64_t{values.size()});
        XXH3_128bits_update(state_.get(), values.data(), values.size() * sizeof(T));
    }

    std::string text() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
        return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
    }

  private:
    template <class T>
    void one(const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
        XXH3_128bits_update(state_.get(), &value, sizeof value);
    }

    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_{XXH3_createState(),
                                                                    XXH3_freeState};
};

void add(Digest& digest, const scene::Mesh& mesh) {
    digest.list(mesh.positions);
    digest.list(mesh.normals);
    digest.list(mesh.uvs);
    digest.list(mesh.triangles);
    digest.list(mesh.triangle_material);
}

void add(Digest& digest, const scene::Material& m) {
    digest.add(m.diffuse, m.specular, m.shininess, m.emission, m.opacity, m.index_of_refraction,
               m.reflectivity, m.transmission, m.alpha_mode, m.alpha_cutoff, m.diffuse_texture,
               m.alpha_texture, m.specular_texture, m.normal_texture, m.emission_texture);
}

void add(Digest& digest, const scene::Texture& texture) {
    digest.add(texture.srgb, texture.wrap_u, texture.wrap_v, texture.has_alpha);
    for (const scene::MipLevel& level : texture.levels) {
        digest.add(level.width, level.height);
        digest.list(level.rgba);
    }
}

void add(Digest& digest, const scene::Light& light) {
    digest.add(light.kind, light.position, light.direction, light.colour, light.radius,
               light.edge_u, light.edge_v, light.attenuation_distance, light.angle);
}

template <class T>
void add(Digest& digest, const scene::Track<T>& track) {
    digest.add(track.interpolation);
    digest.list(track.frames);
    digest.list(track.values);
}

void add(Digest& digest, const scene::Motion& motion) {
    for (const scene::MotionNode& node : motion.nodes) {
        digest.add(node.parent, node.rest.translation, node.rest.rotation, node.rest.scale);
        add(digest, node.translation);
        add(digest, node.rotation);
        add(digest, node.scale);
    }
    for (const scene::MovedInstance& moved : motion.instances)
        digest.add(moved.instance, moved.node, moved.node_from_object);
    digest.add(motion.period);
}

void add(Digest& digest, const scene::Physics& p) {
    digest.list(p.spheres);
    digest.list(p.obstacles);
    digest.add(p.radius, p.gravity, p.frame_rate, p.seed, p.speed, p.reach, p.restitution,
               p.friction, p.acuity.exact_degrees, p.acuity.levels_per_degree,
               p.acuity.coarsest_level);
}

} // namespace

std::string scene_hash(const scene::Scene& scene) {
    Digest digest;
    const auto all = [&](const auto& values) {
        digest.add(std::uint64_t{values.size()});
        for (const auto& value : values)
            add(digest, value);
    };
    all(scene.meshes);
    digest.add(std::uint64_t{scene.instances.size()});
    for (const scene::Instance& instance : scene.instances) {
        digest.add(instance.mesh);
        for (const glm::vec4& row : instance.world_from_object.row)
            digest.add(row);
    }
    all(scene.materials);
    all(scene.textures);
    all(scene.lights);
    digest.add(scene.ambient, scene.background, scene.ambient_occlusion_radius);
    add(digest, scene.motion);
    if (scene.physics)
        add(digest, *scene.physics);
    return digest.text();
}

} // namespace macula::bench
