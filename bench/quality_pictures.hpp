// The pictures of a case that the report shows.
#pragma once

#include <filesystem>
#include <string>

#include "bench/quality_reference.hpp"
#include "host/report/quality_case.hpp"

namespace macula::bench {

// Letters, digits and underscores.
std::string file_name_of(const std::string& text);

// Whether the i-th of the measured frames is one of `pictures` that are spread over them evenly.
bool is_pictured(std::uint32_t i, std::uint32_t frames, std::uint32_t pictures);

// Writes reference, test and heat map of a frame below `folder`/pictures/SCENE_LIGHTS and adds them
// to the result. Throws std::runtime_error.
void add_picture(report::QualityCase& result, const std::filesystem::path& folder,
                 std::uint32_t frame, const scene::Display& display, const glm::dvec3& look,
                 const metric::Picture& reference, const metric::Picture& test,
                 const metric::ScalarMap& flip);

} // namespace macula::bench
