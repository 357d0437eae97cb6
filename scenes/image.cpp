#include "scenes/image.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scenes/error.hpp"

namespace macula::scene {
namespace {

constexpr std::size_t kMaxTiledBytes = std::size_t{1} << 30;

// Averages `factor` x `factor` blocks of `rows` rows of decoded pixels into one row of the image:
// only textures beyond kMaxTextureSide come here, which are too large to be held whole.
void reduce_rows(const std::uint8_t* rows, std::uint32_t source_width, std::uint32_t row_count,
                 std::uint32_t channels, std::uint32_t factor, std::uint32_t y, Image& image) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
        std::uint32_t sum[4] = {0, 0, 0, 0}, count = 0;
        for (std::uint32_t dy = 0; dy < row_count; ++dy) {
            for (std::uint32_t dx = 0; dx < factor && x * factor + dx < source_width; ++dx) {
                const std::size_t at =
                    (std::size_t{dy} * source_width + x * factor + dx) * channels;
                for (std::uint32_t c = 0; c < channels; ++c)
                    sum[c] += rows[at + c];
                ++count;
            }
        }
        std::uint8_t* out = &image.rgba[(std::size_t{y} * image.width + x) * 4];
        std::uint8_t mean[4];
        for (std::uint32_t c = 0; c < channels; ++c)
            mean[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
        const bool colour = channels >= 3;
        out[0] = mean[0];
        out[1] = colour ? mean[1] : mean[0];
        out[2] = colour ? mean[2] : mean[0];
        out[3] = channels == 4 ? mean[3] : channels == 2 ? mean[1] : std::uint8_t{255};
    }
}

Image read(OIIO::ImageInput& input, const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        throw SceneError(name + ": the image has no pixels");
    const auto width = static_cast<std::uint32_t>(spec.width);
    const auto height = static_cast<std::uint32_t>(spec.height);
    const std::uint32_t side = std::max(width, height);
    if (side > kMaxDecodeSide || spec.depth > 1)
        throw SceneError(name + ": " + std::to_string(width) + " x " + std::to_string(height) +
                         " texels are more than the limit of " + std::to_string(kMaxDecodeSide) +
                         " a side");
    std::uint32_t factor = 1;
    while ((side + factor - 1) / factor > kMaxTextureSide)
        factor *= 2;
    const auto channels = static_cast<std::uint32_t>(std::min(spec.nchannels, 4));
    Image image;
    image.width = (width + factor - 1) / factor;
    image.height = (height + factor - 1) / factor;
    image.original_side = side;
    image.rgba.resize(std::size_t{image.width} * image.height * 4);
    // Tiled files are read whole, scan lines in strips: one strip makes one row of the image.
    const bool tiled = spec.tile_width != 0;
    const std::size_t stride = std::size_t{width} * channels;
    const std::uint32_t strip = tiled ? height : factor;
    if (stride * strip > kMaxTiledBytes)
        throw SceneError(name + ": a tiled image of " + std::to_string(width) + " x " +
                         std::to_string(height) + " texels is too large");
    std::vector<std::uint8_t> rows(stride * strip);
    for (std::uint32_t y = 0; y < height; y += factor) {
        const std::uint32_t end = std::min(height, y + factor);
        const auto int_channels = static_cast<int>(channels);
        bool ok = true;
        if (!tiled)
            ok = input.read_scanlines(0, 0, spec.y + static_cast<int>(y),
                                      spec.y + static_cast<int>(end), spec.z, 0, int_channels,
                                      OIIO::TypeDesc::UINT8, rows.data());
        else if (y == 0)
            ok = input.read_image(0, 0, 0, int_channels, OIIO::TypeDesc::UINT8, rows.data());
        if (!ok)
            throw SceneError(name + ": " + input.geterror());
        reduce_rows(rows.data() + (tiled ? y * stride : 0), width, end - y, channels, factor,
                    y / factor, image);
    }
    for (std::size_t i = 3; i < image.rgba.size() && !image.has_alpha; i += 4)
        image.has_alpha = image.rgba[i] != 255;
    return image;
}

OIIO::ImageSpec read_options() {
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1); // colours as stored, not multiplied by alpha
    return options;
}

std::string reason() {
    const std::string text = OIIO::geterror();
    return text.empty() ? "not an image that can be read" : text;
}

} // namespace

Image decode_image(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw SceneError(name + ": no such file");
    const OIIO::ImageSpec options = read_options();
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), &options);
    if (!input)
        throw SceneError(name + ": " + reason());
    return read(*input, name);
}

Image decode_image(std::span<const unsigned char> bytes, const std::string& name) {
    const bool png = bytes.size() > 3 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G';
    const bool jpeg = bytes.size() > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
    if (!png && !jpeg)
        throw SceneError(name + ": embedded images must be PNG or JPEG");
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data()), bytes.size());
    OIIO::ImageSpec options = read_options();
    void* proxy = &memory; // an argument of open() is lost where there are options
    options.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::unique_ptr<OIIO::ImageInput> input =
        OIIO::ImageInput::open(png ? "embedded.png" : "embedded.jpg", &options, &memory);
    if (!input)
        throw SceneError(name + ": " + reason());
    return read(*input, name);
}

void flip_vertically(Image& image) {
    const std::size_t stride = std::size_t{image.width} * 4;
    for (std::uint32_t y = 0; y < image.height / 2; ++y) {
        auto* top = image.rgba.data() + y * stride;
        std::swap_ranges(top, top + stride, image.rgba.data() + (image.height - 1 - y) * stride);
    }
}

} // namespace macula::scene
