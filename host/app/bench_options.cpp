#include "host/app/bench_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "host/app/view_options.hpp"

namespace macula::app {

std::vector<frame::LightMode> parse_lights(const std::vector<std::string>& names) {
    std::vector<frame::LightMode> modes;
    for (const std::string& name : names) {
        const auto mode = frame::parse_light_mode(name);
        if (!mode)
            throw std::invalid_argument(
                fmt::format("--lights \"{}\": point, area, soft or ao was expected", name));
        modes.push_back(*mode);
    }
    return modes;
}

std::pair<std::uint32_t, std::uint32_t> parse_size(const std::string& size) {
    if (size.empty())
        return {0, 0};
    ViewOptions view;
    view.size = size;
    const std::pair<std::uint32_t, std::uint32_t> pixels = size_of(view, 0, 0);
    if (pixels.first == 0 || pixels.second == 0)
        throw std::invalid_argument("--size \"" + size + "\": no pixels");
    return pixels;
}

std::function<void(const std::string& line)> progress_line() {
    return [terminal = isatty(STDERR_FILENO) != 0](const std::string& line) {
        if (terminal)
            fmt::print(stderr, "\r\033[K{}\r", line);
    };
}

} // namespace macula::app
