// A scene as Embree 3 traces it: the yardstick of the benchmark and the oracle of the tests. Built
// as the engine builds it: meshes placed once and unmoved lie in one tree, the others are
// instances, and alpha masks are tested in the traversal, on masked triangles only.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "scenes/scene.hpp"

namespace macula::bench {

// A triangle of a scene, whatever engine found it.
struct Surface {
    std::uint32_t instance = 0; // index into Scene::instances
    std::uint32_t mesh = 0;     // index into Scene::meshes
    std::uint32_t triangle = 0; // index into Mesh::triangles
    bool operator==(const Surface&) const = default;
};

struct EmbreeOptions {
    std::uint32_t threads = 0; // of building and tracing; 0: all
    bool robust = false;       // Embree's watertight intersector (slower): for the oracle
};

class EmbreeScene {
  public:
    // Builds at RTC_BUILD_QUALITY_HIGH. `scene` must outlive this object, which shares its
    // vertices. Throws std::runtime_error with Embree's message.
    explicit EmbreeScene(const scene::Scene& scene, const EmbreeOptions& options = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    const scene::Scene& scene() const;
    double build_seconds() const; // of the trees alone
    std::uint32_t threads() const;

    // What Embree's ids of a hit stand for; `embree_instance` is RTC_INVALID_GEOMETRY_ID outside
    // instances.
    Surface surface(std::uint32_t embree_instance, std::uint32_t geometry,
                    std::uint32_t primitive) const;

    struct Impl;
    Impl& impl() const { return *impl_; } // for the calls of embree_rays.cpp

  private:
    std::unique_ptr<Impl> impl_;
};

// "Embree 3.13.5".
std::string embree_version();

} // namespace macula::bench
