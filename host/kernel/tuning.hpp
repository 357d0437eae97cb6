// What `macula tune` measured: which variant, with which parameters, is fastest for each class of
// rays. One JSON file for each device in the user's cache directory; a device that was never tuned
// takes the figures of another one of its vendor and type, and else the registry's defaults.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/kernel/variants.hpp"

namespace macula::compute {
struct DeviceFacts;
}

namespace macula::kernel {

struct Tuning {
    std::string device, vendor, driver;
    std::string type; // compute::to_string of the device's type
    std::map<RayClass, Choice> choices;

    // Without choices, for the device.
    static Tuning of(const compute::DeviceFacts& device);
};

struct LoadedTuning {
    Tuning tuning;
    std::filesystem::path file; // empty: nothing usable was found
    std::vector<std::string> warnings;
};

// "tuning" in the cache folder of ProgramCache::default_folder(); empty when there is none.
std::filesystem::path tuning_folder();

// Looks for the device's file, then for the first other one, by file name, of the same vendor and
// type. Never throws: a file that cannot be read or makes no sense, and an entry whose variant is
// unknown, does not apply, or has parameters out of range, gives a warning and is left out.
LoadedTuning load_tuning(const std::filesystem::path& folder, const compute::DeviceFacts& device);

// Written to a temporary file, then renamed; returns the file. Throws std::runtime_error naming the
// file when that fails, std::invalid_argument for an empty folder.
std::filesystem::path store_tuning(const std::filesystem::path& folder, const Tuning& tuning);

} // namespace macula::kernel
