// Embree's handles behind EmbreeScene; for the .cpp files that call Embree.
#pragma once

#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "bench/embree_mask.hpp"
#include "bench/embree_scene.hpp"

namespace macula::bench {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using SceneHandle = std::unique_ptr<RTCSceneTy, SceneRelease>;

// One Embree geometry: the unmasked or the masked triangles of a mesh, or an instance.
struct EmbreeGeometry {
    std::uint32_t mesh = 0;
    std::uint32_t instance = 0;           // scene instance; of geometries outside instances, too
    std::vector<std::uint32_t> triangles; // Embree's primitive id -> index into Mesh::triangles
    std::unique_ptr<MaskFilter> filter;   // of masked triangles
};
using EmbreeGeometries = std::vector<EmbreeGeometry>; // by geometry id

struct EmbreeScene::Impl {
    const scene::Scene* source = nullptr;
    std::uint32_t threads = 1;
    double build_seconds = 0.0;
    frame::MaskBitmaps masks;
    std::vector<std::vector<float>> positions; // by mesh, padded as Embree asks
    DeviceHandle device;
    std::vector<SceneHandle> mesh_scenes; // by mesh; null where no instance uses it
    std::vector<EmbreeGeometries> mesh_geometries;
    SceneHandle root;
    EmbreeGeometries root_geometries;
};

} // namespace macula::bench
