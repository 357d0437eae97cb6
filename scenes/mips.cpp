// Filtering of decoded images: mip chains, masks, normal maps.
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/image.hpp"

namespace macula::scene {
namespace {

// IEC 61966-2-1.
std::array<float, 256> make_linear_from_srgb() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double c = static_cast<double>(i) / 255.0;
        table[i] =
            static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

// Indexed by linear intensity in 1/65535: fine enough that every one of the 256 codes is reached.
std::vector<std::uint8_t> make_srgb_from_linear() {
    std::vector<std::uint8_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double c = static_cast<double>(i) / 65535.0;
        const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
        table[i] = static_cast<std::uint8_t>(std::lround(s * 255.0));
    }
    return table;
}

constexpr float kHalf = 0.5f; // rounds to nearest what is not negative

struct Span {
    std::uint32_t first = 0, count = 0; // at most 3
    float weight[3] = {0, 0, 0};        // sum 1
};

// The source texels under each target texel of a row that is halved (rounding down).
std::vector<Span> footprints(std::uint32_t source, std::uint32_t target) {
    std::vector<Span> spans(target);
    const double ratio = static_cast<double>(source) / target;
    for (std::uint32_t i = 0; i < target; ++i) {
        const double lo = i * ratio, hi = (i + 1) * ratio;
        Span& span = spans[i];
        span.first = static_cast<std::uint32_t>(lo);
        const auto last = std::min(source - 1, static_cast<std::uint32_t>(std::ceil(hi)) - 1);
        span.count = std::min(3u, last - span.first + 1);
        for (std::uint32_t k = 0; k < span.count; ++k) {
            const double a = std::max(lo, static_cast<double>(span.first + k));
            const double b = std::min(hi, static_cast<double>(span.first + k + 1));
            span.weight[k] = static_cast<float>((b - a) / ratio);
        }
    }
    return spans;
}

class Halver {
  public:
    explicit Halver(bool srgb) : srgb_(srgb) {}

    MipLevel halve(const MipLevel& source) const {
        MipLevel target;
        target.width = std::max(1u, source.width / 2);
        target.height = std::max(1u, source.height / 2);
        target.rgba.resize(std::size_t{target.width} * target.height * 4);
        const std::vector<Span> columns = footprints(source.width, target.width);
        const std::vector<Span> rows = footprints(source.height, target.height);
        std::uint8_t* out = target.rgba.data();
        for (const Span& row : rows)
            for (const Span& column : columns) {
                average(source, column, row, out);
                out += 4;
            }
        return target;
    }

  private:
    void average(const MipLevel& source, const Span& column, const Span& row,
                 std::uint8_t* out) const {
        float plain[3] = {0, 0, 0}, weighted[3] = {0, 0, 0}, alpha = 0.0f;
        for (std::uint32_t j = 0; j < row.count; ++j) {
            const std::uint8_t* texel =
                &source.rgba[(std::size_t{row.first + j} * source.width + column.first) * 4];
            for (std::uint32_t i = 0; i < column.count; ++i, texel += 4) {
                const float weight = row.weight[j] * column.weight[i];
                const float covered = weight * static_cast<float>(texel[3]);
                alpha += covered;
                for (int c = 0; c < 3; ++c) {
                    const float value = srgb_ ? linear_[texel[c]] : texel[c] * (1.0f / 255.0f);
                    plain[c] += weight * value;
                    weighted[c] += covered * value;
                }
            }
        }
        for (int c = 0; c < 3; ++c)
            out[c] = encode(alpha > 0.0f ? weighted[c] / alpha : plain[c]);
        out[3] = static_cast<std::uint8_t>(std::min(255.0f, alpha + kHalf));
    }

    std::uint8_t encode(float value) const {
        const float bounded = std::min(value, 1.0f);
        return srgb_ ? encoded_[static_cast<std::size_t>(bounded * 65535.0f + kHalf)]
                     : static_cast<std::uint8_t>(bounded * 255.0f + kHalf);
    }

    static inline const std::array<float, 256> linear_ = make_linear_from_srgb();
    static inline const std::vector<std::uint8_t> encoded_ = make_srgb_from_linear();
    bool srgb_;
};

} // namespace

std::vector<MipLevel> build_mips(Image&& image, bool srgb) {
    std::vector<MipLevel> levels;
    levels.push_back({image.width, image.height, std::move(image.rgba)});
    const Halver halver(srgb);
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halver.halve(levels.back()));
    return levels;
}

void to_mask(Image& image) {
    bool colour_varies = false;
    for (std::size_t i = 0; i < image.rgba.size() && !colour_varies; i += 4)
        colour_varies = image.rgba[i] != image.rgba[0];
    const std::size_t channel = image.has_alpha && !colour_varies ? 3 : 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const std::uint8_t value = image.rgba[i + channel];
        image.rgba[i] = image.rgba[i + 1] = image.rgba[i + 2] = value;
        image.rgba[i + 3] = 255;
    }
    image.has_alpha = false;
}

bool looks_like_normal_map(const Image& image) {
    std::size_t unit = 0;
    const std::size_t count = image.rgba.size() / 4;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const float x = image.rgba[i] / 127.5f - 1.0f, y = image.rgba[i + 1] / 127.5f - 1.0f;
        const float z = image.rgba[i + 2] / 127.5f - 1.0f;
        const float square = x * x + y * y + z * z;
        const bool grey = image.rgba[i] == image.rgba[i + 2];
        unit += !grey && z > 0.2f && square > 0.7f && square < 1.3f;
    }
    return unit * 10 > count * 9;
}

void bump_to_normal(Image& image, float strength) {
    const std::uint32_t width = image.width, height = image.height;
    std::vector<std::uint8_t> normals(image.rgba.size());
    const auto sample = [&](std::uint32_t x, std::uint32_t y) {
        return image.rgba[(std::size_t{y} * width + x) * 4] / 255.0f;
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        const std::uint32_t before = (y + height - 1) % height, after = (y + 1) % height;
        for (std::uint32_t x = 0; x < width; ++x) {
            const float du = sample((x + 1) % width, y) - sample((x + width - 1) % width, y);
            const float dv = sample(x, after) - sample(x, before);
            const glm::vec3 normal =
                glm::normalize(glm::vec3(-0.5f * strength * du, -0.5f * strength * dv, 1.0f));
            std::uint8_t* out = &normals[(std::size_t{y} * width + x) * 4];
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(normal[c] * 127.5f + 128.0f);
            out[3] = 255;
        }
    }
    image.rgba = std::move(normals);
    image.has_alpha = false;
}

} // namespace macula::scene
