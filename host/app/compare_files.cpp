#include "host/app/compare_files.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "host/app/render_options.hpp"

namespace macula::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDigits = 9; // of a frame number

/// Names that differ in a number: prefix, digits, suffix.
struct Pattern {
    fs::path folder;
    std::string prefix, suffix;
    std::size_t digits = 0; // at the least

    fs::path file(std::uint32_t frame) const {
        return folder / fmt::format("{}{:0{}}{}", prefix, frame, digits, suffix);
    }
    std::optional<std::uint32_t> number_of(const std::string& name) const {
        if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
            !name.ends_with(suffix))
            return {};
        const std::string number =
            name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
        if (number.size() > kMostDigits ||
            !std::all_of(number.begin(), number.end(), [](unsigned char c) { return isdigit(c); }))
            return {};
        const auto frame = static_cast<std::uint32_t>(std::stoul(number));
        return file(frame).filename() == name ? std::optional(frame) : std::nullopt;
    }
};

/// "frames/a_%04d.png"; nothing where there is no %.
std::optional<Pattern> parse_pattern(const std::string& name) {
    const fs::path path = name;
    const std::string text = path.filename().string();
    const std::size_t percent = text.find('%');
    if (percent == std::string::npos && name.find('%') == std::string::npos)
        return {};
    const std::size_t end = text.find_first_not_of("0123456789", percent + 1);
    const bool whole = percent != std::string::npos && end != std::string::npos &&
                       text[end] == 'd' && text.find('%', end) == std::string::npos &&
                       end - percent <= 3;
    const std::string width = whole ? text.substr(percent + 1, end - percent - 1) : "";
    if (!whole || (!width.empty() && (width.size() != 2 || width[0] != '0')) ||
        path.parent_path().string().find('%') != std::string::npos)
        throw std::invalid_argument(
            fmt::format("\"{}\": one %d or %04d in the file's name was expected", name));
    return Pattern{path.parent_path(), text.substr(0, percent), text.substr(end + 1),
                   width.empty() ? 1 : std::stoul(width)};
}

fs::path folder_of(const Pattern& pattern) {
    return pattern.folder.empty() ? fs::path(".") : pattern.folder;
}

std::map<std::uint32_t, fs::path> files_of(const Pattern& pattern, const std::string& name) {
    std::error_code error;
    std::map<std::uint32_t, fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_of(pattern), error)) {
        const std::string file = entry.path().filename().string();
        if (const auto frame = pattern.number_of(file))
            files.emplace(*frame, pattern.folder / file);
    }
    if (error)
        throw std::runtime_error(fmt::format("reading the folder '{}': {}",
                                             folder_of(pattern).string(), error.message()));
    if (files.empty())
        throw std::runtime_error(fmt::format("\"{}\": there is no such frame", name));
    return files;
}

bool has_kind(const fs::path& folder, const std::string& extension) {
    const auto entries = fs::directory_iterator(folder);
    return std::any_of(begin(entries), end(entries),
                       [&](const auto& e) { return e.path().extension() == extension; });
}

/// Of the frames in a folder: all files with the extension are numbered in one way.
Pattern pattern_of_folder(const fs::path& folder, const std::string& extension) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == extension && !name.starts_with('.'))
            names.push_back(name);
    }
    if (names.empty())
        throw std::runtime_error(
            fmt::format("the folder '{}' holds no .exr or .png files", folder.string()));
    std::sort(names.begin(), names.end());
    const std::string stem = fs::path(names.front()).stem().string();
    std::size_t last = stem.find_last_not_of("0123456789");
    last = last == std::string::npos ? 0 : last + 1;
    Pattern pattern{folder, stem.substr(0, last), extension, stem.size() - last};
    for (const std::string& name : names) {
        if (!pattern.number_of(name))
            throw std::runtime_error(
                fmt::format("'{}': it is not numbered as a frame of this folder ({})",
                            (folder / name).string(), pattern.file(0).filename().string()));
    }
    return pattern;
}

/// One picture's or sequence's files, and how a missing one would be named.
struct Found {
    FrameList list;
    Pattern pattern;
};

Found find(const std::string& name, const std::string& extension) {
    Found found{{name, true, {}}, {}};
    if (const auto pattern = parse_pattern(name)) {
        found.pattern = *pattern;
    } else if (fs::is_directory(name)) {
        found.pattern = pattern_of_folder(name, extension);
    } else {
        std::error_code error;
        if (!fs::exists(name, error))
            throw std::runtime_error(fmt::format("'{}': there is no such file or folder", name));
        found.list = {name, false, {{0, name}}};
        return found;
    }
    found.list.files = files_of(found.pattern, name);
    return found;
}

void check_has(const Found& found, std::uint32_t frame) {
    if (!found.list.files.contains(frame))
        throw std::runtime_error(fmt::format("\"{}\": frame {} is missing ('{}')", found.list.name,
                                             frame, found.pattern.file(frame).string()));
}

void check_frames(const Found& found, const std::vector<std::uint32_t>& expected) {
    for (const std::uint32_t frame : expected)
        check_has(found, frame);
    for (const auto& [frame, file] : found.list.files) {
        if (!std::binary_search(expected.begin(), expected.end(), frame))
            throw std::runtime_error(
                fmt::format("'{}': the reference has no frame {}", file.string(), frame));
    }
}

} // namespace

std::vector<FrameList> list_frames(const std::vector<std::string>& names,
                                   const std::string& frames) {
    const bool exr = std::all_of(names.begin(), names.end(), [](const std::string& name) {
        return !fs::is_directory(name) || has_kind(name, ".exr");
    });
    std::vector<Found> all;
    all.reserve(names.size());
    for (const std::string& name : names)
        all.push_back(find(name, exr ? ".exr" : ".png"));
    const bool sequence = all.front().list.sequence;
    for (const Found& found : all) {
        if (found.list.sequence != sequence)
            throw std::invalid_argument(fmt::format(
                "\"{}\" is a {} and \"{}\" a {}", names.front(), sequence ? "sequence" : "picture",
                found.list.name, sequence ? "picture" : "sequence"));
    }
    if (!sequence && !frames.empty())
        throw std::invalid_argument("--frames: single pictures have no frame numbers");
    const auto& reference = all.front().list.files;
    FrameRange range{reference.begin()->first, reference.rbegin()->first + 1};
    if (!frames.empty())
        range = parse_frames(frames);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t frame = range.first; frame < range.end; ++frame) {
        expected.push_back(frame);
        if (!reference.contains(frame))
            break; // reported below; a range may be astronomically long
    }
    std::vector<FrameList> lists;
    for (Found& found : all) {
        if (!frames.empty())
            std::erase_if(found.list.files, [&](const auto& entry) {
                return entry.first < range.first || entry.first >= range.end;
            });
        check_frames(found, expected);
        lists.push_back(std::move(found.list));
    }
    return lists;
}

FrameList list_motion(const std::string& name, const FrameList& reference) {
    if (!reference.sequence)
        throw std::invalid_argument("--motion: single pictures do not move");
    Found found = find(name, ".exr");
    if (!found.list.sequence)
        throw std::invalid_argument(fmt::format("--motion \"{}\": a sequence was expected", name));
    for (const auto& [frame, file] : reference.files)
        check_has(found, frame);
    return std::move(found.list);
}

} // namespace macula::app
