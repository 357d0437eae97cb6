// What every stage is made from: the device, the scene on it, and the size of the frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/cl/device.hpp"
#include "host/frame/blended.hpp"
#include "host/frame/geometry.hpp"
#include "host/frame/graph.hpp"
#include "host/frame/surfaces.hpp"
#include "host/kernel/library.hpp"
#include "host/stage/trace.hpp"
#include "shared/light.h"

namespace macula::stage {

// Secondary rays that one hit can have: a mirrored and a refracted one.
inline constexpr std::uint32_t kRaysOfHit = 2;

struct Kit {
    compute::Device& device;
    kernel::Library& library;
    frame::DeviceGeometry& geometry;
    frame::DeviceSurfaces& surfaces;
    Tracer& tracer;
    std::uint32_t width, height; // pixels that are rendered
    std::vector<shared::Light> lights;
    std::uint32_t ambient_occlusion_samples;
    bool highlights; // some material reflects specularly
    // Rays traced so far, by kernel::RayClass: one 64-bit counter each on the device.
    compute::Buffer ray_totals;
    // Ray slots that a work-item of the shading kernels works on: 1 or 16 (lib/lanes.h).
    std::uint32_t lanes = 1;
    // Pixels of the picture where a method enlarges what it renders; 0: those that are rendered.
    std::uint32_t target_width = 0, target_height = 0;
    // Levels of reflected and refracted rays; 0 also where no material has any.
    std::uint32_t depth = 0;
    // Of the rays that a stage is made for: 0, the primary ones.
    std::uint32_t level = 0;
    // Blended layers that are kept along a ray, and their geometry; 0 where nothing is blended.
    std::uint32_t layers = 0;
    frame::DeviceBlended* blended = nullptr;

    // For the list of the blended layers that lie before the hits of this level's rays.
    bool of_layers = false;

    // Of methods that know on the host how long a frame's list of primary rays can get: at most so
    // many slots, a multiple of kGroup. None: all of them.
    std::shared_ptr<const std::uint32_t> used_slots = {};

    Kit at_level(std::uint32_t of_rays) const;
    // For the list of the blended layers: geometry and surfaces are theirs, rays meet the others.
    Kit at_layers() const;
    // A resource or launch of this level: "hits", "bounce 1 hits", "bounce 1 layer hits".
    std::string named(const std::string& what) const;
    std::string rays() const; // "primary rays", "bounce 1 rays"
    bool primary() const { return level == 0 && !of_layers; }
    // Of the level's list: as many as the order of lib/camera.h has (a multiple of 1024); twice
    // that for secondary rays.
    std::uint32_t slots() const;
    // Slots that this frame's launches cover: slots(), or fewer where used_slots says so. A level's
    // list then has room for twice the rays of the level before it, four times the primary rays.
    std::uint32_t launched() const;
    std::uint64_t pixels() const { return std::uint64_t{width} * height; }
    std::uint32_t picture_width() const { return target_width != 0 ? target_width : width; }
    std::uint32_t picture_height() const { return target_height != 0 ? target_height : height; }
    // A shading kernel for that many lanes; its launch over `count` slots, a multiple of kGroup.
    compute::Kernel lane_kernel(const char* program, const char* entry) const;
    compute::Range lane_items(std::uint32_t count) const { return {count / lanes}; }
    compute::Range lane_group() const;
    // A launch over the strips of an image, whose lanes are neighbours in a row (lib/strip.h).
    compute::Range strips(std::uint32_t of_width, std::uint32_t of_height) const;
};

// The lanes that suit a device: CPUs run sixteen of them in one work-item faster than as sixteen.
std::uint32_t lanes_for(const compute::Device& device);

// Slots of a group of all shading kernels: slots and batches are multiples of it.
inline constexpr std::size_t kGroup = 64;
// Strips of a group, also of several lanes each: those that have nothing to do return at once, and
// starting a group for four of them takes longer than they do.
inline constexpr std::size_t kStripGroup = 64;

// A resource with one entry for each ray slot, or for each pixel.
frame::Resource per_slot(const Kit& kit, const std::string& name, std::uint32_t element_bytes);
// The same for the rays of the kit's level, of that name. Secondary levels take turns in the same
// memory.
frame::Resource of_level(const Kit& kit, const std::string& what, std::uint32_t element_bytes);
// A part of the list of a secondary level's rays: two levels exist at once, in two memories that
// take turns. `per`: entries that share an element.
frame::Resource of_list(const Kit& kit, const std::string& what, std::uint32_t element_bytes,
                        std::uint32_t per = 1);
frame::Resource per_pixel(const Kit& kit, const std::string& name, std::uint32_t element_bytes);

} // namespace macula::stage
