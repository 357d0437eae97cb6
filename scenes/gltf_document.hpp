// A parsed glTF file: tinygltf's model with everything that the library leaves unchecked checked
// on access. Internal to the glTF loader (it includes the library's large header).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "scenes/error.hpp"
#include "scenes/texture_set.hpp"

namespace macula::scene {

// The encoded bytes of an image, or why there are none.
struct EncodedImage {
    std::vector<unsigned char> bytes;
    std::string missing;
};

class GltfDocument {
  public:
    // Parses `bytes`; buffers and images are read from below path's folder only. Throws SceneError.
    GltfDocument(const std::string& bytes, const std::filesystem::path& path, bool binary,
                 std::uint64_t max_bytes);

    const tinygltf::Model& model() const { return model_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    EncodedImage image(int index) const;

    // The elements of an accessor as floats, `components` of them for each (more in the file are an
    // error); normalised integers become [0, 1] or [-1, 1]. `where` begins the error messages.
    std::vector<float> floats(int accessor, int components, const std::string& where) const;
    // An accessor of unsigned integers.
    std::vector<std::uint32_t> indices(int accessor, const std::string& where) const;

    [[noreturn]] void fail(const std::string& where, const std::string& what) const;

  private:
    struct Elements {
        const unsigned char* data; // null: all zero
        std::size_t count, stride, components;
        int type; // a TINYGLTF_COMPONENT_TYPE_
        bool normalized;
    };
    Elements elements(int accessor, const std::string& where) const;
    std::span<const unsigned char> view_bytes(int view, const std::string& where) const;
    template <typename Read>
    void apply_sparse(const tinygltf::Accessor& accessor, const Elements& elements,
                      const std::string& where, Read&& read) const;

    std::filesystem::path path_;
    tinygltf::Model model_;
    std::vector<EncodedImage> images_;
    std::vector<std::string> warnings_;
};

// The materials of a document, converted to Phong.
std::vector<Material> gltf_materials(const GltfDocument& document, TextureSet& textures,
                                     Scene& scene);

// Where a material takes its texture coordinates from: the set, and KHR_texture_transform of its
// base colour texture as uv' = (dot(u, (uv, 1)), dot(v, (uv, 1))).
struct UvMapping {
    int set = 0;
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0};
};
UvMapping gltf_uv_mapping(const tinygltf::Material& material);

} // namespace macula::scene
