// One page of HTML that shows results and needs nothing but itself: pictures, style and script are
// in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/report/quality_case.hpp"

namespace macula::report {

// Cases and the folder that their pictures' names start from.
struct Results {
    std::filesystem::path file; // for messages; its folder has the pictures
    std::vector<QualityCase> cases;
};

// The page. Throws std::runtime_error that names file, case and picture where one is missing, lies
// outside the folder, is larger than 32 MiB or is none of PNG, JPEG and WebP.
std::string page(const std::vector<Results>& results, const std::string& title);

} // namespace macula::report
