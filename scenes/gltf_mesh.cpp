#include "scenes/gltf_mesh.hpp"

#include <numeric>

#include "scenes/validate.hpp"

namespace macula::scene {

void GltfMeshReader::report() {
    for (const auto& [text, count] : notes_)
        scene_.warnings.push_back(text + (count > 1 ? " (" + std::to_string(count) + ")" : ""));
    notes_.clear();
}

std::uint32_t GltfMeshReader::material_of(int index, const std::string& where) {
    if (index >= 0) {
        if (static_cast<std::size_t>(index) >= document_.model().materials.size())
            document_.fail(where, "material " + std::to_string(index) + " does not exist");
        return static_cast<std::uint32_t>(index);
    }
    if (default_material_ == kNoTexture) {
        default_material_ = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.emplace_back();
        scene_.materials.back().name = "default";
    }
    return default_material_;
}

void GltfMeshReader::read_triangles(const tinygltf::Primitive& source, const std::string& where,
                                    GltfPrimitive& primitive) const {
    std::vector<std::uint32_t> indices;
    if (source.indices >= 0) {
        indices = document_.indices(source.indices, where);
    } else {
        indices.resize(primitive.positions.size());
        std::iota(indices.begin(), indices.end(), 0u);
    }
    for (const std::uint32_t index : indices)
        if (index >= primitive.positions.size())
            document_.fail(where, "vertex index " + std::to_string(index) + " is out of range: " +
                                      std::to_string(primitive.positions.size()) + " vertices");
    const std::size_t n = indices.size();
    if (source.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t i = 2; i < n; ++i)
            primitive.triangles.emplace_back(indices[i - 2 + i % 2], indices[i - 1 - i % 2],
                                             indices[i]);
    } else if (source.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        for (std::size_t i = 2; i < n; ++i)
            primitive.triangles.emplace_back(indices[0], indices[i - 1], indices[i]);
    } else {
        for (std::size_t i = 2; i < n; i += 3)
            primitive.triangles.emplace_back(indices[i - 2], indices[i - 1], indices[i]);
    }
}

GltfPrimitive GltfMeshReader::read_primitive(const tinygltf::Primitive& source,
                                             const std::string& where) {
    GltfPrimitive primitive;
    primitive.material = material_of(source.material, where);
    const auto attribute = [&](const std::string& name) {
        const auto found = source.attributes.find(name);
        return found == source.attributes.end() ? -1 : found->second;
    };
    const std::vector<float> p = document_.floats(attribute("POSITION"), 3, where);
    const std::size_t count = p.size() / 3;
    // Many primitives may name the same accessor: small files must not unfold without bounds.
    vertices_ += count;
    if (vertices_ > 3 * kMaxTriangles || triangles_ > kMaxTriangles)
        document_.fail(where,
                       "the meshes have more than " + std::to_string(kMaxTriangles) + " triangles");
    primitive.positions.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        primitive.positions[i] = {p[3 * i], p[3 * i + 1], p[3 * i + 2]};
    if (const int normals = attribute("NORMAL"); normals >= 0) {
        const std::vector<float> n = document_.floats(normals, 3, where);
        if (n.size() != p.size())
            document_.fail(where, "there are fewer or more normals than positions");
        primitive.normals.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            primitive.normals[i] = {n[3 * i], n[3 * i + 1], n[3 * i + 2]};
    }
    const UvMapping mapping =
        source.material >= 0
            ? gltf_uv_mapping(
                  document_.model().materials[static_cast<std::size_t>(source.material)])
            : UvMapping{};
    if (const int uvs = attribute("TEXCOORD_" + std::to_string(mapping.set)); uvs >= 0) {
        const std::vector<float> t = document_.floats(uvs, 2, where);
        if (t.size() / 2 != count)
            document_.fail(where, "there are fewer or more texture coordinates than positions");
        primitive.uvs.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 uv(t[2 * i], t[2 * i + 1], 1.0);
            primitive.uvs[i] = {glm::dot(mapping.u, uv), glm::dot(mapping.v, uv)};
        }
    }
    if (attribute("COLOR_0") >= 0)
        note("vertex colours are ignored");
    if (attribute("JOINTS_0") >= 0)
        note("skinning is ignored: meshes stand in their bind pose");
    if (!source.targets.empty())
        note("morph targets are ignored");
    read_triangles(source, where, primitive);
    triangles_ += primitive.triangles.size();
    return primitive;
}

std::vector<GltfPrimitive> GltfMeshReader::read(int mesh) {
    std::vector<GltfPrimitive> list;
    const tinygltf::Mesh& source = document_.model().meshes[static_cast<std::size_t>(mesh)];
    for (std::size_t i = 0; i < source.primitives.size(); ++i) {
        const tinygltf::Primitive& primitive = source.primitives[i];
        const bool triangles = primitive.mode < 0 || primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                               primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (triangles)
            list.push_back(read_primitive(primitive, "mesh " + std::to_string(mesh) + " '" +
                                                         source.name + "', primitive " +
                                                         std::to_string(i)));
        else
            note("primitives of points or lines are left out");
    }
    return list;
}

void append(Mesh& mesh, const GltfPrimitive& primitive, const glm::dmat4& world) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const bool identity = world == glm::dmat4(1.0);
    const glm::dmat3 linear(world);
    const double determinant = glm::determinant(linear);
    // Cofactors instead of the inverse transpose: right up to length for every matrix.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    const double side = determinant < 0.0 ? -1.0 : 1.0;
    for (const glm::vec3& p : primitive.positions)
        mesh.positions.push_back(identity ? p : glm::vec3(world * glm::dvec4(p, 1.0)));
    for (const glm::vec3& n : primitive.normals) {
        const glm::dvec3 turned = cofactors * glm::dvec3(n) * side;
        const double length = glm::length(turned);
        mesh.normals.push_back(identity || !(length > 0.0) ? n : glm::vec3(turned / length));
    }
    const bool uvs = !primitive.uvs.empty();
    if (uvs || !mesh.uvs.empty()) {
        mesh.uvs.resize(first, glm::vec2(0.0f));
        mesh.uvs.insert(mesh.uvs.end(), primitive.uvs.begin(), primitive.uvs.end());
        mesh.uvs.resize(mesh.positions.size(), glm::vec2(0.0f));
    }
    for (const glm::uvec3& t : primitive.triangles) {
        // A mirroring transform turns the winding around; glTF wants fronts to stay fronts.
        mesh.triangles.push_back(side < 0.0 ? glm::uvec3(t.x, t.z, t.y) + first : t + first);
        mesh.triangle_material.push_back(primitive.material);
    }
}

} // namespace macula::scene
