#include "host/cl/error.hpp"
#include "host/cl/facts.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

namespace macula::compute {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string list_of(const std::vector<DeviceFacts>& devices) {
    std::string text;
    for (const DeviceFacts& device : devices)
        text += "\n  " + std::to_string(device.index) + ": " + device.name + " (" +
                to_string(device.type) + ", " + device.platform_name + ")";
    return text;
}

using Match = bool (*)(const DeviceFacts&, const std::string&);

const DeviceFacts* find(const std::vector<DeviceFacts>& devices, const std::string& word,
                        Match matches) {
    const auto found = std::find_if(devices.begin(), devices.end(),
                                    [&](const DeviceFacts& f) { return matches(f, word); });
    return found == devices.end() ? nullptr : &*found;
}

bool is_type(const DeviceFacts& facts, const std::string& type) {
    return to_string(facts.type) == type;
}
bool is_named(const DeviceFacts& facts, const std::string& part) {
    return lower(facts.name).find(part) != std::string::npos;
}
bool is_on_platform(const DeviceFacts& facts, const std::string& part) {
    return lower(facts.platform_name).find(part) != std::string::npos;
}

const DeviceFacts* find_index(const std::vector<DeviceFacts>& devices, const std::string& word) {
    std::size_t index = 0;
    const char* end = word.data() + word.size();
    const auto [rest, problem] = std::from_chars(word.data(), end, index);
    if (problem != std::errc() || rest != end || index >= devices.size())
        return nullptr;
    return &devices[index];
}

const DeviceFacts& default_device(const std::vector<DeviceFacts>& devices) {
    for (const char* type : {"gpu", "cpu"})
        if (const DeviceFacts* found = find(devices, type, is_type))
            return *found;
    return devices.front();
}

} // namespace

const DeviceFacts& select(const std::vector<DeviceFacts>& devices, const std::string& selector) {
    if (devices.empty())
        throw Error("no OpenCL device found; install a driver, for instance the Debian package "
                    "pocl-opencl-icd, which brings a CPU device");
    std::string word = selector;
    std::string origin = "--device";
    if (word.empty()) {
        const char* preset = std::getenv("MACULA_DEVICE");
        if (!preset || !*preset)
            return default_device(devices);
        word = preset;
        origin = "MACULA_DEVICE";
    }
    const DeviceFacts* found = nullptr;
    if (std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); }))
        found = find_index(devices, word);
    else
        for (const Match matches : {is_type, is_named, is_on_platform})
            if (!found)
                found = find(devices, lower(word), matches);
    if (!found)
        throw Error(
            "no OpenCL device matches \"" + word + "\" (" + origin +
            "): give an index, a part of a name, cpu or gpu; there are:" + list_of(devices));
    return *found;
}

} // namespace macula::compute
