// Wavefront OBJ: tinyobjloader reads the lines and hands over vertices and faces one by one; here
// they become one indexed mesh, and everything that the library lets pass is checked.
#include <istream>
#include <streambuf>

#include <tiny_obj_loader.h>

#include "scenes/formats.hpp"
#include "scenes/obj_materials.hpp"
#include "scenes/text.hpp"
#include "scenes/triangulate.hpp"

namespace macula::scene {
namespace {

// A stream over text in memory that knows how far it was read.
class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(const std::string& text) : text_(text) {
        char* begin = const_cast<char*>(text.data());
        setg(begin, begin, begin + text.size());
    }

    // The line that was read last, and its number for messages.
    std::string_view last_line() const {
        std::size_t end = offset();
        while (end > 0 && (text_[end - 1] == '\n' || text_[end - 1] == '\r'))
            --end;
        const std::size_t before =
            end == 0 ? std::string::npos : text_.find_last_of("\r\n", end - 1);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        return std::string_view(text_).substr(begin, end - begin);
    }
    std::size_t last_line_number() const {
        const std::string_view line = last_line();
        return line_number(text_, static_cast<std::size_t>(line.data() - text_.data()));
    }

  private:
    std::size_t offset() const { return static_cast<std::size_t>(gptr() - eback()); }
    const std::string& text_;
};

class ObjBuilder {
  public:
    ObjBuilder(const MemoryBuffer& source, std::string name, ObjMaterials& materials)
        : source_(source), name_(std::move(name)), materials_(materials) {}

    void add_position(float x, float y, float z) {
        require_numbers(3);
        positions_.emplace_back(x, y, z);
        first_vertex_.push_back(kNone);
    }
    void add_normal(float x, float y, float z) {
        require_numbers(3);
        normals_.emplace_back(x, y, z);
    }
    void add_texcoord(float u, float v) {
        require_numbers(1);
        texcoords_.emplace_back(u, v);
    }
    void use_material(const char* name) {
        material_ = materials_.find(std::string(trimmed(name)));
        material_known_ = true;
    }
    void add_face(const tinyobj::index_t* corners, std::size_t count);

    Mesh finish(Scene& scene) &&;

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr int kMaxShared = 256; // vertices looked through for one position
    struct Vertex {
        int position, texcoord, normal; // 0-based; -1: none
        std::uint32_t next;             // another vertex of the same position
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw SceneError(name_ + ":" + std::to_string(source_.last_line_number()) + ": " + what);
    }
    void require_numbers(std::size_t count) const;
    int resolve(int index, std::size_t size, const char* what) const;
    std::uint32_t vertex(int position, int texcoord, int normal);

    const MemoryBuffer& source_;
    std::string name_;
    ObjMaterials& materials_;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::vec2> texcoords_;
    std::vector<std::uint32_t> first_vertex_; // of each position
    std::vector<Vertex> vertices_;
    std::uint32_t material_ = 0;
    bool material_known_ = false;
    std::uint64_t short_faces_ = 0, fans_ = 0;
    Mesh mesh_;
    std::vector<std::uint32_t> face_; // vertices of the face at hand
    std::vector<glm::vec3> corners_;
    std::vector<glm::uvec3> pieces_;
};

// tinyobjloader takes what is no number for 0.
void ObjBuilder::require_numbers(std::size_t count) const {
    std::string_view rest = trimmed(source_.last_line());
    for (std::size_t i = 0; i <= count; ++i) {
        const std::size_t end = std::min(rest.find_first_of(" \t\r"), rest.size());
        const std::string_view word = rest.substr(0, end);
        if (i > 0 && !is_number(word))
            fail(word.empty() ? "a number is missing"
                              : "'" + std::string(word) + "' is not a finite number");
        rest = trimmed(rest.substr(end));
    }
}

int ObjBuilder::resolve(int index, std::size_t size, const char* what) const {
    const auto count = static_cast<std::int64_t>(size);
    const std::int64_t resolved = index > 0 ? std::int64_t{index} - 1 : count + index;
    if (index == 0 || resolved < 0 || resolved >= count)
        fail(std::string(what) + " index " + std::to_string(index) +
             " is out of range: " + std::to_string(count) + " defined so far");
    return static_cast<int>(resolved);
}

std::uint32_t ObjBuilder::vertex(int position, int texcoord, int normal) {
    std::uint32_t* link = &first_vertex_[static_cast<std::size_t>(position)];
    // The bound on the search keeps hostile files, which reuse one position, from quadratic time.
    for (int steps = 0; *link != kNone && steps < kMaxShared; ++steps) {
        Vertex& known = vertices_[*link];
        if (known.texcoord == texcoord && known.normal == normal)
            return *link;
        link = &known.next;
    }
    const auto index = static_cast<std::uint32_t>(vertices_.size());
    if (*link == kNone)
        *link = index;
    vertices_.push_back({position, texcoord, normal, kNone});
    return index;
}

void ObjBuilder::add_face(const tinyobj::index_t* corners, std::size_t count) {
    if (count < 3) {
        ++short_faces_;
        return;
    }
    // The library reads indices with atoi, which wraps around without a word.
    const std::string_view line = source_.last_line();
    for (std::size_t i = 0, digits = 0; i < line.size(); ++i) {
        digits = line[i] >= '0' && line[i] <= '9' ? digits + 1 : 0;
        if (digits > 9)
            fail("an index has more than 9 digits");
    }
    if (!material_known_) {
        material_ = materials_.default_material();
        material_known_ = true;
    }
    face_.clear();
    corners_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const tinyobj::index_t& c = corners[i];
        const int position = resolve(c.vertex_index, positions_.size(), "vertex");
        const int texcoord =
            c.texcoord_index == 0 ? -1 : resolve(c.texcoord_index, texcoords_.size(), "texture");
        const int normal =
            c.normal_index == 0 ? -1 : resolve(c.normal_index, normals_.size(), "normal");
        face_.push_back(vertex(position, texcoord, normal));
        corners_.push_back(positions_[static_cast<std::size_t>(position)]);
    }
    fans_ += count > kMaxEarClipping;
    pieces_.clear();
    triangulate(corners_, pieces_);
    for (const glm::uvec3& piece : pieces_) {
        mesh_.triangles.emplace_back(face_[piece.x], face_[piece.y], face_[piece.z]);
        mesh_.triangle_material.push_back(material_);
    }
}

Mesh ObjBuilder::finish(Scene& scene) && {
    bool any_texcoord = false, any_normal = false;
    for (const Vertex& v : vertices_) {
        any_texcoord = any_texcoord || v.texcoord >= 0;
        any_normal = any_normal || v.normal >= 0;
    }
    mesh_.positions.reserve(vertices_.size());
    mesh_.uvs.reserve(any_texcoord ? vertices_.size() : 0);
    mesh_.normals.reserve(any_normal ? vertices_.size() : 0);
    for (const Vertex& v : vertices_) {
        mesh_.positions.push_back(positions_[static_cast<std::size_t>(v.position)]);
        if (any_texcoord)
            mesh_.uvs.push_back(v.texcoord < 0 ? glm::vec2(0.0f)
                                               : texcoords_[static_cast<std::size_t>(v.texcoord)]);
        if (any_normal) // a zero normal is replaced by the geometric one in validate()
            mesh_.normals.push_back(v.normal < 0 ? glm::vec3(0.0f)
                                                 : normals_[static_cast<std::size_t>(v.normal)]);
    }
    if (short_faces_ > 0)
        scene.warnings.push_back(std::to_string(short_faces_) +
                                 " faces with fewer than 3 corners are left out");
    if (fans_ > 0)
        scene.warnings.push_back(std::to_string(fans_) + " polygons with more than " +
                                 std::to_string(kMaxEarClipping) +
                                 " corners are split as if convex");
    return std::move(mesh_);
}

void load_material_libraries(const std::string& text, ObjMaterials& materials) {
    constexpr std::string_view kKeyword = "mtllib";
    const std::string_view view = text;
    for (std::size_t at = view.find(kKeyword); at != std::string_view::npos;
         at = view.find(kKeyword, at + kKeyword.size())) {
        const std::size_t after = at + kKeyword.size();
        const std::size_t begin = at == 0 ? 0 : view.find_last_of("\r\n", at - 1) + 1;
        const bool starts_line = trimmed(view.substr(begin, at - begin)).empty();
        const bool is_word = after < view.size() && (view[after] == ' ' || view[after] == '\t');
        if (starts_line && is_word)
            materials.load_libraries(view.substr(after, view.find_first_of("\r\n", after) - after));
    }
}

tinyobj::callback_t callbacks() {
    using tinyobj::real_t;
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* user, real_t x, real_t y, real_t z, real_t) {
        static_cast<ObjBuilder*>(user)->add_position(x, y, z);
    };
    calls.normal_cb = [](void* user, real_t x, real_t y, real_t z) {
        static_cast<ObjBuilder*>(user)->add_normal(x, y, z);
    };
    calls.texcoord_cb = [](void* user, real_t u, real_t v, real_t) {
        static_cast<ObjBuilder*>(user)->add_texcoord(u, v);
    };
    calls.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
        static_cast<ObjBuilder*>(user)->add_face(corners, static_cast<std::size_t>(count));
    };
    calls.usemtl_cb = [](void* user, const char* name, int) {
        static_cast<ObjBuilder*>(user)->use_material(name);
    };
    return calls;
}

} // namespace

Scene load_obj(const std::string& text, const std::filesystem::path& path,
               const LoadOptions& options) {
    Scene scene;
    scene.background = kDefaultSky;
    TextureSet textures(scene, options.textures);
    ObjMaterials materials(scene, textures, path.parent_path(), options.max_input_bytes);
    load_material_libraries(text, materials);
    MemoryBuffer buffer(text);
    std::istream stream(&buffer);
    ObjBuilder builder(buffer, path.string(), materials);
    std::string warning, error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &builder, nullptr, &warning, &error))
        throw SceneError(path.string() + ": " + error);
    Mesh mesh = std::move(builder).finish(scene);
    mesh.name = path.stem().string();
    scene.name = mesh.name;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({0, {}, scene.name});
    return scene;
}

} // namespace macula::scene
