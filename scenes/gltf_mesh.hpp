// Meshes of a glTF document. Internal to the glTF loader.
#pragma once

#include <map>

#include "scenes/gltf_document.hpp"

namespace macula::scene {

// One primitive in object space as indexed triangles; normals and uvs may be empty.
struct GltfPrimitive {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;
    std::uint32_t material = 0;
};

class GltfMeshReader {
  public:
    // A default material and warnings are appended to `scene`, whose materials are those of the
    // document so far.
    GltfMeshReader(const GltfDocument& document, Scene& scene)
        : document_(document), scene_(scene) {}

    // The triangles of a mesh of the document. Throws SceneError on anything out of range.
    std::vector<GltfPrimitive> read(int mesh);
    // Counts a warning; report() appends all of them to the scene.
    void note(const std::string& text) { ++notes_[text]; }
    void report();

  private:
    GltfPrimitive read_primitive(const tinygltf::Primitive& source, const std::string& where);
    void read_triangles(const tinygltf::Primitive& source, const std::string& where,
                        GltfPrimitive& primitive) const;
    std::uint32_t material_of(int index, const std::string& where);

    const GltfDocument& document_;
    Scene& scene_;
    std::uint32_t default_material_ = kNoTexture;
    std::map<std::string, std::uint64_t> notes_;
    std::uint64_t vertices_ = 0, triangles_ = 0; // read so far
};

// Adds a primitive, moved by `world`, to a mesh that has normals if and only if the primitive has.
void append(Mesh& mesh, const GltfPrimitive& primitive, const glm::dmat4& world);

} // namespace macula::scene
