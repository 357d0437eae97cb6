// One page of HTML that shows results and needs nothing but itself: pictures, style and script are
// in it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/report/quality_case.hpp"

namespace macula::report {

// Cases and the folder that their pictures' names start from.
struct Results {
    std::filesystem::path file; // for messages; its folder has the pictures
    std::vector<QualityCase> cases;
};

// What of a picture's file goes into the page. Throws std::runtime_error.
using Load = std::function<std::string(const std::filesystem::path&)>;

// The content as it is; at most 32 MiB.
std::string load_picture(const std::filesystem::path& file);

// The page. Throws std::runtime_error that names file, case and picture where one is missing, lies
// outside the folder, cannot be loaded or is none of PNG, JPEG and WebP.
std::string page(const std::vector<Results>& results, const std::string& title,
                 const Load& load = load_picture);

} // namespace macula::report
