// glTF 2.0: the node tree is walked once; meshes used by one node are moved to world space and
// joined, meshes that are used by several or that move stay as they are and become instances.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scenes/formats.hpp"
#include "scenes/gltf_animation.hpp"
#include "scenes/gltf_document.hpp"
#include "scenes/gltf_mesh.hpp"

namespace macula::scene {
namespace {

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

glm::dmat4 local_matrix(const tinygltf::Node& node, const GltfDocument& document,
                        const std::string& where) {
    const auto has = [&](const std::vector<double>& values, std::size_t size) {
        if (!values.empty() && (values.size() != size || !all_finite(values)))
            document.fail(where, "its transform is malformed");
        return !values.empty();
    };
    if (has(node.matrix, 16))
        return glm::make_mat4(node.matrix.data());
    glm::dmat4 matrix(1.0);
    if (has(node.rotation, 4)) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        matrix = glm::mat4_cast(glm::length(q) > 0.0 ? glm::normalize(q) : glm::dquat(1, 0, 0, 0));
    }
    if (has(node.scale, 3))
        for (int axis = 0; axis < 3; ++axis)
            matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
    if (has(node.translation, 3))
        matrix[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    return matrix;
}

Transform to_transform(const glm::dmat4& m) {
    Transform transform;
    for (int row = 0; row < 3; ++row)
        transform.row[row] = glm::vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
    return transform;
}

class GltfLoader {
  public:
    GltfLoader(const GltfDocument& document, Scene& scene, const LoadOptions& options)
        : document_(document), model_(document.model()), scene_(scene), options_(options),
          animation_(document, options), textures_(scene, options.textures),
          meshes_(document, scene) {}

    void load();

  private:
    struct Placed {
        int node;
        glm::dmat4 world;
        std::size_t parent = kNoParent;    // index into what walk() returns
        bool moves = false;                // it or a node above it
        std::uint32_t moving = kNoNode;    // its node of Scene::motion
        const std::string* kept = nullptr; // name of itself or of a node above it
    };
    static constexpr std::size_t kNoParent = ~std::size_t{0};
    std::vector<int> roots() const;
    std::vector<Placed> walk() const;
    void check_node(int node) const;
    void add_motion(std::vector<Placed>& nodes);
    void add_mesh(const Placed& placed, bool shared);
    void add_instance(int mesh, const Placed& placed);
    void add_joined();
    void add_camera(const tinygltf::Node& node, const glm::dmat4& world);
    void add_light(const tinygltf::Node& node, const glm::dmat4& world);
    void normalise_lights();

    const GltfDocument& document_;
    const tinygltf::Model& model_;
    Scene& scene_;
    const LoadOptions& options_;
    GltfAnimation animation_;
    TextureSet textures_;
    GltfMeshReader meshes_;
    std::map<int, std::uint32_t> shared_; // glTF mesh -> scene mesh
    std::array<Mesh, 2> joined_;          // without and with normals
};

void GltfLoader::check_node(int node) const {
    if (node < 0 || static_cast<std::size_t>(node) >= model_.nodes.size())
        document_.fail("nodes", "node " + std::to_string(node) + " does not exist");
}

std::vector<int> GltfLoader::roots() const {
    if (!model_.scenes.empty()) {
        const int wanted = model_.defaultScene < 0 ? 0 : model_.defaultScene;
        if (static_cast<std::size_t>(wanted) >= model_.scenes.size())
            document_.fail("scene", "scene " + std::to_string(wanted) + " does not exist");
        return model_.scenes[static_cast<std::size_t>(wanted)].nodes;
    }
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes)
        for (const int child : node.children) {
            check_node(child);
            is_child[static_cast<std::size_t>(child)] = true;
        }
    std::vector<int> result;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i])
            result.push_back(static_cast<int>(i));
    return result;
}

// Every node below the scene's roots with its world matrix, in depth-first order.
std::vector<GltfLoader::Placed> GltfLoader::walk() const {
    std::vector<Placed> stack, placed;
    std::vector<bool> seen(model_.nodes.size());
    const auto push = [&](const std::vector<int>& nodes, Placed above) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            check_node(*node);
            above.node = *node;
            stack.push_back(above);
        }
    };
    push(roots(), {-1, glm::dmat4(1.0)});
    while (!stack.empty()) {
        Placed next = stack.back();
        stack.pop_back();
        const auto index = static_cast<std::size_t>(next.node);
        const std::string where = "node " + std::to_string(next.node);
        if (seen[index])
            document_.fail(where, "is reached twice: the nodes form a cycle or share a child");
        seen[index] = true;
        const tinygltf::Node& node = model_.nodes[index];
        next.world = next.world * local_matrix(node, document_, where);
        next.moves = next.moves || animation_.moves(next.node);
        if (next.kept == nullptr &&
            std::ranges::find(options_.kept_nodes, node.name) != options_.kept_nodes.end())
            next.kept = &node.name;
        placed.push_back(next);
        next.parent = placed.size() - 1;
        push(node.children, next);
    }
    return placed;
}

// Nodes of Scene::motion for those that move and carry a mesh, and for all above them.
void GltfLoader::add_motion(std::vector<Placed>& nodes) {
    std::vector<bool> carries(nodes.size()), wanted(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) { // children come after their parents
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(nodes[i].node)];
        carries[i] = carries[i] || node.mesh >= 0;
        wanted[i] = wanted[i] || (nodes[i].moves && carries[i]);
        if (nodes[i].parent == kNoParent)
            continue;
        carries[nodes[i].parent] = carries[nodes[i].parent] || carries[i];
        wanted[nodes[i].parent] = wanted[nodes[i].parent] || wanted[i];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(nodes[i].node)];
        if (nodes[i].moves && (node.camera >= 0 || node.extensions.contains("KHR_lights_punctual")))
            meshes_.note("cameras and lights do not move with their nodes");
        if (!wanted[i])
            continue;
        nodes[i].moving = static_cast<std::uint32_t>(scene_.motion.nodes.size());
        scene_.motion.nodes.push_back(animation_.node(nodes[i].node));
        if (nodes[i].parent != kNoParent)
            scene_.motion.nodes.back().parent = nodes[nodes[i].parent].moving;
    }
    if (!scene_.motion.nodes.empty())
        scene_.motion.period = animation_.last_frame();
}

void GltfLoader::add_mesh(const Placed& placed, bool shared) {
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(placed.node)];
    if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
        document_.fail("node " + std::to_string(placed.node),
                       "mesh " + std::to_string(node.mesh) + " does not exist");
    if (shared || placed.moves || placed.kept != nullptr)
        add_instance(node.mesh, placed);
    else
        for (const GltfPrimitive& primitive : meshes_.read(node.mesh))
            append(joined_[primitive.normals.empty() ? 0 : 1], primitive, placed.world);
}

void GltfLoader::add_instance(int mesh, const Placed& placed) {
    const auto next = static_cast<std::uint32_t>(scene_.meshes.size());
    const auto [entry, is_new] = shared_.emplace(mesh, next);
    if (is_new) {
        Mesh joined;
        joined.name = model_.meshes[static_cast<std::size_t>(mesh)].name;
        const std::vector<GltfPrimitive> parts = meshes_.read(mesh);
        const bool any_normals = std::any_of(
            parts.begin(), parts.end(), [](const GltfPrimitive& p) { return !p.normals.empty(); });
        for (const GltfPrimitive& part : parts) {
            append(joined, part, glm::dmat4(1.0));
            if (any_normals) // zero normals become geometric ones in validate()
                joined.normals.resize(joined.positions.size(), glm::vec3(0.0f));
        }
        scene_.meshes.push_back(std::move(joined));
    }
    if (placed.moves) {
        MovedInstance& moved = scene_.motion.instances.emplace_back();
        moved.instance = static_cast<std::uint32_t>(scene_.instances.size());
        moved.node = placed.moving;
    }
    const std::string& own = model_.nodes[static_cast<std::size_t>(placed.node)].name;
    const std::string& name = placed.kept != nullptr ? *placed.kept
                              : own.empty()          ? scene_.meshes[entry->second].name
                                                     : own;
    scene_.instances.push_back({entry->second, to_transform(placed.world), name});
}

void GltfLoader::add_joined() {
    for (std::size_t i = 0; i < joined_.size(); ++i) {
        if (joined_[i].triangles.empty())
            continue;
        joined_[i].name = i == 0 ? "static, no normals" : "static";
        scene_.instances.push_back(
            {static_cast<std::uint32_t>(scene_.meshes.size()), {}, joined_[i].name});
        scene_.meshes.push_back(std::move(joined_[i]));
    }
}

void GltfLoader::add_camera(const tinygltf::Node& node, const glm::dmat4& world) {
    if (static_cast<std::size_t>(node.camera) >= model_.cameras.size())
        document_.fail("nodes", "camera " + std::to_string(node.camera) + " does not exist");
    const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(node.camera)];
    const glm::dvec3 back(world[2]);
    if (source.type != "perspective" || !(glm::length(back) > 0.0)) {
        meshes_.note("cameras that are not perspective are left out");
        return;
    }
    Camera camera;
    camera.name = source.name.empty() ? node.name : source.name;
    camera.eye = glm::vec3(world[3]);
    camera.target = camera.eye - glm::vec3(glm::normalize(back));
    camera.up = glm::vec3(world[1]);
    camera.vertical_fov_degrees =
        std::clamp(static_cast<float>(glm::degrees(source.perspective.yfov)), 1.0f, 170.0f);
    scene_.cameras.push_back(camera);
}

void GltfLoader::add_light(const tinygltf::Node& node, const glm::dmat4& world) {
    const tinygltf::Value& reference = node.extensions.at("KHR_lights_punctual");
    if (!reference.IsObject() || !reference.Get("light").IsInt())
        return;
    const int index = reference.Get("light").GetNumberAsInt();
    if (index < 0 || static_cast<std::size_t>(index) >= model_.lights.size())
        document_.fail("nodes", "light " + std::to_string(index) + " does not exist");
    const tinygltf::Light& source = model_.lights[static_cast<std::size_t>(index)];
    Light light;
    for (int c = 0; c < 3 && source.color.size() == 3; ++c)
        light.colour[c] = static_cast<float>(source.color[static_cast<std::size_t>(c)]);
    light.colour *= static_cast<float>(source.intensity);
    light.position = glm::vec3(world[3]);
    if (source.type == "directional") {
        light.kind = LightKind::directional;
        light.direction = -glm::vec3(world[2]);
    } else {
        light.attenuation_distance = 1.0f;
        if (source.type == "spot")
            meshes_.note("spot lights shine in all directions");
    }
    scene_.lights.push_back(light);
}

// glTF's lights are in lux and candela and expect an exposure, which nothing in the file gives.
// Only their ratios are kept: together they give an irradiance of 1 at a quarter of the diagonal.
void GltfLoader::normalise_lights() {
    if (scene_.lights.empty())
        return;
    const float reach = std::max(0.25f * scene_.bounds().diagonal(), 1e-6f);
    float total = 0.0f;
    for (const Light& light : scene_.lights) {
        const float brightest = std::max({light.colour.r, light.colour.g, light.colour.b});
        total += light.kind == LightKind::directional ? brightest : brightest / (reach * reach);
    }
    for (Light& light : scene_.lights)
        if (total > 0.0f)
            light.colour /= total;
}

void GltfLoader::load() {
    scene_.warnings = document_.warnings();
    scene_.materials = gltf_materials(document_, textures_, scene_);
    std::vector<Placed> nodes = walk();
    add_motion(nodes);
    std::map<int, int> uses;
    for (const Placed& placed : nodes)
        ++uses[model_.nodes[static_cast<std::size_t>(placed.node)].mesh];
    for (const Placed& placed : nodes) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(placed.node)];
        if (node.mesh >= 0)
            add_mesh(placed, uses[node.mesh] > 1);
        if (node.camera >= 0)
            add_camera(node, placed.world);
        if (node.extensions.contains("KHR_lights_punctual"))
            add_light(node, placed.world);
    }
    add_joined();
    normalise_lights();
    if (animation_.left_out() > 0)
        scene_.warnings.push_back(std::to_string(animation_.left_out()) +
                                  " animations are left out");
    if (animation_.has_weights())
        meshes_.note("animations of morph targets are ignored");
    meshes_.report();
}

} // namespace

Scene load_gltf(const std::string& bytes, const std::filesystem::path& path, bool binary,
                const LoadOptions& options) {
    const GltfDocument document(bytes, path, binary, options.max_input_bytes);
    Scene scene;
    scene.name = path.stem().string();
    scene.background = kDefaultSky;
    GltfLoader(document, scene, options).load();
    return scene;
}

} // namespace macula::scene
