/// `macula devices`: every platform and device with the facts that matter here.
#include "host/app/command.hpp"
#include "host/cl/facts.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <vector>

namespace {

using macula::compute::DeviceFacts;
using macula::compute::FloatFacts;
using macula::compute::PlatformFacts;
using nlohmann::ordered_json;

ordered_json to_json(const FloatFacts& f) {
    if (!f.supported)
        return {{"supported", false}};
    return {{"supported", true},
            {"denormals", f.denormals},
            {"infinity_and_nan", f.infinity_and_nan},
            {"round_to_nearest", f.round_to_nearest},
            {"round_to_zero", f.round_to_zero},
            {"round_to_infinity", f.round_to_infinity},
            {"fma", f.fma},
            {"correctly_rounded_divide_sqrt", f.correctly_rounded_divide_sqrt},
            {"emulated", f.emulated}};
}

ordered_json to_json(const DeviceFacts& f) {
    return {{"index", f.index},
            {"name", f.name},
            {"vendor", f.vendor},
            {"type", to_string(f.type)},
            {"version", f.version},
            {"c_version", f.c_version},
            {"driver_version", f.driver_version},
            {"full_profile", f.full_profile},
            {"available", f.available},
            {"compiler_available", f.compiler_available},
            {"little_endian", f.little_endian},
            {"address_bits", f.address_bits},
            {"compute_units", f.compute_units},
            {"clock_mhz", f.clock_mhz},
            {"unified_memory", f.unified_memory},
            {"global_memory_bytes", f.global_memory_bytes},
            {"max_allocation_bytes", f.max_allocation_bytes},
            {"max_constant_bytes", f.max_constant_bytes},
            {"global_cache_bytes", f.global_cache_bytes},
            {"cache_line_bytes", f.cache_line_bytes},
            {"local_memory_bytes", f.local_memory_bytes},
            {"local_memory_dedicated", f.local_memory_dedicated},
            {"max_work_group_size", f.max_work_group_size},
            {"max_work_item_sizes", f.max_work_item_sizes},
            {"preferred_float_width", f.preferred_float_width},
            {"native_float_width", f.native_float_width},
            {"fp16", to_json(f.fp16)},
            {"fp32", to_json(f.fp32)},
            {"fp64", to_json(f.fp64)},
            {"images", f.images},
            {"max_image2d", {f.max_image2d_width, f.max_image2d_height}},
            {"profiling_resolution_ns", f.profiling_resolution_ns},
            {"extensions", f.extensions}};
}

ordered_json to_json(const PlatformFacts& platform) {
    ordered_json devices = ordered_json::array();
    for (const DeviceFacts& device : platform.devices)
        devices.push_back(to_json(device));
    return {{"name", platform.name},
            {"vendor", platform.vendor},
            {"version", platform.version},
            {"devices", devices}};
}

const char* yes_no(bool value) {
    return value ? "yes" : "no";
}

std::string mebibytes(std::uint64_t bytes) {
    return fmt::format("{} MiB", bytes >> 20);
}

std::string rounding(const FloatFacts& f) {
    std::string modes;
    const auto add = [&](bool supported, const char* mode) {
        if (supported)
            (modes += modes.empty() ? "" : ", ") += mode;
    };
    add(f.round_to_nearest, "nearest");
    add(f.round_to_zero, "zero");
    add(f.round_to_infinity, "infinity");
    return modes;
}

void print(const DeviceFacts& f) {
    const auto line = [](const char* key, const std::string& value) {
        fmt::print("    {:<16} {}\n", key, value);
    };
    fmt::print("  [{}] {}\n", f.index, f.name);
    line("type", fmt::format("{}, {} compute units, {} MHz", to_string(f.type), f.compute_units,
                             f.clock_mhz));
    line("version", fmt::format("{}; {}", f.version, f.c_version));
    line("driver", fmt::format("{} ({})", f.driver_version, f.vendor));
    line("memory", fmt::format("{}, largest allocation {}, {} the host's",
                               mebibytes(f.global_memory_bytes), mebibytes(f.max_allocation_bytes),
                               f.unified_memory ? "shared with" : "apart from"));
    line("local memory", fmt::format("{} KiB, {}", f.local_memory_bytes >> 10,
                                     f.local_memory_dedicated ? "dedicated" : "ordinary memory"));
    line("work-group", fmt::format("up to {} work-items", f.max_work_group_size));
    line("fp32", fmt::format("rounding to {}; denormals {}, fma {}, correctly rounded division "
                             "and square root {}",
                             rounding(f.fp32), yes_no(f.fp32.denormals), yes_no(f.fp32.fma),
                             yes_no(f.fp32.correctly_rounded_divide_sqrt)));
    line("fp64, fp16", fmt::format("{}, {}", yes_no(f.fp64.supported), yes_no(f.fp16.supported)));
    line("images",
         f.images ? fmt::format("up to {} x {}", f.max_image2d_width, f.max_image2d_height) : "no");
}

int run(bool json) {
    const std::vector<PlatformFacts> all = macula::compute::platforms();
    if (json) {
        ordered_json list = ordered_json::array();
        for (const PlatformFacts& platform : all)
            list.push_back(to_json(platform));
        fmt::print("{}\n", ordered_json{{"platforms", list}}.dump(2));
        return 0;
    }
    for (const PlatformFacts& platform : all) {
        fmt::print("{}, {}{}\n", platform.name, platform.version,
                   platform.devices.empty() ? ": no devices" : "");
        for (const DeviceFacts& device : platform.devices)
            print(device);
    }
    if (macula::compute::enumerate().empty())
        fmt::print("No OpenCL device. Install a driver, for instance the Debian package "
                   "pocl-opencl-icd, which brings a CPU device.\n");
    return 0;
}

macula::app::Run add(CLI::App& command) {
    auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "Print one JSON document");
    return [json] { return run(*json); };
}

const macula::app::Command command("devices", "List the OpenCL platforms and devices", add);

} // namespace
