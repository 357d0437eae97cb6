#include "scenes/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <tiny_obj_loader.h>

#include "scenes/error.hpp"
#include "scenes/text.hpp"

namespace macula::scene {
namespace {

constexpr std::uint64_t kMaxLibraryBytes = std::uint64_t{64} << 20;

glm::vec3 to_vec3(const tinyobj::real_t (&c)[3]) {
    return {c[0], c[1], c[2]};
}

// tinyobjloader takes what is no number for 0, and `d -halo 0.5` for 0 as well: such lines are
// mended or left out with a warning, so that the default value stands.
std::string checked_library(const std::string& text, const std::string& name, Scene& scene) {
    constexpr std::array<std::string_view, 12> kNumeric = {"Ka", "Kd", "Ks", "Ke", "Kt", "Tf",
                                                           "Ns", "Ni", "d",  "Tr", "Pr", "Pm"};
    std::string checked;
    checked.reserve(text.size());
    for_each_line(text, [&](std::string_view line, std::size_t number) {
        const std::vector<std::string_view> word = words(line);
        if (word.empty() ||
            std::find(kNumeric.begin(), kNumeric.end(), word[0]) == kNumeric.end()) {
            checked.append(line).push_back('\n');
            return;
        }
        const bool colour = (word[0][0] == 'K' || word[0] == "Tf");
        const std::size_t first = word.size() > 1 && word[1] == "-halo" ? 2 : 1;
        std::size_t last = first;
        while (last < word.size() && last - first < (colour ? 3u : 1u) && is_number(word[last]))
            ++last;
        const bool comment_follows = last < word.size() && word[last][0] == '#';
        const bool complete = last - first == (colour ? 3u : 1u);
        if (last == first || (!complete && last < word.size() && !comment_follows)) {
            scene.warnings.push_back(name + ":" + std::to_string(number) + ": '" +
                                     std::string(trimmed(line)) + "' is ignored: not a number");
            return;
        }
        checked.append(word[0]);
        for (std::size_t i = first; i < first + (colour ? 3 : 1); ++i)
            checked.append(" ").append(word[std::min(i, last - 1)]); // `Kd r` stands for r r r
        checked.push_back('\n');
    });
    return checked;
}

// Illumination models of the MTL format that ask for mirror and for refracted rays.
bool is_mirror(int illum) {
    return illum == 3 || (illum >= 5 && illum <= 7);
}
bool is_refractive(int illum) {
    return illum == 6 || illum == 7;
}

Material to_phong(const tinyobj::material_t& source) {
    Material material;
    material.name = source.name;
    material.diffuse = to_vec3(source.diffuse);
    material.specular = to_vec3(source.specular);
    material.emission = to_vec3(source.emission);
    material.shininess = std::max(1.0f, static_cast<float>(source.shininess));
    material.opacity = std::clamp(static_cast<float>(source.dissolve), 0.0f, 1.0f);
    material.index_of_refraction = source.ior > 0.0f ? static_cast<float>(source.ior) : 1.0f;
    if (is_mirror(source.illum))
        material.reflectivity = material.specular;
    if (is_refractive(source.illum)) {
        material.transmission = to_vec3(source.transmittance);
        if (material.transmission == glm::vec3(0.0f)) // no Tf: what is not dissolved
            material.transmission = glm::vec3(1.0f - material.opacity);
    }
    if (material.opacity < 1.0f)
        material.alpha_mode = AlphaMode::blend;
    return material;
}

std::string forward_slashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

} // namespace

ObjMaterials::ObjMaterials(Scene& scene, TextureSet& textures, std::filesystem::path folder,
                           std::uint64_t max_bytes)
    : scene_(scene), textures_(textures), folder_(std::move(folder)),
      max_bytes_(std::min(max_bytes, kMaxLibraryBytes)) {}

void ObjMaterials::load_libraries(std::string_view names) {
    const std::string_view whole = trimmed(names);
    if (whole.empty()) {
        scene_.warnings.emplace_back("mtllib names no file");
        return;
    }
    if (load_library(std::string(whole)))
        return;
    const std::vector<std::string_view> parts = words(whole);
    bool any = false;
    for (std::size_t i = 0; parts.size() > 1 && i < parts.size(); ++i)
        any = load_library(std::string(parts[i])) || any;
    if (!any)
        scene_.warnings.push_back("material library '" + std::string(whole) +
                                  "' cannot be found; default materials take its place");
}

bool ObjMaterials::load_library(const std::string& name) {
    const std::filesystem::path path = existing_path_below(folder_, name);
    std::error_code error;
    if (path.empty() || !std::filesystem::is_regular_file(path, error))
        return false;
    parse(read_file(path, max_bytes_), path.filename().string());
    return true;
}

void ObjMaterials::parse(const std::string& text, const std::string& name) {
    std::istringstream stream(checked_library(text, name, scene_));
    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> sources;
    std::string warnings, errors; // of `d` beside `Tr`, where `d` wins, as it should
    tinyobj::LoadMtl(&indices, &sources, &stream, &warnings, &errors);
    for (const tinyobj::material_t& source : sources) {
        if (source.name.empty() || by_name_.contains(source.name))
            continue;
        Material material = to_phong(source);
        const auto add = [&](const std::string& file, TextureUse use,
                             const tinyobj::texture_option_t& option) {
            if (file.empty())
                return kNoTexture;
            if (option.scale[0] != 1 || option.scale[1] != 1 || option.origin_offset[0] != 0 ||
                option.origin_offset[1] != 0)
                scene_.warnings.push_back(name + ": material '" + source.name +
                                          "': the texture options -s and -o are ignored");
            TextureRequest request;
            request.name = forward_slashes(file);
            request.file = existing_path_below(folder_, file);
            if (request.file.empty())
                request.missing = "the path leads out of the scene's folder";
            request.use = use;
            request.wrap_u = request.wrap_v = option.clamp ? Wrap::clamp : Wrap::repeat;
            request.bump_multiplier =
                use == TextureUse::bump ? static_cast<float>(option.bump_multiplier) : 1.0f;
            return textures_.add(request);
        };
        material.diffuse_texture =
            add(source.diffuse_texname, TextureUse::colour, source.diffuse_texopt);
        material.specular_texture =
            add(source.specular_texname, TextureUse::colour, source.specular_texopt);
        material.emission_texture =
            add(source.emissive_texname, TextureUse::colour, source.emissive_texopt);
        material.alpha_texture = add(source.alpha_texname, TextureUse::mask, source.alpha_texopt);
        material.normal_texture =
            source.normal_texname.empty()
                ? add(source.bump_texname, TextureUse::bump, source.bump_texopt)
                : add(source.normal_texname, TextureUse::normal, source.normal_texopt);
        const bool alpha_in_colour = material.diffuse_texture != kNoTexture &&
                                     scene_.textures[material.diffuse_texture].has_alpha;
        if (material.alpha_texture != kNoTexture || alpha_in_colour)
            material.alpha_mode = AlphaMode::mask;
        by_name_.emplace(source.name, static_cast<std::uint32_t>(scene_.materials.size()));
        scene_.materials.push_back(std::move(material));
    }
}

std::uint32_t ObjMaterials::find(const std::string& name) {
    const auto found = by_name_.find(name);
    if (found != by_name_.end())
        return found->second;
    scene_.warnings.push_back("material '" + name +
                              "' is not defined; a default one takes its place");
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    Material material;
    material.name = name;
    scene_.materials.push_back(material);
    by_name_.emplace(name, index);
    return index;
}

std::uint32_t ObjMaterials::default_material() {
    const auto found = by_name_.find("");
    if (found != by_name_.end())
        return found->second;
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    Material material;
    material.name = "default";
    scene_.materials.push_back(material);
    by_name_.emplace("", index);
    return index;
}

} // namespace macula::scene
