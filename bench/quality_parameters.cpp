#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/quality.hpp"

namespace macula::bench {
namespace {

struct Key {
    const char* name;
    float stage::WeierOptions::*value;
};

constexpr std::array kKeys = {
    Key{"eps-depth", &stage::WeierOptions::depth_threshold},
    Key{"eps-lum", &stage::WeierOptions::luminance_threshold},
    Key{"eps-edge", &stage::WeierOptions::edge_threshold},
    Key{"eps-stretch", &stage::WeierOptions::stretch_threshold},
    Key{"eps-merge", &stage::WeierOptions::merge_threshold},
    Key{"k-min", &stage::WeierOptions::k_min},
    Key{"k-max", &stage::WeierOptions::k_max},
    Key{"resampled-worth", &stage::WeierOptions::resampled_worth},
};

[[noreturn]] void refuse(const std::string& part) {
    throw std::invalid_argument(
        fmt::format("--parameters: \"{}\": KEY=NUMBER was expected, with eps-depth, eps-lum, "
                    "eps-edge, eps-stretch, eps-merge, k-min, k-max, resampled-worth or t-max",
                    part));
}

void set_parameter(const std::string& part, stage::WeierOptions& options) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals + 1 == part.size())
        refuse(part);
    const std::string name = part.substr(0, equals);
    char* end = nullptr;
    const float value = std::strtof(part.c_str() + equals + 1, &end);
    if (*end != '\0' || !std::isfinite(value))
        refuse(part);
    if (name == "t-max") {
        if (value < 0.0f || value > 1e6f || value != std::floor(value))
            refuse(part);
        options.t_max = static_cast<std::uint32_t>(value);
        return;
    }
    for (const Key& key : kKeys) {
        if (name == key.name) {
            options.*key.value = value;
            return;
        }
    }
    refuse(part);
}

} // namespace

void parse_weier_changes(const std::string& list, stage::WeierOptions& options) {
    for (std::size_t from = 0; from < list.size();) {
        const std::size_t comma = std::min(list.find(',', from), list.size());
        set_parameter(list.substr(from, comma - from), options);
        from = comma + 1;
    }
}

} // namespace macula::bench
