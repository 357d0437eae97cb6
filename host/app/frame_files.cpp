#include "host/app/frame_files.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "host/app/aov.hpp"

namespace macula::app {
namespace {

output::Layer layer_of(const render::Image& image, std::vector<std::string> channels) {
    return {std::move(channels), image.words, image.components, image.integer};
}

} // namespace

FrameFiles::FrameFiles(std::filesystem::path folder, std::vector<std::string> formats,
                       std::vector<std::string> aovs, float exposure, output::Metadata metadata)
    : folder_(std::move(folder)), formats_(std::move(formats)), aovs_(std::move(aovs)),
      exposure_(exposure), metadata_(std::move(metadata)) {
    for (const std::string& format : formats_) {
        if (format != "exr" && format != "png")
            throw std::invalid_argument("--format \"" + format + "\": exr or png was expected");
    }
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
        throw std::runtime_error(
            fmt::format("making the folder '{}': {}", folder_.string(), error.message()));
}

std::filesystem::path FrameFiles::path_of(std::uint32_t frame, const std::string& format) const {
    return folder_ / fmt::format("frame_{:04}.{}", frame, format);
}

bool FrameFiles::exist(std::uint32_t frame) const {
    return !formats_.empty() &&
           std::all_of(formats_.begin(), formats_.end(), [&](const std::string& format) {
               return std::filesystem::exists(path_of(frame, format));
           });
}

void FrameFiles::write_exr(const std::filesystem::path& path, const render::Renderer& renderer,
                           const output::Metadata& metadata) const {
    // Maps live until the file is written.
    std::vector<render::Image> images;
    images.reserve(aovs_.size() + 1);
    std::vector<output::Layer> layers;
    images.push_back(renderer.picture());
    layers.push_back(layer_of(images.back(), {"R", "G", "B"}));
    for (const std::string& name : aovs_) {
        const Aov& aov = find_aov(name);
        images.push_back(renderer.map(aov.image));
        if (images.back().width != images.front().width ||
            images.back().height != images.front().height)
            throw std::invalid_argument(fmt::format(
                "--aov {}: method {} renders {} x {} pixels for a picture of {} x {}, and a file "
                "has one size",
                name, renderer.options().method, images.back().width, images.back().height,
                images.front().width, images.front().height));
        layers.push_back(layer_of(images.back(), {aov.channels.begin(), aov.channels.end()}));
    }
    output::write_exr(path, images.front().width, images.front().height, layers, metadata);
}

std::vector<std::filesystem::path> FrameFiles::write(const render::Renderer& renderer,
                                                     std::uint32_t frame) const {
    output::Metadata metadata = metadata_;
    metadata.emplace_back("frame", std::to_string(frame));
    metadata.emplace_back("hash", renderer.hash());
    std::vector<std::filesystem::path> written;
    for (const std::string& format : formats_) {
        const std::filesystem::path path = path_of(frame, format);
        if (format == "exr") {
            write_exr(path, renderer, metadata);
        } else {
            const render::Image colour = renderer.picture();
            output::write_png(path, colour.width, colour.height, colour.floats, colour.components,
                              exposure_, metadata);
        }
        written.push_back(path);
    }
    return written;
}

} // namespace macula::app
