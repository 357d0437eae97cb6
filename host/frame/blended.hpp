// Blended surfaces: what is translucent without refraction. They are no part of the geometry that
// rays meet, and have trees of their own.
#pragma once

#include <memory>
#include <optional>

#include "host/frame/geometry.hpp"
#include "host/frame/surfaces.hpp"

namespace macula::frame {

// AlphaMode::blend, and neither refracting nor opaque all over.
bool is_blended(const scene::Material& material);

// A scene's triangles in two scenes that have all else in common. Where nothing is opaque, one
// triangle without area stands for it.
struct SplitScene {
    scene::Scene opaque, blended;
};
// Nothing where no triangle is blended.
std::optional<SplitScene> split_blended(const scene::Scene& scene);

// The blended part on a device. Its trees hold each triangle once: no spatial splits.
struct DeviceBlended {
    DeviceBlended(compute::Device& device, const scene::Scene& scene, const DeviceSurfaces& opaque,
                  const GeometryOptions& options);

    DeviceGeometry geometry;
    DeviceSurfaces surfaces;
};

} // namespace macula::frame
