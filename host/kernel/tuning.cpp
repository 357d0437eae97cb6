#include "host/kernel/tuning.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "host/cl/facts.hpp"
#include "host/kernel/program_cache.hpp"

namespace macula::kernel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kFormat = 1;
// Far above any real file; keeps a wrong one from being read into memory.
constexpr std::uintmax_t kMostBytes = 1u << 20;

fs::path file_of(const fs::path& folder, const Tuning& tuning) {
    std::string name;
    for (const char c : tuning.vendor + "-" + tuning.device) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                           (c >= 'a' && c <= 'z') || c == '-' || c == '.';
        name += plain ? c : '_';
    }
    // Names of files end at 255 bytes, and a temporary one is longer.
    return folder / (name.substr(0, 200) + ".json");
}

DeviceTraits traits_of(const compute::DeviceFacts& facts) {
    return {.gpu = facts.type == compute::DeviceType::gpu,
            .compute_units = std::max(facts.compute_units, 1u),
            .max_work_group = static_cast<std::uint32_t>(facts.max_work_group_size)};
}

Choice parse_choice(const Json& entry, const DeviceTraits& device, RayClass ray_class) {
    Choice choice;
    choice.variant = &find_variant(entry.at("variant").get<std::string>());
    choice.parameters = entry.at("parameters").get<ParameterValues>();
    check_parameters(*choice.variant, choice.parameters);
    const std::string reason = why_not(*choice.variant, device, ray_class);
    if (!reason.empty())
        throw std::invalid_argument(std::string("variant ") + choice.variant->name + " " + reason);
    return choice;
}

void parse_choices(const Json& classes, const DeviceTraits& device, LoadedTuning& loaded) {
    for (const auto& [key, entry] : classes.items()) {
        try {
            const std::optional<RayClass> ray_class = parse_ray_class(key);
            if (!ray_class)
                throw std::invalid_argument("there is no such ray class");
            loaded.tuning.choices[*ray_class] = parse_choice(entry, device, *ray_class);
        } catch (const std::exception& error) {
            loaded.warnings.push_back("tuning file " + loaded.file.string() + ": \"" + key +
                                      "\" is left out: " + error.what());
        }
    }
}

Json read_json(const fs::path& file) {
    if (fs::file_size(file) > kMostBytes)
        throw std::runtime_error("it is larger than 1 MiB");
    std::ifstream stream(file);
    if (!stream)
        throw std::runtime_error("it cannot be opened");
    const Json json = Json::parse(stream);
    const int format = json.at("format").get<int>();
    if (format != kFormat)
        throw std::runtime_error("its format is " + std::to_string(format) + ", not " +
                                 std::to_string(kFormat));
    return json;
}

// Fills `loaded` from a file that is of the device, or at least of its vendor and type.
bool load_file(const fs::path& file, const compute::DeviceFacts& device, bool same_device,
               LoadedTuning& loaded) {
    try {
        const Json json = read_json(file);
        Tuning tuning;
        tuning.device = json.at("device").get<std::string>();
        tuning.vendor = json.at("vendor").get<std::string>();
        tuning.driver = json.at("driver").get<std::string>();
        tuning.type = json.at("type").get<std::string>();
        if (tuning.vendor != device.vendor || tuning.type != compute::to_string(device.type) ||
            (same_device && tuning.device != device.name))
            return false;
        const Json& classes = json.at("classes");
        loaded.tuning = std::move(tuning);
        loaded.file = file;
        parse_choices(classes, traits_of(device), loaded);
        return true;
    } catch (const std::exception& error) {
        loaded.warnings.push_back("tuning file " + file.string() + " is ignored: " + error.what());
        return false;
    }
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
        if (i->path().extension() == ".json")
            files.push_back(i->path());
    }
    std::ranges::sort(files);
    return files;
}

Json to_json(const Tuning& tuning) {
    Json classes = Json::object();
    for (const auto& [ray_class, choice] : tuning.choices)
        classes[name(ray_class)] = {{"variant", choice.variant->name},
                                    {"parameters", choice.parameters}};
    return {{"format", kFormat},       {"device", tuning.device}, {"vendor", tuning.vendor},
            {"driver", tuning.driver}, {"type", tuning.type},     {"classes", classes}};
}

} // namespace

Tuning Tuning::of(const compute::DeviceFacts& device) {
    return {device.name, device.vendor, device.driver_version, compute::to_string(device.type), {}};
}

fs::path tuning_folder() {
    const fs::path cache = ProgramCache::default_folder();
    return cache.empty() ? fs::path() : cache / "tuning";
}

LoadedTuning load_tuning(const fs::path& folder, const compute::DeviceFacts& device) {
    LoadedTuning loaded;
    loaded.tuning = Tuning::of(device);
    if (folder.empty())
        return loaded;
    const fs::path own = file_of(folder, loaded.tuning);
    std::error_code error;
    if (fs::exists(own, error) && load_file(own, device, true, loaded))
        return loaded;
    for (const fs::path& file : files_in(folder)) {
        if (file != own && load_file(file, device, false, loaded))
            return loaded;
    }
    return loaded;
}

fs::path store_tuning(const fs::path& folder, const Tuning& tuning) {
    if (folder.empty())
        throw std::invalid_argument("storing the tuning: there is no cache directory; set "
                                    "MACULA_CACHE_DIR, XDG_CACHE_HOME or HOME");
    const fs::path file = file_of(folder, tuning);
    const fs::path temporary = file.string() + "." + std::to_string(::getpid());
    std::error_code error;
    fs::create_directories(folder, error);
    std::ofstream stream(temporary);
    stream << to_json(tuning).dump(2) << '\n';
    stream.close();
    if (!stream) {
        fs::remove(temporary, error);
        throw std::runtime_error("storing the tuning: " + temporary.string() +
                                 " cannot be written");
    }
    fs::rename(temporary, file, error);
    if (error) {
        const std::string reason = error.message();
        fs::remove(temporary, error);
        throw std::runtime_error("storing the tuning: renaming to " + file.string() + ": " +
                                 reason);
    }
    return file;
}

} // namespace macula::kernel
