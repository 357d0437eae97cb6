#include "host/app/collage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/output/image.hpp"

namespace macula::app {
namespace {

constexpr double kRing = 8.0, kLine = 1.5; // radius of the mark and half its width, pixels

} // namespace

Collage::Collage(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), pixels_(std::size_t{3} * width * height) {}

float* Collage::pixel(std::uint32_t x, std::uint32_t y) {
    return &pixels_[3 * (std::size_t{y} * width_ + x)];
}

void Collage::place(const render::Image& image, std::uint32_t left, std::uint32_t top) {
    if (left + image.width > width_ || top + image.height > height_)
        throw std::out_of_range("collage: the image does not fit");
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::size_t from = (std::size_t{y} * image.width + x) * image.components;
            std::copy_n(&image.floats[from], 3, pixel(left + x, top + y));
        }
    }
}

void Collage::place_half(const Collage& other, std::uint32_t left, std::uint32_t top) {
    const std::uint32_t width = other.width_ / 2, height = other.height_ / 2;
    if (left + width > width_ || top + height > height_)
        throw std::out_of_range("collage: the picture does not fit");
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const float* upper = &other.pixels_[3 * (std::size_t{2 * y} * other.width_ + 2 * x)];
            const float* lower = upper + std::size_t{3} * other.width_;
            for (int c = 0; c < 3; ++c)
                pixel(left + x, top + y)[c] =
                    0.25f * (upper[c] + upper[c + 3] + lower[c] + lower[c + 3]);
        }
    }
}

void Collage::mark(double x, double y) {
    const auto from = [](double v) {
        return static_cast<std::uint32_t>(std::max(0.0, std::floor(v - kRing - 2.0 * kLine)));
    };
    const auto to = [](double v, std::uint32_t end) {
        return static_cast<std::uint32_t>(
            std::clamp(std::ceil(v + kRing + 2.0 * kLine), 0.0, static_cast<double>(end)));
    };
    for (std::uint32_t py = from(y); py < to(y, height_); ++py) {
        for (std::uint32_t px = from(x); px < to(x, width_); ++px) {
            const double away = std::fabs(std::hypot(px + 0.5 - x, py + 0.5 - y) - kRing);
            if (away > 2.0 * kLine)
                continue;
            const bool is_line = away < kLine; // green on black, to be seen on any ground
            std::fill_n(pixel(px, py), 3, 0.0f);
            pixel(px, py)[1] = is_line ? 1.0f : 0.0f;
        }
    }
}

void Collage::write(const std::filesystem::path& path) const {
    output::write_png(path, width_, height_, pixels_, 3, 1.0f, {});
}

} // namespace macula::app
