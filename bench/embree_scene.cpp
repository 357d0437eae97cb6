#include "bench/embree_scene.hpp"

#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "bench/embree_impl.hpp"

namespace macula::bench {
namespace {

void throw_on_error(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw std::runtime_error(std::string("Embree: ") + doing + " failed with error " +
                                 std::to_string(error));
}

RTCSceneFlags flags(const EmbreeOptions& options) {
    return options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
}

class Builder {
  public:
    Builder(EmbreeScene::Impl& impl, const EmbreeOptions& options)
        : impl_(impl), scene_(*impl.source), options_(options) {}

    void build() {
        const std::string config =
            "threads=" + std::to_string(impl_.threads) + ",set_affinity=0,start_threads=1";
        impl_.device.reset(rtcNewDevice(config.c_str()));
        if (!impl_.device)
            throw std::runtime_error("Embree: no device (" + config + ")");
        make_masks();
        copy_positions();
        impl_.mesh_scenes.resize(scene_.meshes.size());
        impl_.mesh_geometries.resize(scene_.meshes.size());
        impl_.root = new_scene();
        std::vector<std::uint32_t> uses(scene_.meshes.size());
        for (const scene::Instance& instance : scene_.instances)
            ++uses[instance.mesh];
        for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
            const scene::Instance& instance = scene_.instances[i];
            if (uses[instance.mesh] == 1 && instance.world_from_object.is_identity())
                attach_mesh(impl_.root.get(), impl_.root_geometries, instance.mesh, i);
            else
                attach_instance(i);
        }
        commit(impl_.root.get());
    }

  private:
    SceneHandle new_scene() {
        SceneHandle made(rtcNewScene(impl_.device.get()));
        rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_HIGH);
        rtcSetSceneFlags(made.get(), flags(options_));
        throw_on_error(impl_.device.get(), "making a scene");
        return made;
    }

    void commit(RTCScene scene) {
        const auto start = std::chrono::steady_clock::now();
        rtcCommitScene(scene);
        impl_.build_seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        throw_on_error(impl_.device.get(), "building a scene");
    }

    void make_masks() {
        mask_of_material_.assign(scene_.materials.size(), scene::kNoTexture);
        for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
            if (!is_masked(scene_, scene_.materials[m]))
                continue;
            mask_of_material_[m] = static_cast<std::uint32_t>(impl_.masks.size());
            impl_.masks.push_back(make_mask(scene_, scene_.materials[m]));
        }
    }

    // Embree reads 16 bytes at the last vertex.
    void copy_positions() {
        for (const scene::Mesh& mesh : scene_.meshes) {
            std::vector<float>& copy = impl_.positions.emplace_back(mesh.positions.size() * 3 + 4);
            std::memcpy(copy.data(), mesh.positions.data(), mesh.positions.size() * 12);
        }
    }

    std::uint32_t mask_of(const scene::Mesh& mesh, std::size_t triangle) const {
        return mask_of_material_[mesh.triangle_material[triangle]];
    }

    // The mesh as up to two geometries of `target`: the unmasked triangles and the masked ones.
    void attach_mesh(RTCScene target, EmbreeGeometries& geometries, std::uint32_t mesh_index,
                     std::uint32_t instance) {
        const scene::Mesh& mesh = scene_.meshes[mesh_index];
        auto plain = std::make_unique<EmbreeGeometry>();
        auto masked = std::make_unique<EmbreeGeometry>();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const bool has_mask = mask_of(mesh, t) != scene::kNoTexture;
            (has_mask ? masked : plain)->triangles.push_back(t);
        }
        for (auto* part : {&plain, &masked}) {
            if ((*part)->triangles.empty())
                continue;
            (*part)->mesh = mesh_index;
            (*part)->instance = instance;
            RTCGeometry geometry = new_triangles(**part);
            if (part == &masked)
                set_filter(geometry, **part);
            attach(target, geometry);
            geometries.push_back(std::move(*part));
        }
    }

    RTCGeometry new_triangles(const EmbreeGeometry& part) {
        const scene::Mesh& mesh = scene_.meshes[part.mesh];
        RTCGeometry geometry = rtcNewGeometry(impl_.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   impl_.positions[part.mesh].data(), 0, 12, mesh.positions.size());
        auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, part.triangles.size()));
        throw_on_error(impl_.device.get(), "allocating triangles");
        for (std::size_t i = 0; i < part.triangles.size(); ++i)
            indices[i] = mesh.triangles[part.triangles[i]];
        return geometry;
    }

    void set_filter(RTCGeometry geometry, EmbreeGeometry& part) {
        const scene::Mesh& mesh = scene_.meshes[part.mesh];
        part.masked.masks = &impl_.masks;
        for (const std::uint32_t t : part.triangles) {
            MaskedTriangles::Entry entry{};
            entry.mask = mask_of(mesh, t);
            for (int corner = 0; corner < 3 && !mesh.uvs.empty(); ++corner) {
                const glm::vec2 uv = mesh.uvs[mesh.triangles[t][corner]];
                entry.uv[corner][0] = uv.x;
                entry.uv[corner][1] = uv.y;
            }
            part.masked.entries.push_back(entry);
        }
        rtcSetGeometryUserData(geometry, &part.masked);
        rtcSetGeometryIntersectFilterFunction(geometry, filter_by_mask);
        rtcSetGeometryOccludedFilterFunction(geometry, filter_by_mask);
    }

    void attach_instance(std::uint32_t index) {
        const scene::Instance& instance = scene_.instances[index];
        SceneHandle& child = impl_.mesh_scenes[instance.mesh];
        if (!child) {
            child = new_scene();
            attach_mesh(child.get(), impl_.mesh_geometries[instance.mesh], instance.mesh, index);
            commit(child.get());
        }
        RTCGeometry geometry = rtcNewGeometry(impl_.device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, child.get());
        rtcSetGeometryTimeStepCount(geometry, 1);
        const auto& row = instance.world_from_object.row;
        float matrix[12];
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 4; ++c)
                matrix[4 * r + c] = row[r][c];
        }
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, matrix);
        auto entry = std::make_unique<EmbreeGeometry>();
        entry->mesh = instance.mesh;
        entry->instance = index;
        attach(impl_.root.get(), geometry);
        impl_.root_geometries.push_back(std::move(entry));
    }

    void attach(RTCScene target, RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(target, geometry);
        rtcReleaseGeometry(geometry);
        throw_on_error(impl_.device.get(), "attaching a geometry");
    }

    EmbreeScene::Impl& impl_;
    const scene::Scene& scene_;
    const EmbreeOptions& options_;
    std::vector<std::uint32_t> mask_of_material_;
};

} // namespace

EmbreeScene::EmbreeScene(const scene::Scene& scene, const EmbreeOptions& options)
    : impl_(std::make_unique<Impl>()) {
    impl_->source = &scene;
    const std::uint32_t all = std::max(1U, std::thread::hardware_concurrency());
    impl_->threads = options.threads == 0 ? all : options.threads;
    Builder(*impl_, options).build();
}

EmbreeScene::~EmbreeScene() = default;

const scene::Scene& EmbreeScene::scene() const {
    return *impl_->source;
}
double EmbreeScene::build_seconds() const {
    return impl_->build_seconds;
}
std::uint32_t EmbreeScene::threads() const {
    return impl_->threads;
}

Surface EmbreeScene::surface(std::uint32_t embree_instance, std::uint32_t geometry,
                             std::uint32_t primitive) const {
    if (embree_instance == RTC_INVALID_GEOMETRY_ID) {
        const EmbreeGeometry& g = *impl_->root_geometries[geometry];
        return {g.instance, g.mesh, g.triangles[primitive]};
    }
    const EmbreeGeometry& placed = *impl_->root_geometries[embree_instance];
    const EmbreeGeometry& g = *impl_->mesh_geometries[placed.mesh][geometry];
    return {placed.instance, placed.mesh, g.triangles[primitive]};
}

std::string embree_version() {
    return "Embree " RTC_VERSION_STRING;
}

} // namespace macula::bench
