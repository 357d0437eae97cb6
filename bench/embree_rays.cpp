#include "bench/embree_rays.hpp"

#include <algorithm>
#include <span>
#include <type_traits>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include "bench/embree_impl.hpp"

namespace macula::bench {
namespace {

constexpr std::uint32_t kChunk = 1024; // rays a task, and rays a stream call

// Flush-to-zero and denormals-are-zero, as Embree asks of its callers; undone afterwards, since
// the rest of the program computes by the identity contract.
class FlushDenormals {
  public:
    FlushDenormals() : saved_(_mm_getcsr()) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() { _mm_setcsr(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned saved_;
};

// Embree reads the lanes' validity from memory aligned as the packet.
template <std::uint32_t W>
struct alignas(4 * W) Valid {
    int lane[W];
};

// The calls on an array of Embree's ray structs (Group: RTCRay.. for any hit, RTCRayHit.. else).
template <class G, bool Any, auto Call>
struct Singles {
    using Group = G;
    static constexpr std::uint32_t kWidth = 1;
    static constexpr bool kAnyHit = Any;
    static void trace(RTCScene scene, RTCIntersectContext* context, std::span<G> groups,
                      const Valid<1>*) {
        for (G& group : groups)
            Call(scene, context, &group);
    }
};

template <class G, bool Any, auto Call>
struct Streams : Singles<G, Any, nullptr> {
    static void trace(RTCScene scene, RTCIntersectContext* context, std::span<G> groups,
                      const Valid<1>*) {
        Call(scene, context, groups.data(), static_cast<unsigned>(groups.size()), sizeof(G));
    }
};

template <class G, std::uint32_t Width, bool Any, auto Call>
struct Packets {
    using Group = G;
    static constexpr std::uint32_t kWidth = Width;
    static constexpr bool kAnyHit = Any;
    static void trace(RTCScene scene, RTCIntersectContext* context, std::span<G> groups,
                      const Valid<Width>* valid) {
        for (std::size_t i = 0; i < groups.size(); ++i)
            Call(valid[i].lane, scene, context, &groups[i]);
    }
};

using Occluded1 = Singles<RTCRay, true, rtcOccluded1>;
using Occluded8 = Packets<RTCRay8, 8, true, rtcOccluded8>;
using Occluded16 = Packets<RTCRay16, 16, true, rtcOccluded16>;
using OccludedStream = Streams<RTCRay, true, rtcOccluded1M>;
using Intersect1 = Singles<RTCRayHit, false, rtcIntersect1>;
using Intersect8 = Packets<RTCRayHit8, 8, false, rtcIntersect8>;
using Intersect16 = Packets<RTCRayHit16, 16, false, rtcIntersect16>;
using IntersectStream = Streams<RTCRayHit, false, rtcIntersect1M>;

template <class G>
auto& ray_of(G& group) {
    if constexpr (requires { group.ray; })
        return (group.ray);
    else
        return group;
}

// A member of a ray or hit struct at a lane, whether the struct is of one ray or a packet.
template <class T>
T& at(T& scalar, std::uint32_t) {
    return scalar;
}
template <class T, std::size_t N>
T& at(T (&lanes)[N], std::uint32_t lane) {
    return lanes[lane];
}

} // namespace

struct EmbreeRays::Impl {
    Impl(const EmbreeScene& scene, const RaySet& rays) : scene_(scene), rays_(rays) {}
    virtual ~Impl() = default;
    virtual RunTime run() = 0;
    virtual EmbreeHit hit(std::uint32_t ray) = 0;
    virtual bool occluded(std::uint32_t ray) = 0;

    const EmbreeScene& scene_;
    const RaySet& rays_;
};

namespace {

template <class Layout>
class Laid : public EmbreeRays::Impl {
  public:
    Laid(const EmbreeScene& scene, const RaySet& rays)
        : Impl(scene, rays), groups_((rays.count + kWidth - 1) / kWidth), valid_(groups_.size()) {
        for (std::uint32_t i = 0; i < groups_.size() * kWidth; ++i)
            place(i);
    }

    RunTime run() override {
        reset();
        tbb::task_arena arena(static_cast<int>(scene_.threads()));
        const std::size_t grain = kChunk / kWidth;
        const std::size_t chunks = (groups_.size() + grain - 1) / grain;
        const Stopwatch watch;
        arena.execute([&] {
            tbb::parallel_for(
                tbb::blocked_range<std::size_t>(0, chunks, 1),
                [&](const tbb::blocked_range<std::size_t>& range) {
                    for (std::size_t c = range.begin(); c != range.end(); ++c)
                        trace(c * grain, std::min(groups_.size(), (c + 1) * grain));
                },
                tbb::simple_partitioner());
        });
        return watch.elapsed();
    }

    EmbreeHit hit(std::uint32_t i) override {
        EmbreeHit result;
        if constexpr (!Layout::kAnyHit) {
            auto& group = groups_[i / kWidth];
            const std::uint32_t lane = i % kWidth;
            result.t = at(group.ray.tfar, lane);
            const std::uint32_t geometry = at(group.hit.geomID, lane);
            if (geometry != RTC_INVALID_GEOMETRY_ID) {
                result.u = at(group.hit.u, lane);
                result.v = at(group.hit.v, lane);
                result.surface = scene_.surface(at(group.hit.instID[0], lane), geometry,
                                                at(group.hit.primID, lane));
            }
        }
        return result;
    }

    // Embree marks an occluded ray by tfar = -infinity.
    bool occluded(std::uint32_t i) override {
        return at(ray_of(groups_[i / kWidth]).tfar, i % kWidth) < 0.0f;
    }

  private:
    static constexpr std::uint32_t kWidth = Layout::kWidth;

    void place(std::uint32_t i) {
        const std::uint32_t lane = i % kWidth;
        const bool used = i < rays_.count;
        auto& ray = ray_of(groups_[i / kWidth]);
        const glm::vec3 o = used ? rays_.origin(i) : glm::vec3(0.0f);
        const glm::vec3 d = used ? rays_.direction(i) : glm::vec3(1.0f);
        at(ray.org_x, lane) = o.x;
        at(ray.org_y, lane) = o.y;
        at(ray.org_z, lane) = o.z;
        at(ray.dir_x, lane) = d.x;
        at(ray.dir_y, lane) = d.y;
        at(ray.dir_z, lane) = d.z;
        at(ray.tnear, lane) = used ? rays_.t_min(i) : 0.0f;
        at(ray.time, lane) = 0.0f;
        at(ray.mask, lane) = ~0U;
        at(ray.id, lane) = i;
        at(ray.flags, lane) = 0;
        valid_[i / kWidth].lane[lane] = used ? -1 : 0;
    }

    void reset() {
        for (std::uint32_t i = 0; i < groups_.size() * kWidth; ++i) {
            const std::uint32_t lane = i % kWidth;
            auto& group = groups_[i / kWidth];
            at(ray_of(group).tfar, lane) = i < rays_.count ? rays_.t_max(i) : 0.0f;
            if constexpr (!Layout::kAnyHit) {
                at(group.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
                at(group.hit.primID, lane) = RTC_INVALID_GEOMETRY_ID;
                at(group.hit.instID[0], lane) = RTC_INVALID_GEOMETRY_ID;
            }
        }
    }

    void trace(std::size_t first, std::size_t last) {
        const FlushDenormals flush;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = is_coherent(rays_.ray_class) ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        Layout::trace(scene_.impl().root.get(), &context,
                      std::span(groups_).subspan(first, last - first), valid_.data() + first);
    }

    std::vector<typename Layout::Group> groups_;
    std::vector<Valid<kWidth>> valid_; // -1 where a lane holds a ray
};

std::unique_ptr<EmbreeRays::Impl> lay_out(const EmbreeScene& scene, const RaySet& rays,
                                          EmbreeCall call) {
    const bool any = is_any_hit(rays.ray_class);
    const auto make = [&]<class Any, class Closest>() -> std::unique_ptr<EmbreeRays::Impl> {
        if (any)
            return std::make_unique<Laid<Any>>(scene, rays);
        return std::make_unique<Laid<Closest>>(scene, rays);
    };
    switch (call) {
    case EmbreeCall::packet8:
        return make.template operator()<Occluded8, Intersect8>();
    case EmbreeCall::packet16:
        return make.template operator()<Occluded16, Intersect16>();
    case EmbreeCall::stream:
        return make.template operator()<OccludedStream, IntersectStream>();
    case EmbreeCall::single:
        break;
    }
    return make.template operator()<Occluded1, Intersect1>();
}

} // namespace

const char* name(EmbreeCall call) {
    switch (call) {
    case EmbreeCall::packet8:
        return "embree8";
    case EmbreeCall::packet16:
        return "embree16";
    case EmbreeCall::stream:
        return "embree_stream";
    case EmbreeCall::single:
        break;
    }
    return "embree1";
}

EmbreeRays::EmbreeRays(const EmbreeScene& scene, const RaySet& rays, EmbreeCall call)
    : impl_(lay_out(scene, rays, call)) {}
EmbreeRays::~EmbreeRays() = default;
RunTime EmbreeRays::run() {
    return impl_->run();
}
EmbreeHit EmbreeRays::hit(std::uint32_t ray) const {
    return impl_->hit(ray);
}
bool EmbreeRays::occluded(std::uint32_t ray) const {
    return impl_->occluded(ray);
}

} // namespace macula::bench
