#include "host/app/compare_run.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "host/metric/heat_map.hpp"
#include "host/output/image.hpp"
#include "host/output/read_image.hpp"

namespace macula::app {
namespace {

namespace fs = std::filesystem;
using output::ImageKind;

const char* describe(ImageKind kind) {
    return kind == ImageKind::png ? "a PNG file (8 or 16 bit integers, sRGB)"
                                  : "an EXR file (floats, linear)";
}

/// The pictures of one frame.
struct Pair {
    output::ReadPicture reference, test;
};

Pair read_pair(const fs::path& reference, const fs::path& test, bool hdr) {
    Pair pair{output::read_picture(reference), output::read_picture(test)};
    if (pair.reference.kind != pair.test.kind)
        throw std::runtime_error(fmt::format("'{}' is {}, '{}' is {}: one kind was expected",
                                             reference.string(), describe(pair.reference.kind),
                                             test.string(), describe(pair.test.kind)));
    if (pair.reference.kind == ImageKind::png && pair.reference.bits != pair.test.bits)
        throw std::runtime_error(fmt::format("'{}' has {} bits a channel, '{}' {}: one depth was "
                                             "expected",
                                             reference.string(), pair.reference.bits, test.string(),
                                             pair.test.bits));
    if (hdr && pair.reference.kind == ImageKind::png)
        throw std::runtime_error(fmt::format("'{}' is {}: --hdr needs EXR files",
                                             reference.string(), describe(pair.reference.kind)));
    const metric::Picture &r = pair.reference.picture, &t = pair.test.picture;
    if (r.width != t.width || r.height != t.height)
        throw std::runtime_error(fmt::format("'{}' has {} x {} pixels, '{}' {} x {}",
                                             reference.string(), r.width, r.height, test.string(),
                                             t.width, t.height));
    return pair;
}

/// heat.png -> heat_2.png of the second test, heat_2_0007.png of its frame 7; .exr likewise.
fs::path map_path(const std::string& name, bool several_tests, unsigned test, bool sequence,
                  std::uint32_t frame) {
    const fs::path path = name;
    if (path.extension() != ".png" && path.extension() != ".exr")
        throw std::invalid_argument(
            fmt::format("heat map \"{}\": a .png or .exr file was expected", name));
    std::string stem = path.stem().string();
    if (several_tests)
        stem += fmt::format("_{}", test);
    if (sequence)
        stem += fmt::format("_{:04}", frame);
    return path.parent_path() / (stem + path.extension().string());
}

void write_map(const fs::path& path, const metric::ScalarMap& errors, Compared& result) {
    if (!path.parent_path().empty())
        fs::create_directories(path.parent_path());
    const output::Metadata metadata{
        {"version", MACULA_VERSION},
        {"reference", result.reference},
        {"test", result.test},
        {"pixels_per_degree", fmt::format("{}", result.pixels_per_degree)}};
    if (path.extension() == ".exr") {
        std::vector<std::uint32_t> words(errors.values.size());
        std::memcpy(words.data(), errors.values.data(), words.size() * sizeof(float));
        const output::Layer layer{{"FLIP"}, words, 1, false};
        output::write_exr(path, errors.width, errors.height, {&layer, 1}, metadata);
    } else {
        const metric::Picture picture = metric::heat_picture(errors);
        output::write_png(path, picture.width, picture.height, picture.rgb, 3, 1.0f, metadata);
    }
    result.heat_maps.push_back(path.string());
}

class Comparison {
  public:
    Comparison(const CompareOptions& options, const FrameList& reference, const FrameList& test,
               const FrameList* motion, unsigned test_number)
        : options_(options), reference_(reference), test_(test), motion_(motion),
          test_number_(test_number) {
        result_.reference = reference.name;
        result_.test = test.name;
    }

    Compared run() {
        std::vector<metric::FrameScores> all;
        for (const auto& [frame, file] : reference_.files) {
            result_.frames.push_back(compare(frame, file, test_.files.at(frame)));
            all.push_back(result_.frames.back().scores);
        }
        result_.mean = metric::average(all);
        finish_temporal();
        return std::move(result_);
    }

  private:
    ComparedFrame compare(std::uint32_t frame, const fs::path& reference, const fs::path& test) {
        const Pair pair = read_pair(reference, test, options_.hdr);
        const metric::Picture& r = pair.reference.picture;
        look_at(r, reference);
        ComparedFrame result;
        result.frame = frame;
        std::optional<metric::View> view;
        if (view_->has_gaze()) {
            const glm::dvec3 direction = view_->direction(frame);
            result.gaze = scene::angles_of_direction(direction);
            view = view_->looking_at(direction);
        }
        result.scores =
            metric::score(r, pair.test.picture, score_options(options_, view_->pixels_per_degree()),
                          view ? &*view : nullptr);
        write_maps(frame, result.scores);
        result.scores.flip_map = result.scores.foveated_map = {};
        if (reference_.sequence)
            result.temporal = compare_in_time(frame, pair, view);
        return result;
    }

    void look_at(const metric::Picture& picture, const fs::path& file) {
        if (!view_) {
            view_.emplace(options_, picture.width, picture.height);
            result_.width = picture.width;
            result_.height = picture.height;
            result_.pixels_per_degree = view_->pixels_per_degree();
            result_.pixels_per_degree_source = view_->pixels_per_degree_source();
            if (!options_.display.empty())
                result_.display = view_->display().name;
            if (!view_->has_gaze())
                temporal_ = metric::TemporalScores(std::vector<metric::Band>{});
        }
        if (picture.width != result_.width || picture.height != result_.height)
            throw std::runtime_error(
                fmt::format("'{}' has {} x {} pixels, the frames before it {} x {}", file.string(),
                            picture.width, picture.height, result_.width, result_.height));
    }

    void write_maps(std::uint32_t frame, const metric::FrameScores& scores) {
        const auto path = [&](const std::string& name) {
            return map_path(name, options_.pictures.size() > 2, test_number_, reference_.sequence,
                            frame);
        };
        if (!options_.heat_map.empty())
            write_map(path(options_.heat_map), scores.flip_map, result_);
        if (!options_.foveated_heat_map.empty())
            write_map(path(options_.foveated_heat_map), scores.foveated_map, result_);
    }

    std::vector<metric::TemporalScore> compare_in_time(std::uint32_t frame, const Pair& pair,
                                                       const std::optional<metric::View>& view) {
        std::optional<metric::MotionField> motion;
        if (motion_ != nullptr) {
            motion = output::read_motion(motion_->files.at(frame));
            if (motion->width != result_.width || motion->height != result_.height)
                throw std::runtime_error(
                    fmt::format("'{}' has {} x {} pixels, the pictures {} x {}",
                                motion_->files.at(frame).string(), motion->width, motion->height,
                                result_.width, result_.height));
        } else if (!options_.still) {
            motion = pair.reference.motion;
        }
        if (!motion && !options_.still) {
            has_motion_ = false;
            return {};
        }
        const metric::Picture& r = pair.reference.picture;
        return temporal_.add(r, pair.test.picture,
                             view ? view->eccentricity : metric::ScalarMap(r.width, r.height),
                             motion ? &*motion : nullptr);
    }

    void finish_temporal() {
        if (!has_motion_)
            result_.no_temporal = "the motion is not known: give --motion, --still, or a reference "
                                  "with the channels Motion.X and Motion.Y";
        else if (result_.frames.size() < 2)
            result_.no_temporal = "there is only one frame";
        else
            result_.temporal = temporal_.total();
        for (ComparedFrame& frame : result_.frames) {
            if (result_.temporal.empty())
                frame.temporal.clear();
        }
    }

    const CompareOptions& options_;
    const FrameList &reference_, &test_;
    const FrameList* motion_;
    unsigned test_number_;
    std::optional<CompareView> view_; // once the pictures' size is known
    metric::TemporalScores temporal_;
    bool has_motion_ = true;
    Compared result_;
};

} // namespace

Compared compare_frames(const CompareOptions& options, const FrameList& reference,
                        const FrameList& test, const FrameList* motion, unsigned test_number) {
    return Comparison(options, reference, test, motion, test_number).run();
}

} // namespace macula::app
