// A scene on a device, for one renderer or for several: both eyes of a head see the same geometry,
// and each has a history of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "host/cl/device.hpp"
#include "host/frame/blended.hpp"
#include "host/frame/geometry.hpp"
#include "host/frame/surfaces.hpp"
#include "host/kernel/library.hpp"
#include "scenes/mover.hpp"
#include "scenes/scene.hpp"

namespace macula::render {

class DeviceScene {
  public:
    // The scene must have passed validate(); it may be destroyed afterwards. Throws as
    // frame::DeviceGeometry and frame::DeviceSurfaces do.
    DeviceScene(const compute::Device& device, const scene::Scene& scene,
                const frame::GeometryOptions& options = {});
    DeviceScene(const DeviceScene&) = delete;
    DeviceScene& operator=(const DeviceScene&) = delete;

    // As Renderer::set_transforms, for all its renderers.
    void set_transforms(std::span<const scene::Transform> world_from_object);

    // Of the renderers: frames begun by the one that has begun most.
    std::uint64_t frames() const { return frames_; }
    // A renderer begins its frame number `count` (1 is the first), which shows the scene's frame
    // `frame`. Whoever comes first moves what is to be moved; the others then see the same frame.
    void begin_frame(std::uint64_t count, std::uint32_t frame, const scene::Observer& observer);

    // What moves in the next frame has no motion in it, as in the first one. For all renderers:
    // views that share a scene begin anew together.
    void forget_motion() { forget_motion_ = true; }

    compute::Device device;
    kernel::Library library;
    frame::DeviceGeometry geometry; // without the blended triangles
    frame::DeviceSurfaces surfaces;
    std::unique_ptr<frame::DeviceBlended> blended; // null where nothing is blended

  private:
    DeviceScene(const compute::Device& device, const scene::Scene& scene,
                const frame::GeometryOptions& options,
                const std::optional<frame::SplitScene>& split);

    void place();

    std::uint64_t frames_ = 0;
    std::uint32_t shown_ = 0; // the scene's frame in which things stand
    scene::Mover mover_;
    std::vector<scene::Transform> transforms_;
    // Frames for which the transforms must still be set: the one in which something moved, and the
    // one after it, whose last frame's transforms are then its own.
    int frames_to_place_ = 0;
    bool forget_motion_ = true; // there is no last frame
};

} // namespace macula::render
