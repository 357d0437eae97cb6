#include "host/output/jpeg.hpp"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace macula::output {
namespace {

[[noreturn]] void fail(const std::filesystem::path& picture, const std::string& cause) {
    throw std::runtime_error(fmt::format("making a JPEG of '{}': {}", picture.string(), cause));
}

} // namespace

std::string as_jpeg(const std::filesystem::path& picture, int quality) {
    if (quality < 1 || quality > 100)
        throw std::invalid_argument("the quality of a JPEG must lie between 1 and 100");
    const auto in = OIIO::ImageInput::open(picture.string());
    if (!in)
        fail(picture, OIIO::geterror());
    const int width = in->spec().width, height = in->spec().height;
    if (in->spec().nchannels < 3 || width < 1 || height < 1 || width > 16384 || height > 16384)
        fail(picture, "an RGB picture of 1 to 16384 pixels a side was expected");
    std::vector<std::uint8_t> bytes(std::size_t{3} * static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
    if (!in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.data()))
        fail(picture, in->geterror());

    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Compression", fmt::format("jpeg:{}", quality));
    spec.attribute("jpeg:subsampling", "4:4:4");
    OIIO::Filesystem::IOVecOutput memory;
    const auto out = OIIO::ImageOutput::create("jpeg");
    if (!out || !out->set_ioproxy(&memory) || !out->open("memory.jpg", spec) ||
        !out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !out->close())
        fail(picture, out ? out->geterror() : OIIO::geterror());
    return {memory.buffer().begin(), memory.buffer().end()};
}

} // namespace macula::output
