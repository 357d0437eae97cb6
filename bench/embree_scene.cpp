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
        impl_.masks = frame::make_mask_bitmaps(scene_);
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

    // Embree reads 16 bytes at the last vertex.
    void copy_positions() {
        for (const scene::Mesh& mesh : scene_.meshes) {
            std::vector<float>& copy = impl_.positions.emplace_back(mesh.positions.size() * 3 + 4);
            std::memcpy(copy.data(), mesh.positions.data(), mesh.positions.size() * 12);
        }
    }

    bool has_mask(const scene::Mesh& mesh, std::size_t triangle) const {
        return impl_.masks.of_material[mesh.triangle_material[triangle]] != frame::kNoMask;
    }

    // The mesh as up to two geometries of `target`: the unmasked triangles and the masked ones.
    void attach_mesh(RTCScene target, EmbreeGeometries& geometries, std::uint32_t mesh_index,
                     std::uint32_t instance) {
        const scene::Mesh& mesh = scene_.meshes[mesh_index];
        EmbreeGeometry plain, masked;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            (has_mask(mesh, t) ? masked : plain).triangles.push_back(t);
        for (EmbreeGeometry* part : {&plain, &masked}) {
            if (part->triangles.empty())
                continue;
            part->mesh = mesh_index;
            part->instance = instance;
            RTCGeometry geometry = new_triangles(*part);
            if (part == &masked)
                set_filter(geometry, masked);
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
        part.filter =
            std::make_unique<MaskFilter>(impl_.masks, scene_.meshes[part.mesh], part.triangles);
        rtcSetGeometryUserData(geometry, part.filter.get());
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
        attach(impl_.root.get(), geometry);
        EmbreeGeometry& entry = impl_.root_geometries.emplace_back();
        entry.mesh = instance.mesh;
        entry.instance = index;
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
        const EmbreeGeometry& g = impl_->root_geometries[geometry];
        return {g.instance, g.mesh, g.triangles[primitive]};
    }
    const EmbreeGeometry& placed = impl_->root_geometries[embree_instance];
    const EmbreeGeometry& g = impl_->mesh_geometries[placed.mesh][geometry];
    return {placed.instance, placed.mesh, g.triangles[primitive]};
}

std::string embree_version() {
    return "Embree " RTC_VERSION_STRING;
}

} // namespace macula::bench
