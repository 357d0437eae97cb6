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
            spec.channelformats.emplace_back(layer.integer ? OIIO::TypeDesc::UINT
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
    // All channels have 32 bits, so the words go to the file as they are.
    std::vector<std::uint32_t> all(pixels * total);
    std::size_t first = 0;
    for (const Layer& layer : layers) {
        const std::size_t count = layer.channels.size();
        if (layer.words.size() != pixels * layer.stride || count > layer.stride)
            fail(path, fmt::format("layer '{}' has {} values, {} x {} x {} expected",
                                   layer.channels.empty() ? "" : layer.channels.front(),
                                   layer.words.size(), width, height, layer.stride));
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(&layer.words[i * layer.stride], count, &all[i * total + first]);
        first += count;
    }
    write_whole(path, [&](const fs::path& partial) {
        write_image(partial, path, spec, OIIO::TypeDesc::UNKNOWN, all.data());
    });
}

void write_png(const fs::path& path, std::uint32_t width, std::uint32_t height,
               std::span<const float> pixels, std::uint32_t stride, float exposure,
               const Metadata& metadata) {
    const std::size_t count = std::size_t{width} * height;
    if (stride < 3 || pixels.size() != count * stride)
        fail(path,
             fmt::format("{} values, {} x {} x {} expected", pixels.size(), width, height, stride));
    std::vector<std::uint8_t> bytes(count * 3);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            bytes[i * 3 + channel] = encode_srgb(pixels[i * stride + channel] * exposure);
    }
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3,
                         OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    add_metadata(spec, metadata);
    write_whole(path, [&](const fs::path& partial) {
        write_image(partial, path, spec, OIIO::TypeDesc::UINT8, bytes.data());
    });
}

} // namespace macula::output
