/// The files of a rendered frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/output/image.hpp"
#include "host/render/renderer.hpp"

namespace macula::app {

class FrameFiles {
  public:
    /// `formats`: exr, png; throws std::invalid_argument for another. Makes the folder.
    FrameFiles(std::filesystem::path folder, std::vector<std::string> formats,
               std::vector<std::string> aovs, float exposure, output::Metadata metadata);

    /// All files of the frame are there already.
    bool exist(std::uint32_t frame) const;
    /// Writes the last rendered frame; returns the paths.
    std::vector<std::filesystem::path> write(const render::Renderer& renderer,
                                             std::uint32_t frame) const;

  private:
    std::filesystem::path path_of(std::uint32_t frame, const std::string& format) const;
    void write_exr(const std::filesystem::path& path, const render::Renderer& renderer,
                   const output::Metadata& metadata) const;

    std::filesystem::path folder_;
    std::vector<std::string> formats_, aovs_;
    float exposure_;
    output::Metadata metadata_;
};

} // namespace macula::app
