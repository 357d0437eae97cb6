/// Which files `macula compare` compares: pictures, or sequences of numbered frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace macula::app {

/// A picture (`sequence` false, the one frame 0) or numbered frames.
struct FrameList {
    std::string name; // as it was given
    bool sequence = false;
    std::map<std::uint32_t, std::filesystem::path> files; // by frame number
};

/// Each of `names` is a file, a folder of frames named NAME_0003.exr or .png, or a pattern with one
/// %d or %04d. Of folders that hold both formats the EXR files are taken, where all folders have
/// them. `frames`: empty, or "A:B" for a part of the sequences (frames A to B - 1).
/// All lists have the first one's frames, without a gap. Throws std::invalid_argument and
/// std::runtime_error that name the file that is missing or out of place.
std::vector<FrameList> list_frames(const std::vector<std::string>& names,
                                   const std::string& frames);

/// EXR files with the motion of the reference's frames; it may have more of them. Throws as
/// list_frames does.
FrameList list_motion(const std::string& name, const FrameList& reference);

} // namespace macula::app
