#include "host/frame/surfaces.hpp"
#include "host/frame/blended.hpp"

#include <algorithm>
#include <map>

namespace macula::frame {
namespace {

void store(const glm::vec3& v, float (&out)[3]) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

shared::SurfaceVertex make_vertex(const scene::Mesh& mesh, std::size_t i) {
    shared::SurfaceVertex vertex{};
    store(mesh.positions[i], vertex.position);
    if (!mesh.normals.empty())
        store(mesh.normals[i], vertex.normal);
    if (!mesh.uvs.empty()) {
        vertex.uv[0] = mesh.uvs[i].x;
        vertex.uv[1] = mesh.uvs[i].y;
    }
    return vertex;
}

std::uint32_t entry_count(std::span<const MeshPart> parts) {
    std::uint32_t count = 0;
    for (const MeshPart& part : parts)
        count = std::max(count, part.first_entry + part.triangle_count);
    return count;
}

// First vertex of each mesh that some part uses, and the number of all.
std::map<std::uint32_t, std::uint32_t>
place_vertices(const scene::Scene& scene, std::span<const MeshPart> parts, std::uint64_t& count) {
    std::map<std::uint32_t, std::uint32_t> first;
    count = 0;
    for (const MeshPart& part : parts) {
        if (first.contains(part.mesh))
            continue;
        first[part.mesh] = static_cast<std::uint32_t>(count);
        count += scene.meshes[part.mesh].positions.size();
    }
    return first;
}

shared::SurfaceMaterial make_material(const scene::Material& m, const TextureData& textures) {
    const auto slot = [&](std::uint32_t texture) {
        return texture < textures.slot_of.size() ? textures.slot_of[texture] : MACULA_NO_TEXTURE;
    };
    shared::SurfaceMaterial out{};
    store(m.diffuse, out.diffuse);
    store(m.specular, out.specular);
    store(m.emission, out.emission);
    out.shininess = m.shininess;
    out.diffuse_texture = slot(m.diffuse_texture);
    out.specular_texture = slot(m.specular_texture);
    out.emission_texture = slot(m.emission_texture);
    out.normal_texture = slot(m.normal_texture);
    return out;
}

// Of a blended material.
std::uint32_t opacity_texture(const scene::Scene& scene, const scene::Material& m,
                              const TextureData& data) {
    const auto slot = [&](std::uint32_t texture) {
        return texture < data.slot_of.size() ? data.slot_of[texture] : scene::kNoTexture;
    };
    if (!is_blended(m))
        return MACULA_NO_TEXTURE;
    if (slot(m.alpha_texture) != scene::kNoTexture)
        return slot(m.alpha_texture);
    const std::uint32_t colour = slot(m.diffuse_texture);
    return colour != scene::kNoTexture && scene.textures[m.diffuse_texture].has_alpha
               ? colour | MACULA_ALPHA_CHANNEL
               : MACULA_NO_TEXTURE;
}

bool any_positive(const glm::vec3& v) {
    return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f;
}

// A kernel must be given some memory, also where there is nothing in it.
template <class T>
compute::Buffer upload(compute::Device& device, const std::vector<T>& values, const char* what) {
    if (values.empty())
        return device.upload(std::span<const T>(std::vector<T>(1)), what);
    return device.upload(std::span<const T>(values), what);
}

} // namespace

bool has_optics(const scene::Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const scene::Material& m) {
        return any_positive(m.reflectivity) || any_positive(m.transmission);
    });
}

shared::SurfaceOptics make_optics(const scene::Material& m) {
    shared::SurfaceOptics out{};
    out.opacity = std::clamp(m.opacity, 0.0f, 1.0f);
    out.opacity_texture = MACULA_NO_TEXTURE;
    out.index_of_refraction = std::clamp(m.index_of_refraction, 0.1f, 10.0f);
    for (int i = 0; i < 3; ++i) {
        const float scale = 1.0f / std::max(1.0f, m.reflectivity[i] + m.transmission[i]);
        out.reflectivity[i] = m.reflectivity[i] * scale;
        out.transmission[i] = m.transmission[i] * scale;
        const float left = 1.0f - out.reflectivity[i] - out.transmission[i];
        out.diffuse_part[i] = m.diffuse[i] > left ? std::max(left, 0.0f) / m.diffuse[i] : 1.0f;
    }
    return out;
}

DeviceSurfaces::DeviceSurfaces(compute::Device& device, const scene::Scene& scene,
                               std::span<const MeshPart> parts,
                               const DeviceSurfaces* shared_tables) {
    std::uint64_t vertex_count = 0;
    const auto first_vertex = place_vertices(scene, parts, vertex_count);
    vertices = device.allocate_array<shared::SurfaceVertex>(vertex_count, "vertex attributes");
    triangles =
        device.allocate_array<shared::SurfaceTriangle>(entry_count(parts), "triangle attributes");
    {
        auto out = vertices.map_write<shared::SurfaceVertex>();
        for (const auto& [mesh, first] : first_vertex)
            for (std::size_t i = 0; i < scene.meshes[mesh].positions.size(); ++i)
                out[first + i] = make_vertex(scene.meshes[mesh], i);
    }
    {
        auto out = triangles.map_write<shared::SurfaceTriangle>();
        for (const MeshPart& part : parts) {
            const scene::Mesh& mesh = scene.meshes[part.mesh];
            const std::uint32_t first = first_vertex.at(part.mesh);
            for (std::uint32_t i = 0; i < part.triangle_count; ++i) {
                const glm::uvec3& t = mesh.triangles[i];
                out[part.first_entry + i] = {{first + t.x, first + t.y, first + t.z},
                                             mesh.triangle_material[i]};
            }
        }
    }
    if (shared_tables != nullptr) {
        optics = shared_tables->optics;
        materials = shared_tables->materials;
        textures = shared_tables->textures;
        levels = shared_tables->levels;
        texels = shared_tables->texels;
        decode = shared_tables->decode;
        return;
    }
    const TextureData data(scene);
    std::vector<shared::SurfaceMaterial> table;
    std::vector<shared::SurfaceOptics> optics_table;
    for (const scene::Material& material : scene.materials) {
        table.push_back(make_material(material, data));
        optics_table.push_back(make_optics(material));
        optics_table.back().opacity_texture = opacity_texture(scene, material, data);
    }
    optics = upload(device, optics_table, "optics of materials");
    materials = upload(device, table, "materials");
    textures = upload(device, data.textures, "textures");
    levels = upload(device, data.levels, "texture levels");
    texels = upload(device, data.texels, "texels");
    decode = upload(device, decoding_table(), "texel decoding table");
}

} // namespace macula::frame
