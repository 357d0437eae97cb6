// The rays of a set in Embree's own layouts, written before any clock runs, and Embree's calls on
// them. Nothing is copied inside the timed part: Embree reads the rays and leaves the hits in
// place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bench/embree_scene.hpp"
#include "bench/rays.hpp"
#include "bench/run_time.hpp"

namespace macula::bench {

enum class EmbreeCall : std::uint8_t { single, packet8, packet16, stream };
inline constexpr std::array kEmbreeCalls = {EmbreeCall::single, EmbreeCall::packet8,
                                            EmbreeCall::packet16, EmbreeCall::stream};
// "embree1", "embree8", "embree16", "embree_stream".
const char* name(EmbreeCall call);

struct EmbreeHit {
    float t = 0.0f, u = 0.0f, v = 0.0f;
    std::optional<Surface> surface; // nothing: a miss
};

// The rays for one of the calls: rtcIntersect* or rtcOccluded* as the ray class asks.
class EmbreeRays {
  public:
    EmbreeRays(const EmbreeScene& scene, const RaySet& rays, EmbreeCall call);
    ~EmbreeRays();
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;

    // Traces all rays on the scene's threads in chunks of 1024, fetched as they are needed. What
    // the last run left in the rays is undone before, untimed.
    RunTime run();

    // Of the last run. Closest-hit classes.
    EmbreeHit hit(std::uint32_t ray) const;
    // Any-hit classes.
    bool occluded(std::uint32_t ray) const;

    struct Impl;

  private:
    std::unique_ptr<Impl> impl_;
};

} // namespace macula::bench
