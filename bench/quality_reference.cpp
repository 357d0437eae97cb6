#include "bench/quality_reference.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>
#include <xxhash.h>

#include "bench/scene_hash.hpp"
#include "host/kernel/embedded.hpp"

namespace macula::bench {
namespace {

std::uint64_t hash_of_kernels() {
    std::uint64_t hash = 0;
    for (const kernel::EmbeddedFile& file : kernel::embedded_files()) {
        hash = XXH3_64bits_withSeed(file.path.data(), file.path.size(), hash);
        hash = XXH3_64bits_withSeed(file.text.data(), file.text.size(), hash);
    }
    return hash;
}

bool uses_own_kernels() {
    const char* folder = std::getenv("MACULA_KERNEL_DIR");
    return folder != nullptr && *folder != '\0';
}

std::string text(const scene::Camera& c) {
    return fmt::format("{:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a}", c.eye.x, c.eye.y, c.eye.z,
                       c.target.x, c.target.y, c.target.z, c.up.x, c.up.y, c.up.z);
}

constexpr std::size_t kFloats = 3 + 3 + 2; // a pixel

std::vector<std::byte> packed(const ReferenceFrame& frame) {
    std::vector<std::byte> bytes;
    for (const auto* values : {&frame.converged.rgb, &frame.full.rgb, &frame.motion.xy}) {
        const auto* first = reinterpret_cast<const std::byte*>(values->data());
        bytes.insert(bytes.end(), first, first + values->size() * sizeof(float));
    }
    return bytes;
}

ReferenceFrame unpacked(const std::vector<std::byte>& bytes, std::uint32_t width,
                        std::uint32_t height) {
    const std::size_t pixels = std::size_t{width} * height;
    const std::byte* at = bytes.data();
    const auto take = [&](std::size_t count) {
        std::vector<float> values(count);
        std::memcpy(values.data(), at, count * sizeof(float));
        at += count * sizeof(float);
        return values;
    };
    ReferenceFrame frame;
    frame.converged = {width, height, take(3 * pixels)};
    frame.full = {width, height, take(3 * pixels)};
    frame.motion = {width, height, take(2 * pixels)};
    return frame;
}

} // namespace

References::References(const QualityFlight& flight, const QualityOptions& options,
                       frame::LightMode lights)
    : flight_(flight), options_(options), lights_(lights),
      on_disk_(!options.reference_cache.empty() && !uses_own_kernels()),
      cache_(on_disk_ ? options.reference_cache : std::filesystem::path()) {
    const frame::Tangents t = tangents_of(flight.display());
    content_ = fmt::format(
        "macula reference 1\nscene {}\nkernels {:016x}\nlights {} {} {}\nsize {} {}\n"
        "tangents {:a} {:a} {:a} {:a}\nsamples {}\nseed {}\n",
        scene_hash(flight.scene()), hash_of_kernels(), frame::name(lights),
        options.light_samples.value_or(frame::default_light_samples(lights)),
        options.ambient_occlusion_samples, flight.display().width, flight.display().height, t.left,
        t.right, t.up, t.down, options.reference_spp, options.seed);
}

std::string References::key(std::uint32_t frame) const {
    return content_ + fmt::format("frame {}\nview {}\nlast view {}\n", frame,
                                  text(flight_.view().at(frame).camera),
                                  text(flight_.view().at(frame - 1).camera));
}

std::filesystem::path References::file_of(std::uint32_t frame) const {
    return cache_.path_of(key(frame));
}

ReferenceFrame References::render(std::uint32_t frame) {
    if (!full_) {
        full_.emplace(flight_.make(lights_, [](render::Options& o) { o.images = {"motion"}; }));
        converged_.emplace(flight_.make(
            lights_, [&](render::Options& o) { o.samples_per_pixel = options_.reference_spp; }));
    }
    ++rendered_;
    flight_.render(*full_, frame - 1); // motion leads there
    flight_.render(*full_, frame);
    flight_.render(*converged_, frame);
    return {copy_colour(*converged_), copy_colour(*full_), copy_motion(*full_)};
}

ReferenceFrame References::at(std::uint32_t frame) {
    const auto is_it = [&](const auto& pair) { return pair.first == frame; };
    if (const auto kept = std::find_if(kept_.begin(), kept_.end(), is_it); kept != kept_.end())
        return kept->second;
    if (!on_disk_)
        return kept_.emplace_back(frame, render(frame)).second;
    const scene::Display& display = flight_.display();
    const auto bytes = cache_.load(key(frame));
    if (bytes &&
        bytes->size() == kFloats * sizeof(float) * display.width * std::size_t{display.height})
        return unpacked(*bytes, display.width, display.height);
    ReferenceFrame made = render(frame);
    cache_.store(key(frame), packed(made));
    return made;
}

} // namespace macula::bench
