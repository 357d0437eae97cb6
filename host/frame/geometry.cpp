#include "host/frame/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "host/frame/geometry_masks.hpp"
#include "host/frame/geometry_plan.hpp"

namespace macula::frame {
namespace {

struct Trees {
    std::vector<bvh::Tree> of_mesh;
    double build_seconds = 0.0;
    bool from_cache = true;
    std::vector<std::string> notes;
};

Trees build_trees(const std::vector<PlannedMesh>& meshes, const GeometryOptions& options) {
    Trees trees;
    for (const PlannedMesh& mesh : meshes) {
        bvh::CacheResult result;
        if (options.cache_directory.empty())
            result.tree = bvh::build(mesh.geometry(), options.build);
        else
            result = bvh::build_cached(mesh.geometry(), options.build, options.cache_directory);
        trees.build_seconds += result.tree.build_seconds;
        trees.from_cache = trees.from_cache && result.from_cache;
        if (!result.note.empty())
            trees.notes.push_back(std::move(result.note));
        trees.of_mesh.push_back(std::move(result.tree));
    }
    return trees;
}

// All meshes in one layout, one after another.
std::vector<bvh::LaidOut> lay_out_all(const std::vector<PlannedMesh>& meshes, const Trees& trees,
                                      bvh::Layout layout) {
    std::vector<bvh::LaidOut> all;
    std::uint32_t nodes = 0, triangles = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        bvh::LaidOut mesh = bvh::lay_out(trees.of_mesh[i], meshes[i].geometry(), layout);
        bvh::rebase(mesh, nodes, triangles);
        nodes += mesh.node_count;
        triangles += mesh.triangle_entries;
        all.push_back(std::move(mesh));
    }
    return all;
}

compute::Buffer upload_parts(const compute::Device& device, const std::vector<bvh::LaidOut>& meshes,
                             std::vector<std::byte> bvh::LaidOut::*bytes, const std::string& what) {
    std::uint64_t size = 0;
    for (const bvh::LaidOut& mesh : meshes)
        size += (mesh.*bytes).size();
    compute::Buffer buffer = device.allocate(size, what);
    std::uint64_t offset = 0;
    for (const bvh::LaidOut& mesh : meshes) {
        buffer.write(std::span(mesh.*bytes), offset);
        offset += (mesh.*bytes).size();
    }
    return buffer;
}

template <typename T>
void append_as(std::vector<T>& to, const std::vector<std::byte>& bytes) {
    const std::size_t first = to.size();
    to.resize(first + bytes.size() / sizeof(T));
    if (!bytes.empty())
        std::memcpy(to.data() + first, bytes.data(), bytes.size());
}

std::vector<shared::Instance> with_roots(std::vector<shared::Instance> instances,
                                         const std::vector<int>& roots) {
    for (shared::Instance& instance : instances)
        instance.root = roots[instance.mesh];
    return instances;
}

std::vector<int> roots_of(const std::vector<bvh::LaidOut>& meshes) {
    std::vector<int> roots;
    for (const bvh::LaidOut& mesh : meshes)
        roots.push_back(mesh.root);
    return roots;
}

bvh::Box box_of(const bvh::Tree& tree) {
    constexpr float e = MACULA_EMPTY;
    return tree.nodes.empty() ? bvh::Box{{e, e, e}, {-e, -e, -e}} : tree.nodes[0].box;
}

bool equal_rows(const float (&a)[3][4], const float (&b)[3][4]) {
    return std::equal(&a[0][0], &a[0][0] + 12, &b[0][0]);
}

struct OnDevice {
    LayoutBuffers buffers;
    LayoutStatistics statistics;
    std::vector<int> roots; // of the meshes
};

struct ReferenceArrays {
    std::vector<shared::BinaryNode> nodes;
    std::vector<shared::Triangle> triangles;
    std::vector<int> roots;
    std::vector<shared::Instance> instances;
};

} // namespace

struct DeviceGeometry::Impl {
    compute::Device device;
    bvh::BuildOptions build_options;
    MaskBitmaps bitmaps;
    GeometryPlan plan;
    MaskTriangles mask_triangles;
    Trees trees;
    std::vector<shared::BinaryNode> upper;
    compute::Buffer upper_buffer;
    MaskBuffers mask_buffers;
    std::array<std::optional<OnDevice>, bvh::kLayouts.size()> layouts;
    std::optional<ReferenceArrays> reference;
    std::optional<GeometryStatistics> statistics;

    Impl(compute::Device& on, const scene::Scene& scene, const GeometryOptions& options)
        : device(on), build_options(options.build), bitmaps(make_mask_bitmaps(scene)),
          plan(plan_geometry(scene, bitmaps.masked_materials(), options.merge_static)),
          mask_triangles(make_mask_triangles(scene, plan.parts, bitmaps)),
          trees(build_trees(plan.meshes, options)) {
        for (shared::Instance& instance : plan.instances)
            bvh::place(instance, box_of(trees.of_mesh[instance.mesh]));
        upper = bvh::build_upper(plan.instances);
        upper_buffer = device.upload(std::span(upper), "upper level of the BVH");
        if (!mask_triangles.triangles.empty())
            upload_masks();
    }

    void upload_masks() {
        mask_buffers.slots = device.upload(std::span(mask_triangles.slots), "alpha mask slots");
        mask_buffers.triangles =
            device.upload(std::span(mask_triangles.triangles), "alpha mask triangles");
        mask_buffers.textures = device.upload(std::span(bitmaps.textures), "alpha mask textures");
        mask_buffers.words = device.upload(std::span(bitmaps.words), "alpha mask bits");
    }

    OnDevice upload_layout(bvh::Layout layout) const {
        const std::vector<bvh::LaidOut> meshes = lay_out_all(plan.meshes, trees, layout);
        const std::string of_layout = std::string(" of BVH layout ") + bvh::name(layout);
        OnDevice result;
        result.roots = roots_of(meshes);
        result.buffers.nodes =
            upload_parts(device, meshes, &bvh::LaidOut::nodes, "nodes" + of_layout);
        result.buffers.triangles =
            upload_parts(device, meshes, &bvh::LaidOut::triangles, "triangles" + of_layout);
        const std::vector<shared::Instance> instances = with_roots(plan.instances, result.roots);
        result.buffers.instances = device.upload(std::span(instances), "instances" + of_layout);
        result.statistics = {layout, result.buffers.nodes.size(), result.buffers.triangles.size()};
        return result;
    }

    // The upper level of one tree may have another number of nodes than that of the last frame.
    void upload_placement() {
        upper = bvh::build_upper(plan.instances);
        if (upper.size() * sizeof(shared::BinaryNode) > upper_buffer.size())
            upper_buffer = device.upload(std::span(upper), "upper level of the BVH");
        else
            upper_buffer.write(std::span(upper));
        for (std::optional<OnDevice>& layout : layouts) {
            if (layout)
                layout->buffers.instances.write(
                    std::span<const shared::Instance>(with_roots(plan.instances, layout->roots)));
        }
        if (reference)
            reference->instances = with_roots(plan.instances, reference->roots);
    }

    ReferenceArrays make_reference() const {
        ReferenceArrays arrays;
        const std::vector<bvh::LaidOut> meshes =
            lay_out_all(plan.meshes, trees, bvh::Layout::binary);
        for (const bvh::LaidOut& mesh : meshes) {
            append_as(arrays.nodes, mesh.nodes);
            append_as(arrays.triangles, mesh.triangles);
        }
        arrays.roots = roots_of(meshes);
        arrays.instances = with_roots(plan.instances, arrays.roots);
        return arrays;
    }

    GeometryStatistics gather() const {
        GeometryStatistics result;
        result.meshes = static_cast<std::uint32_t>(plan.meshes.size());
        result.instances = static_cast<std::uint32_t>(plan.instances.size());
        result.triangles = plan.triangle_ids;
        result.masked_triangles = static_cast<std::uint32_t>(mask_triangles.triangles.size());
        result.build_seconds = trees.build_seconds;
        result.from_cache = trees.from_cache;
        result.notes = trees.notes;
        double references = 0.0;
        for (std::size_t i = 0; i < plan.meshes.size(); ++i) {
            const bvh::Statistics tree =
                bvh::statistics(trees.of_mesh[i], plan.meshes[i].geometry(), build_options);
            const auto triangles = static_cast<double>(plan.meshes[i].triangles.size());
            result.mesh_triangles += plan.meshes[i].triangles.size();
            result.sah += tree.sah * triangles;
            references += tree.duplication * triangles;
            result.depth = std::max(result.depth, tree.depth);
        }
        result.sah /= static_cast<double>(result.mesh_triangles);
        result.duplication = references / static_cast<double>(result.mesh_triangles);
        return result;
    }
};

DeviceGeometry::DeviceGeometry(compute::Device& device, const scene::Scene& scene,
                               const GeometryOptions& options)
    : impl_(std::make_unique<Impl>(device, scene, options)) {}

DeviceGeometry::~DeviceGeometry() = default;

bool DeviceGeometry::instanced() const {
    return impl_->plan.instances.size() != 1 || impl_->plan.instances[0].identity == 0;
}

bool DeviceGeometry::masked() const {
    return !impl_->mask_triangles.triangles.empty();
}

const LayoutBuffers& DeviceGeometry::layout(bvh::Layout layout) {
    std::optional<OnDevice>& found = impl_->layouts[static_cast<std::size_t>(layout)];
    if (!found)
        found = impl_->upload_layout(layout);
    return found->buffers;
}

const compute::Buffer& DeviceGeometry::upper_nodes() const {
    return impl_->upper_buffer;
}

const MaskBuffers& DeviceGeometry::masks() const {
    return impl_->mask_buffers;
}

void DeviceGeometry::set_transforms(std::span<const scene::Transform> world_from_object) {
    const GeometryPlan& plan = impl_->plan;
    if (world_from_object.size() != plan.device_instance.size())
        throw std::invalid_argument("scene geometry: " + std::to_string(world_from_object.size()) +
                                    " transforms for " +
                                    std::to_string(plan.device_instance.size()) + " instances");
    std::vector<shared::Instance> moved = plan.instances;
    bool changed = false;
    for (std::size_t i = 0; i < world_from_object.size(); ++i) {
        const std::uint32_t device_instance = plan.device_instance[i];
        if (plan.scene_instance[device_instance] == kMerged) {
            if (!world_from_object[i].is_identity())
                throw std::invalid_argument("scene geometry: instance " + std::to_string(i) +
                                            " moves, but was merged with others "
                                            "(GeometryOptions::merge_static)");
            continue;
        }
        shared::Instance& instance = moved[device_instance];
        const shared::Instance& now = plan.instances[device_instance];
        std::memcpy(instance.previous_world_from_object, now.world_from_object,
                    sizeof now.world_from_object);
        set_rows(instance.world_from_object, world_from_object[i]);
        bvh::place(instance, box_of(impl_->trees.of_mesh[instance.mesh]));
        changed = changed || !equal_rows(instance.world_from_object, now.world_from_object) ||
                  !equal_rows(instance.previous_world_from_object, now.previous_world_from_object);
    }
    if (!changed)
        return;
    impl_->plan.instances = std::move(moved);
    impl_->upload_placement();
}

std::span<const shared::Instance> DeviceGeometry::instances() const {
    return impl_->plan.instances;
}

std::span<const MeshPart> DeviceGeometry::parts() const {
    return impl_->plan.parts;
}

TriangleOrigin DeviceGeometry::origin_of(std::uint32_t triangle_id) const {
    const GeometryPlan& plan = impl_->plan;
    if (triangle_id >= plan.triangle_ids)
        throw std::out_of_range("scene geometry: triangle id " + std::to_string(triangle_id) +
                                " of " + std::to_string(plan.triangle_ids));
    // The last that starts at or before the id: empty ones before it start there too.
    const auto instance = std::ranges::upper_bound(plan.instances, triangle_id, {},
                                                   &shared::Instance::first_triangle) -
                          1;
    TriangleOrigin origin;
    origin.device_instance = static_cast<std::uint32_t>(instance - plan.instances.begin());
    origin.entry = instance->mesh_triangle + (triangle_id - instance->first_triangle);
    const auto part =
        std::ranges::upper_bound(plan.parts, origin.entry, {}, &MeshPart::first_entry) - 1;
    origin.mesh = part->mesh;
    origin.triangle = origin.entry - part->first_entry;
    const std::uint32_t scene_instance = plan.scene_instance[origin.device_instance];
    origin.instance = scene_instance == kMerged ? part->instance : scene_instance;
    origin.material = plan.materials[origin.entry];
    return origin;
}

bvh::ReferenceScene DeviceGeometry::reference() {
    if (!impl_->reference)
        impl_->reference = impl_->make_reference();
    const ReferenceArrays& arrays = *impl_->reference;
    const MaskTriangles& masks = impl_->mask_triangles;
    return {arrays.nodes,
            arrays.triangles,
            arrays.instances,
            impl_->upper,
            {masks.slots.data(), masks.triangles.data(), impl_->bitmaps.textures.data(),
             impl_->bitmaps.words.data()}};
}

const GeometryStatistics& DeviceGeometry::statistics() {
    if (!impl_->statistics)
        impl_->statistics = impl_->gather();
    return *impl_->statistics;
}

std::vector<LayoutStatistics> DeviceGeometry::layout_statistics() const {
    std::vector<LayoutStatistics> result;
    for (const std::optional<OnDevice>& layout : impl_->layouts) {
        if (layout)
            result.push_back(layout->statistics);
    }
    return result;
}

} // namespace macula::frame
