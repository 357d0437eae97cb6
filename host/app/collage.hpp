/// Frames beside each other in one picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/render/renderer.hpp"

namespace macula::app {

class Collage {
  public:
    /// Black, in pixels.
    Collage(std::uint32_t width, std::uint32_t height);

    /// An image with its upper left corner at (left, top); throws std::out_of_range where it does
    /// not fit.
    void place(const render::Image& image, std::uint32_t left, std::uint32_t top);
    /// Another collage at half its size: means of 2 x 2 pixels.
    void place_half(const Collage& other, std::uint32_t left, std::uint32_t top);
    /// A ring about a point in pixels; what lies outside the picture is left out.
    void mark(double x, double y);
    /// As PNG. Throws std::runtime_error.
    void write(const std::filesystem::path& path) const;

  private:
    float* pixel(std::uint32_t x, std::uint32_t y);

    std::uint32_t width_, height_;
    std::vector<float> pixels_; // linear RGB
};

} // namespace macula::app
