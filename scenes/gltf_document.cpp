#include "scenes/gltf_document.hpp"

#include <algorithm>
#include <set>

#include "scenes/input.hpp"
#include "scenes/text.hpp"

namespace macula::scene {
namespace {

constexpr std::size_t kMaxNesting = 128;

struct Context {
    std::filesystem::path folder;
    std::uint64_t max_bytes;
    std::vector<EncodedImage>* images;
};

// tinygltf asks for folder/uri and then for ./uri: only what lies below the folder is let through.
std::filesystem::path allowed_path(const std::string& asked, const Context& context) {
    const std::string prefix = context.folder.string() + "/";
    if (asked.compare(0, prefix.size(), prefix) != 0)
        return {};
    return path_below(context.folder, asked.substr(prefix.size()));
}

bool file_exists(const std::string& asked, void* user) {
    std::error_code error;
    const std::filesystem::path path = allowed_path(asked, *static_cast<Context*>(user));
    return !path.empty() && std::filesystem::is_regular_file(path, error);
}

// The default one expands shell syntax.
std::string same_path(const std::string& path, void*) {
    return path;
}

bool read_whole_file(std::vector<unsigned char>* out, std::string* problem,
                     const std::string& asked, void* user) {
    const Context& context = *static_cast<Context*>(user);
    try {
        const std::string bytes = read_file(allowed_path(asked, context), context.max_bytes);
        out->assign(bytes.begin(), bytes.end());
        return true;
    } catch (const SceneError& error) {
        *problem = error.what();
        return false;
    }
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// Keeps the encoded bytes; images in buffer views are read, checked, by GltfDocument::image.
bool keep_image(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void* user) {
    if (image->bufferView >= 0 || size < 0)
        return true;
    std::vector<EncodedImage>& images = *static_cast<Context*>(user)->images;
    images.resize(std::max(images.size(), static_cast<std::size_t>(index) + 1));
    images[static_cast<std::size_t>(index)].bytes.assign(bytes, bytes + size);
    return true;
}

// The library descends recursively into `extras`.
void check_nesting(std::string_view json, const std::string& name) {
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            in_string = c != '"';
            i += c == '\\' ? 1 : 0; // what is escaped ends no string
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMaxNesting)
                throw SceneError(name + ":" + std::to_string(line_number(json, i)) +
                                 ": JSON nested more than " + std::to_string(kMaxNesting) +
                                 " deep");
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
}

void split_lines(const std::string& text, std::vector<std::string>& lines) {
    for_each_line(text, [&](std::string_view line, std::size_t) {
        if (!trimmed(line).empty())
            lines.emplace_back(trimmed(line));
    });
}

// The part of a GLB's JSON chunk; the binary chunk may hold anything.
std::string_view json_chunk(const std::string& bytes) {
    std::string_view json = std::string_view(bytes).substr(std::min<std::size_t>(20, bytes.size()));
    if (bytes.size() >= 20) {
        std::uint32_t length = 0;
        for (int i = 3; i >= 0; --i)
            length =
                length << 8 | static_cast<unsigned char>(bytes[12 + static_cast<std::size_t>(i)]);
        json = json.substr(0, length);
    }
    return json;
}

void check_extensions(const tinygltf::Model& model, const std::string& name) {
    static const std::set<std::string> kKnown = {
        "KHR_lights_punctual",        "KHR_materials_emissive_strength",
        "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
        "KHR_materials_transmission", "KHR_materials_unlit",
        "KHR_mesh_quantization",      "KHR_texture_transform"};
    const auto unknown =
        std::find_if(model.extensionsRequired.begin(), model.extensionsRequired.end(),
                     [](const std::string& extension) { return !kKnown.contains(extension); });
    if (unknown != model.extensionsRequired.end())
        throw SceneError(name + ": requires the glTF extension " + *unknown +
                         ", which is not supported");
}

} // namespace

GltfDocument::GltfDocument(const std::string& bytes, const std::filesystem::path& path, bool binary,
                           std::uint64_t max_bytes)
    : path_(path) {
    const std::string name = path.string();
    if (bytes.size() > 0xffffff00u)
        throw SceneError(name + ": glTF files end at 4 GiB");
    check_nesting(binary ? json_chunk(bytes) : std::string_view(bytes), name);
    const std::filesystem::path folder =
        path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    Context context{folder, max_bytes, &images_};
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({file_exists, same_path, read_whole_file, write_nothing, &context});
    loader.SetImageLoader(keep_image, &context);
    std::string error, warning;
    bool ok = false;
    try {
        if (binary) {
            // The library's bound on the binary chunk is 8 bytes too lenient.
            const std::string padded = bytes + std::string(16, '\0');
            ok = loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(padded.data()),
                                             static_cast<unsigned>(bytes.size()), folder.string());
        } else {
            ok = loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(),
                                            static_cast<unsigned>(bytes.size()), folder.string());
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& thrown) {
        error += thrown.what();
    }
    if (!ok) {
        std::vector<std::string> lines;
        split_lines(error, lines);
        throw SceneError(name + ": " + (lines.empty() ? "not a glTF file" : lines.front()));
    }
    split_lines(warning, warnings_);
    check_extensions(model_, name);
    images_.resize(model_.images.size());
}

void GltfDocument::fail(const std::string& where, const std::string& what) const {
    throw SceneError(path_.string() + ": " + where + ": " + what);
}

EncodedImage GltfDocument::image(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.images.size())
        return {{}, "there is no image " + std::to_string(index)};
    const tinygltf::Image& source = model_.images[static_cast<std::size_t>(index)];
    if (source.bufferView >= 0) {
        const auto bytes = view_bytes(source.bufferView, "image " + std::to_string(index));
        return {{bytes.begin(), bytes.end()}, {}};
    }
    EncodedImage encoded = images_[static_cast<std::size_t>(index)];
    if (encoded.bytes.empty())
        encoded.missing = "no such file below the scene's folder";
    return encoded;
}

} // namespace macula::scene
