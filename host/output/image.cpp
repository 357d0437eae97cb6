#include "host/output/image.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace macula::output {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& cause) {
    throw std::runtime_error(fmt::format("writing '{}': {}", path.string(), cause));
}

// Writes through `write` under a temporary name, then renames; removes the rest of a failure.
template <class Write>
void write_whole(const fs::path& path, const Write& write) {
    const fs::path partial = path.parent_path() / (".partial-" + path.filename().string());
    std::error_code error;
    try {
        write(partial);
    } catch (...) {
        fs::remove(partial, error);
        throw;
    }
    fs::rename(partial, path, error);
    if (error) {
        const std::string cause = error.message();
        fs::remove(partial, error);
        fail(path, cause);
    }
}

void write_image(const fs::path& path, const fs::path& target, const OIIO::ImageSpec& spec,
                 OIIO::TypeDesc type, const void* pixels) {
    const auto out = OIIO::ImageOutput::create(path.string());
    if (!out)
        fail(target, OIIO::geterror());
    if (!out->open(path.string(), spec) || !out->write_image(type, pixels) || !out->close())
        fail(target, out->geterror());
}

void add_metadata(OIIO::ImageSpec& spec, const Metadata& metadata) {
    for (const auto& [key, value] : metadata)
        spec.attribute("macula:" + key, value);
}

OIIO::ImageSpec exr_spec(std::uint32_t width, std::uint32_t height, std::span<const Layer> layers) {
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 0,
                         OIIO::TypeDesc::FLOAT);
    for (const Layer& layer : layers) {
        for (const std::string& channel : layer.channels) {
            spec.channelnames.push_back(channel);
            spec.channelformats.emplace_back(layer.half ? OIIO::TypeDesc::HALF
                                                        : OIIO::TypeDesc::FLOAT);
        }
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.attribute("compression", "zip");
    return spec;
}

} // namespace

std::uint8_t encode_srgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(encoded * 255.0f));
}

void write_exr(const fs::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const Layer> layers, const Metadata& metadata) {
    OIIO::ImageSpec spec = exr_spec(width, height, layers);
    add_metadata(spec, metadata);
    const std::size_t pixels = std::size_t{width} * height;
    const auto total = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> all(pixels * total);
    std::size_t first = 0;
    for (const Layer& layer : layers) {
        const std::size_t count = layer.channels.size();
        if (layer.pixels.size() != pixels * count)
            fail(path, fmt::format("layer '{}' has {} values, {} x {} x {} expected",
                                   layer.channels.empty() ? "" : layer.channels.front(),
                                   layer.pixels.size(), width, height, count));
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(&layer.pixels[i * count], count, &all[i * total + first]);
        first += count;
    }
    // Per-channel formats are converted by OpenImageIO when all pixels come as floats.
    write_whole(path, [&](const fs::path& partial) {
        write_image(partial, path, spec, OIIO::TypeDesc::FLOAT, all.data());
    });
}

void write_png(const fs::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const float> rgb, float exposure, const Metadata& metadata) {
    if (rgb.size() != std::size_t{width} * height * 3)
        fail(path, fmt::format("{} values, {} x {} x 3 expected", rgb.size(), width, height));
    std::vector<std::uint8_t> bytes(rgb.size());
    std::transform(rgb.begin(), rgb.end(), bytes.begin(),
                   [exposure](float value) { return encode_srgb(value * exposure); });
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3,
                         OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    add_metadata(spec, metadata);
    write_whole(path, [&](const fs::path& partial) {
        write_image(partial, path, spec, OIIO::TypeDesc::UINT8, bytes.data());
    });
}

} // namespace macula::output
