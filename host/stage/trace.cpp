#include "host/stage/trace.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <stdexcept>
#include <tuple>

#include "host/cl/device.hpp"
#include "host/frame/geometry.hpp"
#include "host/kernel/library.hpp"
#include "host/kernel/tuning.hpp"
#include "shared/ray.h"

namespace macula::stage {
namespace {

using kernel::Choice;
using kernel::Variant;

bool has_parameter(const Variant& variant, std::string_view wanted) {
    return std::ranges::any_of(variant.parameters, [&](const kernel::Parameter& parameter) {
        return wanted == parameter.name;
    });
}

std::uint32_t parameter_or(const Choice& choice, std::string_view wanted, std::uint32_t otherwise) {
    return has_parameter(*choice.variant, wanted)
               ? kernel::parameter(*choice.variant, choice.parameters, wanted)
               : otherwise;
}

kernel::VariantKey key_of(const Choice& choice, bool any_hit, const frame::DeviceGeometry& scene) {
    kernel::VariantKey key(std::string("traverse/") + choice.variant->name);
    key.any_hit(any_hit).instances(scene.instanced()).masks(scene.masked());
    for (const kernel::Parameter& parameter : choice.variant->parameters) {
        if (parameter.use == kernel::ParameterUse::literal)
            key.parameter(parameter.name,
                          kernel::parameter(*choice.variant, choice.parameters, parameter.name));
    }
    return key;
}

// A built variant with its launch.
struct Program {
    compute::Kernel kernel;
    std::uint32_t work_group = 1;
    std::uint32_t rays_per_item = 1;
    std::uint64_t most_groups = 0; // of a persistent launch; 0: as many as the queue needs
};

Program make_program(const compute::Device& device, kernel::Library& library, const Choice& choice,
                     bool any_hit, const frame::DeviceGeometry& scene) {
    Program program;
    program.kernel = library.kernel(key_of(choice, any_hit, scene), "trace", device);
    const auto limit =
        std::bit_floor(std::max<std::size_t>(program.kernel.max_work_group_size(), 1));
    program.work_group = static_cast<std::uint32_t>(
        std::min<std::size_t>(parameter_or(choice, "work_group", 64), limit));
    program.rays_per_item = parameter_or(choice, "rays_per_item", choice.variant->rays_per_item);
    if (choice.variant->launch == kernel::Launch::persistent)
        program.most_groups = std::uint64_t{kernel::traits_of(device).compute_units} *
                              parameter_or(choice, "groups_per_unit", 1);
    return program;
}

void require_room(const compute::Buffer& buffer, std::uint64_t bytes, std::string_view what) {
    if (buffer.size() < bytes)
        throw std::invalid_argument("trace: the buffer of the " + std::string(what) + " has " +
                                    std::to_string(buffer.size()) + " bytes, but its queue needs " +
                                    std::to_string(bytes));
}

} // namespace

VariantTable choose_variants(const compute::Device& device, std::string_view forced,
                             std::vector<std::string>* warnings) {
    VariantTable table;
    if (!forced.empty()) {
        table.fill({&kernel::find_variant(forced), {}});
        return table;
    }
    const kernel::LoadedTuning loaded =
        kernel::load_tuning(kernel::tuning_folder(), device.facts());
    if (warnings != nullptr)
        warnings->insert(warnings->end(), loaded.warnings.begin(), loaded.warnings.end());
    const kernel::DeviceTraits traits = kernel::traits_of(device);
    for (const kernel::RayClass ray_class : kernel::kRayClasses) {
        const auto tuned = loaded.tuning.choices.find(ray_class);
        table[static_cast<std::size_t>(ray_class)] =
            tuned != loaded.tuning.choices.end()
                ? tuned->second
                : Choice{&kernel::default_variant(traits, ray_class), {}};
    }
    return table;
}

struct Tracer::Impl {
    compute::Device device;
    std::unique_ptr<kernel::Library> own_library;
    kernel::Library& library;
    frame::DeviceGeometry& geometry;
    VariantTable variants;
    compute::Buffer work_counter;
    using Key = std::tuple<const Variant*, kernel::ParameterValues, bool>;
    std::map<Key, Program> programs;

    Impl(const compute::Device& on, std::unique_ptr<kernel::Library> own, kernel::Library* shared,
         frame::DeviceGeometry& scene, VariantTable table)
        : device(on), own_library(std::move(own)),
          library(shared != nullptr ? *shared : *own_library), geometry(scene),
          variants(std::move(table)),
          work_counter(device.allocate_array<std::uint32_t>(1, "work counter of the rays")) {
        for (const Choice& choice : variants) {
            if (choice.variant == nullptr)
                throw std::invalid_argument("trace: a ray class has no traversal variant");
            kernel::check_parameters(*choice.variant, choice.parameters);
        }
    }

    Program& program(const Choice& choice, bool any_hit) {
        const Key key{choice.variant, choice.parameters, any_hit};
        const auto found = programs.find(key);
        if (found != programs.end())
            return found->second;
        return programs.emplace(key, make_program(device, library, choice, any_hit, geometry))
            .first->second;
    }

    void launch(kernel::RayClass ray_class, bool any_hit, const compute::Buffer& rays,
                const compute::Buffer& ray_count, std::uint32_t capacity, compute::Buffer& results,
                std::string_view launch_name) {
        const Choice& choice = variants[static_cast<std::size_t>(ray_class)];
        Program& traced = program(choice, any_hit);
        const frame::LayoutBuffers& layout = geometry.layout(choice.variant->layout);
        const frame::MaskBuffers& masks = geometry.masks();
        traced.kernel.set(layout.nodes, layout.triangles, layout.instances, geometry.upper_nodes(),
                          masks.slots, masks.triangles, masks.textures, masks.words, rays,
                          ray_count, results, work_counter);
        if (traced.most_groups != 0)
            work_counter.fill(0);
        const std::uint64_t items =
            (std::uint64_t{capacity} + traced.rays_per_item - 1) / traced.rays_per_item;
        std::uint64_t groups = (items + traced.work_group - 1) / traced.work_group;
        if (traced.most_groups != 0)
            groups = std::min(groups, traced.most_groups);
        traced.kernel.launch(std::string(launch_name), {groups * traced.work_group},
                             {traced.work_group});
    }
};

Tracer::Tracer(const compute::Device& device, frame::DeviceGeometry& geometry,
               VariantTable variants)
    : impl_(std::make_unique<Impl>(device, std::make_unique<kernel::Library>(), nullptr, geometry,
                                   std::move(variants))) {}

Tracer::Tracer(const compute::Device& device, kernel::Library& library,
               frame::DeviceGeometry& geometry, VariantTable variants)
    : impl_(std::make_unique<Impl>(device, nullptr, &library, geometry, std::move(variants))) {}

Tracer::~Tracer() = default;

void Tracer::closest(kernel::RayClass ray_class, const compute::Buffer& rays,
                     const compute::Buffer& ray_count, std::uint32_t capacity,
                     compute::Buffer& hits, std::string_view launch_name) {
    const std::uint64_t blocks =
        (std::uint64_t{capacity} + MACULA_RAY_BLOCK - 1) / MACULA_RAY_BLOCK;
    require_room(rays, blocks * sizeof(shared::RayBlock), "rays");
    require_room(ray_count, sizeof(std::uint32_t), "ray count");
    require_room(hits, blocks * sizeof(shared::HitBlock), "hits");
    impl_->launch(ray_class, false, rays, ray_count, capacity, hits, launch_name);
}

void Tracer::any(kernel::RayClass ray_class, const compute::Buffer& rays,
                 const compute::Buffer& ray_count, std::uint32_t capacity,
                 compute::Buffer& occluded, std::string_view launch_name) {
    const std::uint64_t blocks =
        (std::uint64_t{capacity} + MACULA_RAY_BLOCK - 1) / MACULA_RAY_BLOCK;
    require_room(rays, blocks * sizeof(shared::RayBlock), "rays");
    require_room(ray_count, sizeof(std::uint32_t), "ray count");
    require_room(occluded, std::uint64_t{capacity} * sizeof(std::uint32_t), "occlusion flags");
    impl_->launch(ray_class, true, rays, ray_count, capacity, occluded, launch_name);
}

const kernel::Choice& Tracer::choice(kernel::RayClass ray_class) const {
    return impl_->variants[static_cast<std::size_t>(ray_class)];
}

} // namespace macula::stage
