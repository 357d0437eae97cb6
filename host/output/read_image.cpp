#include "host/output/read_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace macula::output {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& cause) {
    throw std::runtime_error(fmt::format("reading '{}': {}", path.string(), cause));
}

/// An open image of a size that can be scored.
class Input {
  public:
    explicit Input(const fs::path& path) : path_(path) {
        std::error_code error;
        if (!fs::is_regular_file(path, error))
            fail(path, "there is no such file");
        OIIO::ImageSpec options;
        options.attribute("oiio:UnassociatedAlpha", 1);
        input_ = OIIO::ImageInput::open(path.string(), &options);
        if (!input_)
            fail(path, cause("not an image that can be read"));
        const std::string format = input_->format_name();
        if (format != "png" && format != "openexr")
            fail(path, fmt::format("a {} file; PNG or EXR was expected", format));
        kind_ = format == "png" ? ImageKind::png : ImageKind::exr;
        check_size();
    }

    ImageKind kind() const { return kind_; }
    const OIIO::ImageSpec& spec() const { return input_->spec(); }
    std::uint32_t width() const { return static_cast<std::uint32_t>(spec().width); }
    std::uint32_t height() const { return static_cast<std::uint32_t>(spec().height); }

    bool has(const char* channel) const { return find(channel) >= 0; }

    /// Several channels as floats, interleaved in the order asked for.
    std::vector<float> read(const std::vector<const char*>& channels) {
        std::vector<int> at;
        for (const char* channel : channels) {
            at.push_back(find(channel));
            if (at.back() < 0)
                fail(path_, fmt::format("it has no channel {}; its channels are {}", channel,
                                        fmt::join(spec().channelnames, ", ")));
            check_type(at.back());
        }
        const std::size_t count = channels.size();
        std::vector<float> values(count * width() * height());
        bool together = true; // in the file: one pass reads all
        for (std::size_t c = 1; c < count; ++c)
            together = together && at[c] == at[c - 1] + 1;
        const auto stride = static_cast<OIIO::stride_t>(count * sizeof(float));
        for (std::size_t c = 0; c < (together ? 1 : count); ++c) {
            if (!input_->read_image(0, 0, at[c], at[c] + (together ? static_cast<int>(count) : 1),
                                    OIIO::TypeDesc::FLOAT, values.data() + c, stride))
                fail(path_, cause("its pixels cannot be read"));
        }
        return values;
    }

  private:
    std::string cause(const char* otherwise) const {
        std::string text = input_ ? input_->geterror() : OIIO::geterror();
        std::replace(text.begin(), text.end(), '\n', ' ');
        return text.empty() ? otherwise : text;
    }

    void check_size() const {
        const OIIO::ImageSpec& s = spec();
        if (s.deep || s.depth > 1)
            fail(path_, "deep and volumetric images cannot be scored");
        if (s.width < 1 || s.height < 1 ||
            static_cast<std::size_t>(s.width) >
                metric::kMaxPixels / static_cast<std::size_t>(s.height))
            fail(path_, fmt::format("{} x {} pixels: 1 to {} in all were expected", s.width,
                                    s.height, metric::kMaxPixels));
        if (s.x != s.full_x || s.y != s.full_y || s.width != s.full_width ||
            s.height != s.full_height)
            fail(path_, fmt::format("it is a crop: {} x {} pixels at ({}, {}) of {} x {}", s.width,
                                    s.height, s.x - s.full_x, s.y - s.full_y, s.full_width,
                                    s.full_height));
    }

    int find(const char* channel) const {
        const auto& names = spec().channelnames;
        const auto found = std::find(names.begin(), names.end(), channel);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    }

    void check_type(int channel) const {
        const OIIO::TypeDesc type = spec().channelformat(channel);
        bool suits = false;
        switch (type.basetype) {
        case OIIO::TypeDesc::UINT8:
        case OIIO::TypeDesc::UINT16:
            suits = kind_ == ImageKind::png;
            break;
        case OIIO::TypeDesc::HALF:
        case OIIO::TypeDesc::FLOAT:
            suits = kind_ == ImageKind::exr;
            break;
        default:
            break;
        }
        if (!suits)
            fail(path_,
                 fmt::format("channel {} holds {} values; {} were expected",
                             spec().channelnames[static_cast<std::size_t>(channel)], type.c_str(),
                             kind_ == ImageKind::png ? "8 or 16 bit integer" : "half or float"));
    }

    const fs::path path_;
    std::unique_ptr<OIIO::ImageInput> input_;
    ImageKind kind_ = ImageKind::png;
};

float linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Of the 256 or 65536 values that a file can hold.
void decode_srgb(std::vector<float>& values, unsigned greatest) {
    std::vector<float> table(greatest + 1);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = linear(static_cast<float>(i) / static_cast<float>(greatest));
    for (float& value : values)
        value = table[static_cast<std::size_t>(
            std::lround(std::clamp(value, 0.0f, 1.0f) * static_cast<float>(greatest)))];
}

void check_opaque(const fs::path& path, Input& input) {
    if (!input.has("A"))
        return;
    const std::vector<float> alpha = input.read({"A"});
    if (std::any_of(alpha.begin(), alpha.end(), [](float a) { return a != 1.0f; }))
        fail(path, "it is transparent in places; an opaque picture was expected");
}

void check_finite(const fs::path& path, const metric::Picture& picture) {
    try {
        metric::check(picture);
    } catch (const std::invalid_argument& error) {
        fail(path, error.what());
    }
}

metric::MotionField motion_of(Input& input) {
    return {input.width(), input.height(), input.read({"Motion.X", "Motion.Y"})};
}

} // namespace

ReadPicture read_picture(const fs::path& path) {
    Input input(path);
    ReadPicture result;
    result.kind = input.kind();
    result.bits = static_cast<unsigned>(8 * input.spec().format.size());
    result.picture = {input.width(), input.height(), input.read({"R", "G", "B"})};
    if (input.kind() == ImageKind::png) {
        check_opaque(path, input);
        decode_srgb(result.picture.rgb, (1u << result.bits) - 1);
    } else if (input.has("Motion.X") && input.has("Motion.Y")) {
        result.motion = motion_of(input);
    }
    check_finite(path, result.picture);
    return result;
}

metric::MotionField read_motion(const fs::path& path) {
    Input input(path);
    return motion_of(input);
}

} // namespace macula::output
