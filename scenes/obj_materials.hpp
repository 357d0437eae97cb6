// Wavefront MTL materials, read by tinyobjloader, as Phong materials.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "scenes/input.hpp"
#include "scenes/scene.hpp"
#include "scenes/texture_set.hpp"

namespace macula::scene {

class ObjMaterials {
  public:
    // Materials and warnings are appended to `scene`; files are looked up below `folder`.
    ObjMaterials(Scene& scene, TextureSet& textures, std::filesystem::path folder,
                 std::uint64_t max_bytes);

    // What follows `mtllib` on its line: one name, which may hold blanks, or several.
    void load_libraries(std::string_view names);
    // The text of one library; `name` begins its warnings. Names already known keep their material.
    void parse(const std::string& text, const std::string& name);
    // The index of a material called by `usemtl`; an unknown one is added with default values and
    // a warning.
    std::uint32_t find(const std::string& name);
    // The material of faces before any `usemtl`.
    std::uint32_t default_material();

  private:
    bool load_library(const std::string& name);

    Scene& scene_;
    TextureSet& textures_;
    std::filesystem::path folder_;
    std::uint64_t max_bytes_;
    std::map<std::string, std::uint32_t, std::less<>> by_name_;
};

} // namespace macula::scene
