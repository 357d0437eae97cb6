// Holds the engine's hits against Embree's. The two round differently, so a ray through an edge or
// along a texel's border may end on either side: such disagreements are told from errors by
// evaluating the disputed triangle in double precision.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "bench/embree_mask.hpp"
#include "bench/embree_scene.hpp"

namespace macula::bench {

// Hits of one ray agree in t when they differ by at most this fraction of the greater.
inline constexpr double kRelativeT = 1e-4;
// What rounding to fp32 may do, as a fraction of the greatest coordinate involved: 2^-20, eight
// units in the last place of a 24-bit significand.
inline constexpr double kRounding = 0x1p-20;

struct TestRay {
    glm::dvec3 origin, direction;
    double t_min = 0.0, t_max = 0.0;
};

struct TestHit {
    double t = 0.0;
    std::optional<Surface> surface; // nothing: a miss
};

enum class Verdict : std::uint8_t {
    same,     // both miss, or the same triangle with t within kRelativeT
    tie,      // two triangles that the ray hits, by double precision, at the same t
    rounding, // the disputed triangle is met within kRounding of an edge, of a mask texel's border
              // or of the ray's ends, or t differs by no more than rounding explains
    mismatch, // everything else
};

class Judge {
  public:
    // The scene must outlive the judge.
    explicit Judge(const scene::Scene& scene);

    Verdict closest(const TestRay& ray, const TestHit& ours, const TestHit& theirs) const;

  private:
    struct Meeting;
    Meeting meet(const TestRay& ray, const Surface& surface) const;
    bool near_texel_border(const Surface& surface, const Meeting& meeting) const;

    const scene::Scene& scene_;
    frame::MaskBitmaps masks_;
};

} // namespace macula::bench
