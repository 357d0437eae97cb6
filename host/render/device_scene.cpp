#include "host/render/device_scene.hpp"

#include <algorithm>

namespace macula::render {

DeviceScene::DeviceScene(const compute::Device& on, const scene::Scene& scene,
                         const frame::GeometryOptions& options)
    : DeviceScene(on, scene, options, frame::split_blended(scene)) {}

DeviceScene::DeviceScene(const compute::Device& on, const scene::Scene& scene,
                         const frame::GeometryOptions& options,
                         const std::optional<frame::SplitScene>& split)
    : device(on), geometry(device, split ? split->opaque : scene, options),
      surfaces(device, split ? split->opaque : scene, geometry.parts()),
      blended(
          split ? std::make_unique<frame::DeviceBlended>(device, split->blended, surfaces, options)
                : nullptr),
      mover_(scene) {}

void DeviceScene::set_transforms(std::span<const scene::Transform> world_from_object) {
    transforms_.assign(world_from_object.begin(), world_from_object.end());
    frames_to_place_ = 2;
}

void DeviceScene::begin_frame(std::uint64_t count, std::uint32_t frame,
                              const scene::Observer& observer) {
    // A renderer that lags behind the others may show another frame of a scene that moves.
    if (count <= frames_ && !(mover_.moves() && frame != shown_))
        return;
    if (mover_.moves())
        set_transforms(mover_.at(frame, observer));
    for (int i = 0; i < (forget_motion_ ? 2 : 1) && frames_to_place_ > 0; ++i) {
        place();
        --frames_to_place_;
    }
    forget_motion_ = false;
    frames_ = std::max(frames_, count);
    shown_ = frame;
}

void DeviceScene::place() {
    geometry.set_transforms(transforms_);
    if (blended)
        blended->geometry.set_transforms(transforms_);
}

} // namespace macula::render
