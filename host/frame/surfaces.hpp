// What shading reads of the scene, on a device: triangle attributes, materials and textures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/cl/device.hpp"
#include "host/frame/geometry.hpp"
#include "scenes/scene.hpp"
#include "shared/surface.h"

namespace macula::frame {

// Textures in the form of lib/texture.h, in host memory: what is uploaded, and what a test filters
// with the same code.
struct TextureData {
    std::vector<shared::ImageTexture> textures;
    std::vector<shared::ImageLevel> levels;
    std::vector<std::uint32_t> texels;
    std::vector<std::uint32_t> slot_of; // scene texture -> index here, or scene::kNoTexture

    // The scene's textures that some material's colour, highlight, glow or normals need (masks are
    // geometry). Throws std::invalid_argument when there are more than 2^32 - 1 texels.
    explicit TextureData(const scene::Scene& scene);
};

// Some material mirrors or refracts.
bool has_optics(const scene::Scene& scene);

// A material's part of the table that secondary rays are made from. No component of what it
// reflects, transmits and scatters sums to more than 1: mirror and transmission are scaled to that,
// then the diffuse colour gives way.
shared::SurfaceOptics make_optics(const scene::Material& material);

// 512 entries: byte / 255, then the linear value of an sRGB byte (IEC 61966-2-1).
std::vector<float> decoding_table();

class DeviceSurfaces {
  public:
    // `parts` are those of the scene's DeviceGeometry. The scene may be destroyed afterwards.
    // `shared_tables`: of another part of the same scene, whose materials and textures are used.
    // Throws the device's error when a buffer does not fit.
    DeviceSurfaces(compute::Device& device, const scene::Scene& scene,
                   std::span<const MeshPart> parts, const DeviceSurfaces* shared_tables = nullptr);

    compute::Buffer triangles, vertices, materials; // SurfaceTriangle, SurfaceVertex, ...
    compute::Buffer optics;                         // SurfaceOptics
    compute::Buffer textures, levels, texels, decode;
};

} // namespace macula::frame
