// glTF's metallic-roughness materials as Phong materials. The conversion is documented, with its
// limits, in docs/scene-file.md.
#include <algorithm>
#include <cmath>

#include "scenes/gltf_document.hpp"
#include "scenes/image.hpp"

namespace macula::scene {
namespace {

constexpr float kDielectricReflectance = 0.04f; // at normal incidence, the specification's value

double number(const tinygltf::Value& object, const char* key, double fallback) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber())
        return fallback;
    return object.Get(key).GetNumberAsDouble();
}

// `count` numbers of an array member, or `fallback`.
glm::dvec3 numbers(const tinygltf::Value& object, const char* key, int count, glm::dvec3 fallback) {
    if (!object.IsObject() || !object.Has(key))
        return fallback;
    const tinygltf::Value& array = object.Get(key);
    if (!array.IsArray() || array.ArrayLen() < static_cast<std::size_t>(count))
        return fallback;
    for (int i = 0; i < count; ++i)
        fallback[i] = array.Get(i).IsNumber() ? array.Get(i).GetNumberAsDouble() : fallback[i];
    return fallback;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& map, const char* name) {
    const auto found = map.find(name);
    return found == map.end() || !found->second.IsObject() ? nullptr : &found->second;
}

glm::vec3 factor3(const std::vector<double>& values, float fallback) {
    glm::vec3 result(fallback);
    for (std::size_t i = 0; i < 3 && i < values.size(); ++i)
        result[static_cast<int>(i)] = static_cast<float>(values[i]);
    return result;
}

Wrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE)
        return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// Phong's exponent of the same width of highlight as the GGX lobe: 2 / alpha^2 - 2 (Karis 2013).
float shininess_of(float roughness) {
    const float alpha = std::max(roughness * roughness, 0.02f);
    return std::clamp(2.0f / (alpha * alpha) - 2.0f, 1.0f, 2048.0f);
}

class Converter {
  public:
    Converter(const GltfDocument& document, TextureSet& textures, Scene& scene)
        : document_(document), textures_(textures), scene_(scene) {}

    Material convert(const tinygltf::Material& source, std::size_t index);

  private:
    const tinygltf::Texture* texture(int index) const;
    std::string image_name(int index) const;
    std::uint32_t add(int index, TextureUse use);
    glm::vec2 mean_roughness_metallic(const tinygltf::Material& source) const;
    void convert_metallic(const tinygltf::Material& source, Material& material);
    void convert_specular(const tinygltf::Value& source, Material& material);
    void convert_alpha(const tinygltf::Material& source, Material& material) const;

    const GltfDocument& document_;
    TextureSet& textures_;
    Scene& scene_;
};

const tinygltf::Texture* Converter::texture(int index) const {
    const std::vector<tinygltf::Texture>& all = document_.model().textures;
    const bool exists = index >= 0 && static_cast<std::size_t>(index) < all.size();
    return exists ? &all[static_cast<std::size_t>(index)] : nullptr;
}

std::string Converter::image_name(int index) const {
    const std::vector<tinygltf::Image>& all = document_.model().images;
    if (index < 0 || static_cast<std::size_t>(index) >= all.size())
        return "image " + std::to_string(index);
    const tinygltf::Image& image = all[static_cast<std::size_t>(index)];
    if (!image.uri.empty())
        return image.uri;
    return image.name.empty() ? "image " + std::to_string(index) : image.name;
}

std::uint32_t Converter::add(int index, TextureUse use) {
    if (index < 0)
        return kNoTexture;
    const tinygltf::Texture* source = texture(index);
    if (source == nullptr)
        document_.fail("materials", "texture " + std::to_string(index) + " does not exist");
    const EncodedImage image = document_.image(source->source);
    TextureRequest request;
    request.name = image_name(source->source);
    request.bytes = image.bytes;
    request.missing = image.missing;
    request.use = use;
    request.first_row_is_top_of_v = false;
    request.negate_green = use == TextureUse::normal;
    const std::vector<tinygltf::Sampler>& samplers = document_.model().samplers;
    if (source->sampler >= 0 && static_cast<std::size_t>(source->sampler) < samplers.size()) {
        const tinygltf::Sampler& sampler = samplers[static_cast<std::size_t>(source->sampler)];
        request.wrap_u = wrap_of(sampler.wrapS);
        request.wrap_v = wrap_of(sampler.wrapT);
    }
    return textures_.add(request);
}

// A Phong material has one exponent: roughness and metalness vary with the texture in glTF, and
// their mean over it stands for them.
glm::vec2 Converter::mean_roughness_metallic(const tinygltf::Material& source) const {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    glm::vec2 mean(static_cast<float>(pbr.roughnessFactor), static_cast<float>(pbr.metallicFactor));
    const tinygltf::Texture* map = texture(pbr.metallicRoughnessTexture.index);
    if (map == nullptr || !textures_.decodes())
        return mean;
    try {
        const EncodedImage encoded = document_.image(map->source);
        if (encoded.bytes.empty())
            throw SceneError(encoded.missing);
        const Image image = decode_image(encoded.bytes, "metallic-roughness texture");
        double green = 0.0, blue = 0.0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
            green += image.rgba[i + 1];
            blue += image.rgba[i + 2];
        }
        const double scale = 4.0 / (255.0 * static_cast<double>(image.rgba.size()));
        mean *= glm::vec2(green * scale, blue * scale);
    } catch (const SceneError& error) {
        scene_.warnings.push_back("material '" + source.name +
                                  "': metallic-roughness texture left out: " + error.what());
    }
    return mean;
}

void Converter::convert_metallic(const tinygltf::Material& source, Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    const glm::vec3 base = factor3(pbr.baseColorFactor, 1.0f);
    material.diffuse_texture = add(pbr.baseColorTexture.index, TextureUse::colour);
    const glm::vec2 mean = mean_roughness_metallic(source);
    const float roughness = std::clamp(mean.x, 0.0f, 1.0f);
    const float metallic = std::clamp(mean.y, 0.0f, 1.0f);
    // A metal has no diffuse part, but without an environment to mirror it would turn black: half
    // of its colour stays diffuse.
    material.diffuse = base * (1.0f - 0.5f * metallic);
    material.specular = glm::mix(glm::vec3(kDielectricReflectance), base, metallic);
    if (metallic > 0.5f)
        material.specular_texture = material.diffuse_texture;
    material.shininess = shininess_of(roughness);
    if (roughness < 0.1f)
        material.reflectivity = material.specular;
}

// KHR_materials_pbrSpecularGlossiness.
void Converter::convert_specular(const tinygltf::Value& source, Material& material) {
    material.diffuse = glm::vec3(numbers(source, "diffuseFactor", 3, glm::dvec3(1.0)));
    material.specular = glm::vec3(numbers(source, "specularFactor", 3, glm::dvec3(1.0)));
    material.shininess =
        shininess_of(1.0f - static_cast<float>(number(source, "glossinessFactor", 1.0)));
    if (source.Has("diffuseTexture"))
        material.diffuse_texture =
            add(static_cast<int>(number(source.Get("diffuseTexture"), "index", -1.0)),
                TextureUse::colour);
    const tinygltf::Value& alpha = source.Get("diffuseFactor");
    if (alpha.IsArray() && alpha.ArrayLen() == 4 && alpha.Get(3).IsNumber())
        material.opacity = static_cast<float>(alpha.Get(3).GetNumberAsDouble());
}

void Converter::convert_alpha(const tinygltf::Material& source, Material& material) const {
    material.opacity = std::clamp(material.opacity, 0.0f, 1.0f);
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    const bool textured = material.diffuse_texture != kNoTexture &&
                          scene_.textures[material.diffuse_texture].has_alpha;
    if (source.alphaMode == "MASK") {
        // alpha = factor * texel: the factor moves to the other side of the comparison.
        if (textured && material.opacity > 0.0f)
            material.alpha_cutoff = std::min(1.0f, material.alpha_cutoff / material.opacity);
        material.alpha_mode = textured ? AlphaMode::mask : AlphaMode::opaque;
        material.opacity = 1.0f;
    } else if (source.alphaMode == "BLEND") {
        material.alpha_cutoff = 0.5f;
        material.alpha_mode =
            material.opacity < 1.0f || textured ? AlphaMode::blend : AlphaMode::opaque;
    } else {
        material.opacity = 1.0f;
    }
}

Material Converter::convert(const tinygltf::Material& source, std::size_t index) {
    Material material;
    material.name = source.name.empty() ? "material " + std::to_string(index) : source.name;
    const std::vector<double>& base = source.pbrMetallicRoughness.baseColorFactor;
    material.opacity = base.size() > 3 ? static_cast<float>(base[3]) : 1.0f;
    const auto* specular = extension(source.extensions, "KHR_materials_pbrSpecularGlossiness");
    if (specular != nullptr)
        convert_specular(*specular, material);
    else
        convert_metallic(source, material);
    material.normal_texture = add(source.normalTexture.index, TextureUse::normal);
    material.emission = factor3(source.emissiveFactor, 0.0f);
    material.emission_texture = add(source.emissiveTexture.index, TextureUse::colour);
    if (const auto* glow = extension(source.extensions, "KHR_materials_emissive_strength"))
        material.emission *= static_cast<float>(number(*glow, "emissiveStrength", 1.0));
    if (const auto* ior = extension(source.extensions, "KHR_materials_ior"))
        material.index_of_refraction = static_cast<float>(number(*ior, "ior", 1.5));
    if (const auto* clear = extension(source.extensions, "KHR_materials_transmission")) {
        material.transmission =
            material.diffuse * static_cast<float>(number(*clear, "transmissionFactor", 0.0));
        if (material.transmission != glm::vec3(0.0f))
            material.reflectivity = glm::vec3(0.0f); // Fresnel's part is reflected
    }
    if (extension(source.extensions, "KHR_materials_unlit") != nullptr)
        scene_.warnings.push_back("material '" + material.name + "': unlit, but is shaded here");
    convert_alpha(source, material);
    const int set = source.pbrMetallicRoughness.baseColorTexture.texCoord;
    const bool other_set =
        (source.normalTexture.index >= 0 && source.normalTexture.texCoord != set) ||
        (source.emissiveTexture.index >= 0 && source.emissiveTexture.texCoord != set);
    if (other_set)
        scene_.warnings.push_back("material '" + material.name +
                                  "': all its textures use the base colour's coordinates");
    return material;
}

} // namespace

std::vector<Material> gltf_materials(const GltfDocument& document, TextureSet& textures,
                                     Scene& scene) {
    Converter converter(document, textures, scene);
    std::vector<Material> materials;
    for (const tinygltf::Material& source : document.model().materials)
        materials.push_back(converter.convert(source, materials.size()));
    return materials;
}

UvMapping gltf_uv_mapping(const tinygltf::Material& material) {
    const tinygltf::TextureInfo& base = material.pbrMetallicRoughness.baseColorTexture;
    UvMapping mapping;
    mapping.set = base.texCoord;
    const tinygltf::Value* transform = extension(base.extensions, "KHR_texture_transform");
    if (transform == nullptr)
        return mapping;
    const glm::dvec3 offset = numbers(*transform, "offset", 2, glm::dvec3(0.0));
    const glm::dvec3 scale = numbers(*transform, "scale", 2, glm::dvec3(1.0));
    const double angle = number(*transform, "rotation", 0.0);
    const double c = std::cos(angle), s = std::sin(angle);
    mapping.set = static_cast<int>(number(*transform, "texCoord", mapping.set));
    mapping.u = {c * scale.x, s * scale.y, offset.x};
    mapping.v = {-s * scale.x, c * scale.y, offset.y};
    return mapping;
}

} // namespace macula::scene
