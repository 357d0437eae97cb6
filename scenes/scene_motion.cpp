#include "scenes/scene_motion.hpp"

#include <cmath>
#include <map>
#include <set>

#include "scenes/motion_keys.hpp"

namespace macula::scene {
namespace {

constexpr double kMaxPeriod = 1e7;

glm::mat4 matrix_of(const Transform& t) {
    return glm::transpose(glm::mat4(t.row[0], t.row[1], t.row[2], glm::vec4(0, 0, 0, 1)));
}

class MotionReader {
  public:
    explicit MotionReader(Scene& scene) : scene_(scene), motion_(scene.motion) {
        for (const MovedInstance& moved : motion_.instances)
            moving_.insert(moved.instance);
    }

    void read(const TomlTable& table) {
        if (const auto period = table.number("period", 0.0, kMaxPeriod))
            motion_.period = *period;
        const std::vector<TomlTable> nodes = table.tables("node");
        for (const TomlTable& node : nodes)
            read_node(node);
    }

  private:
    void read_node(const TomlTable& table) {
        MotionNode node;
        node.parent = parent_of(table);
        read_keys(table, motion_.period, node);
        const std::optional<glm::vec3> pivot = table.vec3("pivot");
        std::uint32_t last = add(std::move(node));
        if (pivot) {
            shift(motion_.nodes.back(), *pivot);
            MotionNode back;
            back.parent = last;
            back.rest.translation = -*pivot;
            last = add(std::move(back));
        }
        if (const auto name = table.string("name"))
            if (!named_.emplace(*name, last).second)
                table.fail("name", "there is a node '" + *name + "' already");
        for (const std::string& instance : table.strings("instances"))
            carry(table, instance, last);
        table.reject_unknown();
    }

    std::uint32_t add(MotionNode&& node) {
        motion_.nodes.push_back(std::move(node));
        return static_cast<std::uint32_t>(motion_.nodes.size() - 1);
    }

    // Turns and scales about the pivot.
    static void shift(MotionNode& node, const glm::vec3& pivot) {
        node.rest.translation += pivot;
        const bool cubic = node.translation.interpolation == Interpolation::cubic;
        for (std::size_t i = cubic ? 1 : 0; i < node.translation.values.size(); i += cubic ? 3 : 1)
            node.translation.values[i] += pivot;
    }

    std::uint32_t parent_of(const TomlTable& table) const {
        const std::optional<std::string> name = table.string("parent");
        if (!name)
            return kNoNode;
        const auto found = named_.find(*name);
        if (found == named_.end())
            table.fail("parent", "no node before this one is called '" + *name + "'");
        return found->second;
    }

    void carry(const TomlTable& table, const std::string& name, std::uint32_t node) {
        bool any = false;
        for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
            if (scene_.instances[i].name != name)
                continue;
            any = true;
            if (!moving_.insert(i).second)
                table.fail("instances", "'" + name + "' moves already");
            motion_.instances.push_back(
                {i, node, matrix_of(scene_.instances[i].world_from_object)});
        }
        if (!any)
            table.fail("instances", "the scene has no instance '" + name + "'" + known_names());
    }

    // The first few, to help with the spelling.
    std::string known_names() const {
        constexpr std::size_t kMost = 12;
        std::set<std::string> names;
        for (const Instance& instance : scene_.instances)
            if (!instance.name.empty())
                names.insert(instance.name);
        std::string list;
        std::size_t listed = 0;
        for (const std::string& name : names) {
            if (++listed > kMost)
                return "; it has " + list + ", ...";
            list += (list.empty() ? "'" : ", '") + name + "'";
        }
        return list.empty() ? "" : "; it has " + list;
    }

    Scene& scene_;
    Motion& motion_;
    std::map<std::string, std::uint32_t> named_;
    std::set<std::uint32_t> moving_;
};

} // namespace

void read_motion_options(const TomlTable& root, LoadOptions& options) {
    const std::optional<TomlTable> table = root.table("motion");
    if (!table)
        return;
    if (const auto animation = table->string("animation"))
        options.animation = *animation;
    if (const auto rate = table->number("frame_rate", 1.0, 1000.0))
        options.frame_rate = *rate;
    for (const TomlTable& node : table->tables("node"))
        for (const std::string& name : node.strings("instances"))
            options.kept_nodes.push_back(name);
}

void read_motion(const TomlTable& root, Scene& scene) {
    const std::optional<TomlTable> table = root.table("motion");
    if (!table)
        return;
    for (const char* of_gltf : {"animation", "frame_rate"})
        table->has(of_gltf);
    MotionReader(scene).read(*table);
    table->reject_unknown();
}

} // namespace macula::scene
