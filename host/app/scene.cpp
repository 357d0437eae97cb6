/// `macula scene`: what a scene holds, what was wrong with its files, and its BVH.
#include "bvh/bvh.hpp"
#include "host/app/command.hpp"
#include "scenes/load.hpp"
#include "scenes/mover.hpp"
#include "scenes/procedural/registry.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>

namespace {

using namespace macula;
using nlohmann::ordered_json;

struct Options {
    std::string scene;
    scene::LoadOptions load;
    bool json = false;
    bool bvh = true;
};

ordered_json to_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

const char* name_of(scene::AlphaMode mode) {
    return mode == scene::AlphaMode::opaque ? "opaque"
           : mode == scene::AlphaMode::mask ? "mask"
                                            : "blend";
}

const char* name_of(scene::LightKind kind) {
    switch (kind) {
    case scene::LightKind::point:
        return "point";
    case scene::LightKind::directional:
        return "directional";
    case scene::LightKind::spherical:
        return "spherical";
    default:
        return "rectangle";
    }
}

const char* name_of(scene::Wrap wrap) {
    return wrap == scene::Wrap::repeat ? "repeat" : wrap == scene::Wrap::clamp ? "clamp" : "mirror";
}

std::uint64_t bytes_of(const scene::Mesh& m) {
    return m.positions.size() * sizeof(m.positions[0]) + m.normals.size() * sizeof(glm::vec3) +
           m.uvs.size() * sizeof(glm::vec2) + m.triangles.size() * sizeof(glm::uvec3) +
           m.triangle_material.size() * sizeof(std::uint32_t);
}

std::uint64_t bytes_of(const scene::Texture& t) {
    std::uint64_t bytes = 0;
    for (const scene::MipLevel& level : t.levels)
        bytes += level.rgba.size();
    return bytes;
}

ordered_json materials_json(const scene::Scene& s) {
    std::vector<std::uint64_t> triangles(s.materials.size());
    for (const scene::Instance& instance : s.instances)
        for (const std::uint32_t material : s.meshes[instance.mesh].triangle_material)
            ++triangles[material];
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < s.materials.size(); ++i) {
        const scene::Material& m = s.materials[i];
        ordered_json textures = ordered_json::object();
        const auto add = [&](const char* use, std::uint32_t index) {
            if (index != scene::kNoTexture)
                textures[use] = s.textures[index].name;
        };
        add("diffuse", m.diffuse_texture);
        add("alpha", m.alpha_texture);
        add("specular", m.specular_texture);
        add("normal", m.normal_texture);
        add("emission", m.emission_texture);
        list.push_back({{"name", m.name},
                        {"triangles", triangles[i]},
                        {"alpha", name_of(m.alpha_mode)},
                        {"diffuse", to_json(m.diffuse)},
                        {"specular", to_json(m.specular)},
                        {"shininess", m.shininess},
                        {"emission", to_json(m.emission)},
                        {"opacity", m.opacity},
                        {"textures", textures}});
    }
    return list;
}

ordered_json textures_json(const scene::Scene& s) {
    ordered_json list = ordered_json::array();
    for (const scene::Texture& t : s.textures)
        list.push_back({{"name", t.name},
                        {"width", t.levels.front().width},
                        {"height", t.levels.front().height},
                        {"levels", t.levels.size()},
                        {"srgb", t.srgb},
                        {"alpha", t.has_alpha},
                        {"wrap", {name_of(t.wrap_u), name_of(t.wrap_v)}},
                        {"bytes", bytes_of(t)}});
    return list;
}

ordered_json lights_json(const scene::Scene& s) {
    ordered_json list = ordered_json::array();
    for (const scene::Light& l : s.lights) {
        ordered_json light{{"kind", name_of(l.kind)}, {"colour", to_json(l.colour)}};
        if (l.kind == scene::LightKind::directional)
            light["direction"] = to_json(l.direction);
        else
            light["position"] = to_json(l.position);
        light["radius"] = l.radius;
        if (l.kind == scene::LightKind::directional)
            light["angle"] = l.angle;
        list.push_back(light);
    }
    return list;
}

ordered_json cameras_json(const scene::Scene& s) {
    ordered_json list = ordered_json::array();
    for (const scene::Camera& c : s.cameras)
        list.push_back({{"name", c.name},
                        {"eye", to_json(c.eye)},
                        {"target", to_json(c.target)},
                        {"vertical_fov_degrees", c.vertical_fov_degrees}});
    return list;
}

std::size_t keys_of(const scene::MotionNode& node) {
    return node.translation.frames.size() + node.rotation.frames.size() + node.scale.frames.size();
}

ordered_json motion_json(const scene::Scene& s) {
    std::size_t keys = 0;
    for (const scene::MotionNode& node : s.motion.nodes)
        keys += keys_of(node);
    ordered_json moving = ordered_json::array();
    for (const std::uint32_t instance : scene::moving_instances(s))
        moving.push_back(s.instances[instance].name);
    return {{"instances", moving},
            {"nodes", s.motion.nodes.size()},
            {"keys", keys},
            {"period", s.motion.period},
            {"spheres", s.physics ? s.physics->spheres.size() : 0}};
}

ordered_json instance_names(const scene::Scene& s) {
    ordered_json names = ordered_json::array();
    for (const scene::Instance& instance : s.instances)
        names.push_back(instance.name);
    return names;
}

/// Builds the SBVH of every mesh; totals over meshes, the cost and the depth of the largest.
ordered_json bvh_json(const scene::Scene& s) {
    std::uint64_t nodes = 0, triangles = 0, largest = 0;
    double references = 0.0, seconds = 0.0, bytes = 0.0, sah = 0.0;
    std::uint32_t depth = 0;
    for (const scene::Mesh& mesh : s.meshes) {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        static_assert(sizeof(glm::uvec3) == sizeof(std::array<std::uint32_t, 3>));
        const bvh::Geometry geometry{
            {&mesh.positions.front().x, mesh.positions.size() * 3},
            {reinterpret_cast<const std::array<std::uint32_t, 3>*>(mesh.triangles.data()),
             mesh.triangles.size()},
            {}};
        const bvh::Statistics one = bvh::statistics(bvh::build(geometry), geometry);
        const auto count = static_cast<double>(mesh.triangles.size());
        nodes += one.nodes;
        triangles += mesh.triangles.size();
        references += one.duplication * count;
        bytes += one.bytes_per_triangle * count;
        seconds += one.build_seconds;
        depth = std::max(depth, one.depth);
        if (mesh.triangles.size() > largest) {
            largest = mesh.triangles.size();
            sah = one.sah;
        }
    }
    return {{"sah", sah},
            {"duplication", references / static_cast<double>(triangles)},
            {"depth", depth},
            {"nodes", nodes},
            {"bytes_per_triangle", bytes / static_cast<double>(triangles)},
            {"build_seconds", seconds}};
}

ordered_json describe(const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    const scene::Scene s = scene::load(options.scene, options.load);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::uint64_t vertices = 0, stored = 0, geometry_bytes = 0, texture_bytes = 0;
    for (const scene::Mesh& mesh : s.meshes) {
        vertices += mesh.positions.size();
        stored += mesh.triangles.size();
        geometry_bytes += bytes_of(mesh);
    }
    for (const scene::Texture& texture : s.textures)
        texture_bytes += bytes_of(texture);
    const scene::Bounds box = s.bounds();
    ordered_json document{
        {"name", s.name},
        {"load_seconds", seconds.count()},
        {"triangles", s.triangle_count()},
        {"stored_triangles", stored},
        {"vertices", vertices},
        {"meshes", s.meshes.size()},
        {"instances", s.instances.size()},
        {"bounds", {{"lo", to_json(box.lo)}, {"hi", to_json(box.hi)}}},
        {"metres_per_unit", s.metres_per_unit},
        {"memory", {{"geometry_bytes", geometry_bytes}, {"texture_bytes", texture_bytes}}},
        {"materials", materials_json(s)},
        {"textures", textures_json(s)},
        {"lights", lights_json(s)},
        {"cameras", cameras_json(s)},
        {"path", {{"keys", s.path.keys.size()}, {"frames", s.path.frames}}}};
    document["instance_names"] = instance_names(s);
    document["motion"] = motion_json(s);
    document["display"] = s.display ? ordered_json(*s.display) : ordered_json();
    document["gaze"] = s.gaze ? ordered_json(*s.gaze) : ordered_json();
    if (options.bvh)
        document["bvh"] = bvh_json(s);
    document["warnings"] = s.warnings;
    return document;
}

std::string triple(const ordered_json& v) {
    return fmt::format("({:g}, {:g}, {:g})", v[0].get<double>(), v[1].get<double>(),
                       v[2].get<double>());
}

double mebibytes(const ordered_json& bytes) {
    return bytes.get<double>() / (1 << 20);
}

void print_list(const ordered_json& d) {
    for (const ordered_json& m : d["materials"]) {
        std::string textures;
        for (const auto& [use, name] : m["textures"].items())
            textures += fmt::format("  {} {}", use, name.get<std::string>());
        fmt::print("  {:<28} {:>9} triangles  {:<6}{}\n", m["name"].get<std::string>(),
                   m["triangles"].get<std::uint64_t>(), m["alpha"].get<std::string>(), textures);
    }
    if (!d["textures"].empty())
        fmt::print("textures\n");
    for (const ordered_json& t : d["textures"])
        fmt::print("  {:<48} {} x {}, {} levels{}\n", t["name"].get<std::string>(),
                   t["width"].get<std::uint32_t>(), t["height"].get<std::uint32_t>(),
                   t["levels"].get<std::size_t>(), t["alpha"].get<bool>() ? ", alpha" : "");
}

/// The first few of a list of names.
std::string few(const ordered_json& names) {
    constexpr std::size_t kMost = 12;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < kMost; ++i)
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i].get<std::string>());
    return text + (names.size() > kMost ? ", ..." : "");
}

void print_motion(const ordered_json& d) {
    fmt::print("instances    {}\n", few(d["instance_names"]));
    const ordered_json& motion = d["motion"];
    if (motion["instances"].empty())
        return;
    fmt::print("moving       {}\n", few(motion["instances"]));
    if (motion["nodes"].get<std::size_t>() > 0)
        fmt::print("motion       {} nodes, {} keys, {}\n", motion["nodes"].get<std::size_t>(),
                   motion["keys"].get<std::size_t>(),
                   motion["period"].get<float>() > 0.0f
                       ? fmt::format("every {:g} frames again", motion["period"].get<float>())
                       : "once");
    if (motion["spheres"].get<std::size_t>() > 0)
        fmt::print("physics      {} spheres\n", motion["spheres"].get<std::size_t>());
}

void print_view(const ordered_json& d) {
    for (const ordered_json& l : d["lights"])
        fmt::print("light        {} at {}, colour {}, radius {:g}\n", l["kind"].get<std::string>(),
                   triple(l.contains("position") ? l["position"] : l["direction"]),
                   triple(l["colour"]), l["radius"].get<double>());
    for (const ordered_json& c : d["cameras"])
        fmt::print("camera       '{}' from {} to {}, {:g} degrees\n", c["name"].get<std::string>(),
                   triple(c["eye"]), triple(c["target"]), c["vertical_fov_degrees"].get<double>());
    if (d["path"]["keys"].get<std::size_t>() > 0)
        fmt::print("camera path  {} keys, {} frames\n", d["path"]["keys"].get<std::size_t>(),
                   d["path"]["frames"].get<std::uint32_t>());
}

void print(const ordered_json& d) {
    fmt::print("scene        {} (loaded in {:.2f} s)\n", d["name"].get<std::string>(),
               d["load_seconds"].get<double>());
    fmt::print("triangles    {} ({} stored), {} vertices, {} meshes, {} instances\n",
               d["triangles"].get<std::uint64_t>(), d["stored_triangles"].get<std::uint64_t>(),
               d["vertices"].get<std::uint64_t>(), d["meshes"].get<std::size_t>(),
               d["instances"].get<std::size_t>());
    fmt::print("bounds       {} .. {}, {:g} m per unit\n", triple(d["bounds"]["lo"]),
               triple(d["bounds"]["hi"]), d["metres_per_unit"].get<double>());
    fmt::print("memory       geometry {:.1f} MiB, textures {:.1f} MiB\n",
               mebibytes(d["memory"]["geometry_bytes"]), mebibytes(d["memory"]["texture_bytes"]));
    if (d.contains("bvh")) {
        const ordered_json& b = d["bvh"];
        fmt::print(
            "bvh          SAH {:.2f}, duplication {:.3f}, depth {}, {} nodes, {:.1f} bytes a "
            "triangle, built in {:.2f} s\n",
            b["sah"].get<double>(), b["duplication"].get<double>(), b["depth"].get<std::uint32_t>(),
            b["nodes"].get<std::uint64_t>(), b["bytes_per_triangle"].get<double>(),
            b["build_seconds"].get<double>());
    }
    print_view(d);
    print_motion(d);
    fmt::print("materials\n");
    print_list(d);
    for (const ordered_json& warning : d["warnings"])
        fmt::print("warning: {}\n", warning.get<std::string>());
}

int list_built_in() {
    fmt::print("Built-in scenes:\n");
    for (const std::string_view name : scene::procedural::names())
        fmt::print("  {}\n", name);
    return 0;
}

int run(const Options& options) {
    if (options.scene.empty())
        return list_built_in();
    const ordered_json document = describe(options);
    if (options.json)
        fmt::print("{}\n", document.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    else
        print(document);
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    command.add_option("scene", options->scene,
                       "A file (.obj, .gltf, .glb, .toml, also .gz or .zst) or a built-in scene; "
                       "without it, the built-in scenes are listed");
    command.add_option("--scene-path", options->load.search_path,
                       "Folders in which scene files look for what they name");
    command.add_option("--seed", options->load.seed, "Seed of a built-in scene");
    command.add_option("--size", options->load.size, "Size of a built-in scene that has one");
    command.add_flag("--json", options->json, "Print one JSON document");
    command.add_flag("!--no-bvh", options->bvh, "Do not build the BVH");
    return [options] { return run(*options); };
}

const app::Command command("scene", "Describe a scene: counts, materials, BVH, warnings", add);

} // namespace
