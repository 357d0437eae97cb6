#include "bench/quality_pictures.hpp"

#include <cctype>

#include <fmt/format.h>

#include "host/metric/heat_map.hpp"
#include "host/output/image.hpp"

namespace macula::bench {

std::string file_name_of(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
        if (plain)
            name += c;
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    return name;
}

bool is_pictured(std::uint32_t i, std::uint32_t frames, std::uint32_t pictures) {
    const auto before = [&](std::uint32_t k) { return std::uint64_t{k} * pictures / frames; };
    return before(i + 1) != before(i);
}

void add_picture(report::QualityCase& result, const std::filesystem::path& folder,
                 std::uint32_t frame, const scene::Display& display, const glm::dvec3& look,
                 const metric::Picture& reference, const metric::Picture& test,
                 const metric::ScalarMap& flip) {
    const std::filesystem::path below =
        std::filesystem::path("pictures") / file_name_of(result.scene + "_" + result.lights);
    std::filesystem::create_directories(folder / below);
    const auto write = [&](const std::string& name, const metric::Picture& picture) {
        const std::string file = (below / fmt::format("{:04}_{}.png", frame, name)).string();
        output::write_png(folder / file, picture.width, picture.height, picture.rgb, 3, 1.0f, {});
        return file;
    };
    report::Picture entry;
    entry.frame = frame;
    double x = 0.0, y = 0.0;
    if (scene::project(display, scene::Eye::mono, look, x, y))
        entry.gaze = {x, y};
    const std::string name = file_name_of(result.name);
    entry.reference = write("reference", reference);
    entry.test = write(name, test);
    entry.heat_map = write(name + "_heat", metric::heat_picture(flip));
    result.pictures.push_back(entry);
}

} // namespace macula::bench
