#include "host/report/page.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/report/data_uri.hpp"
#include "host/report/embedded.hpp"

namespace macula::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kGreatestPicture = 32u << 20; // bytes

std::string_view file(std::string_view name) {
    for (const EmbeddedFile& embedded : embedded_files()) {
        if (embedded.path == name)
            return embedded.text;
    }
    throw std::logic_error("report: no embedded file " + std::string(name));
}

std::string escape_html(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&' || c == '<' || c == '>' || c == '"')
            escaped += fmt::format("&#{};", static_cast<int>(c));
        else
            escaped += c;
    }
    return escaped;
}

// JSON inside a script element: no '<' that could end it. Strings alone can hold one.
std::string escape_script(const std::string& json) {
    std::string escaped;
    escaped.reserve(json.size());
    for (const char c : json) {
        if (c == '<')
            escaped += "\\u003c";
        else
            escaped += c;
    }
    return escaped;
}

// The pictures of the page: each file once, under a number, so that no path enters the page.
class Images {
  public:
    explicit Images(const Load& load) : load_(load) {}

    // `what`: for messages.
    std::string add(const fs::path& folder, const std::string& name, const std::string& what) {
        const fs::path relative(name);
        const bool leaves = std::any_of(relative.begin(), relative.end(),
                                        [](const fs::path& part) { return part == ".."; });
        if (name.empty() || relative.is_absolute() || leaves)
            throw std::runtime_error(fmt::format(
                "{} \"{}\": a file below the folder of the results was expected", what, name));
        const fs::path path = folder / relative;
        const auto [known, is_new] = numbers_.emplace(path.string(), std::to_string(all_.size()));
        if (is_new)
            all_[known->second] = read(path, what);
        return known->second;
    }
    const Json& all() const { return all_; }

  private:
    std::string read(const fs::path& path, const std::string& what) const {
        std::string uri;
        try {
            uri = data_uri(load_(path));
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("{}: {}", what, error.what()));
        }
        if (uri.empty())
            throw std::runtime_error(
                fmt::format("{} '{}': neither PNG, JPEG nor WebP", what, path.string()));
        return uri;
    }

    const Load& load_;
    std::map<std::string, std::string> numbers_; // by path
    Json all_ = Json::object();
};

Json data(const std::vector<Results>& results, const Load& load) {
    Images images(load);
    Json cases = Json::array();
    for (const Results& part : results) {
        const fs::path folder = part.file.parent_path();
        for (QualityCase result : part.cases) {
            const std::string where = fmt::format(
                "results '{}', case \"{}\" of {}: ", part.file.string(), result.name, result.scene);
            for (Picture& picture : result.pictures) {
                picture.reference = images.add(folder, picture.reference, where + "picture");
                picture.test = images.add(folder, picture.test, where + "picture");
                picture.heat_map = images.add(folder, picture.heat_map, where + "picture");
            }
            cases.push_back(Json::parse(json_line(result)));
        }
    }
    return {{"cases", std::move(cases)}, {"images", images.all()}};
}

// Replaces each @NAME@ of the template once, and looks at nothing that it put in.
std::string fill_in(std::string_view text,
                    const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string filled;
    while (!text.empty()) {
        std::size_t at = text.size();
        const std::pair<std::string_view, std::string>* next = nullptr;
        for (const auto& value : values) {
            const std::size_t found = text.find(value.first);
            if (found < at) {
                at = found;
                next = &value;
            }
        }
        filled += text.substr(0, at);
        if (next == nullptr)
            break;
        filled += next->second;
        text.remove_prefix(at + next->first.size());
    }
    return filled;
}

std::string script() {
    std::string text = "(() => {\n\"use strict\";\n";
    for (const char* name : {"plots.js", "charts.js", "tables.js", "viewer.js", "page.js"})
        text += file(name);
    return text + "})();";
}

} // namespace

std::string load_picture(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error)
        throw std::runtime_error(fmt::format("'{}': {}", path.string(), error.message()));
    if (size > kGreatestPicture)
        throw std::runtime_error(fmt::format("'{}': larger than 32 MiB", path.string()));
    std::string content(size, '\0');
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(content.data(), static_cast<std::streamsize>(size)))
        throw std::runtime_error(fmt::format("'{}': cannot be read", path.string()));
    return content;
}

std::string page(const std::vector<Results>& results, const std::string& title, const Load& load) {
    return fill_in(file("page.html"),
                   {{"@TITLE@", escape_html(title)},
                    {"@STYLE@", std::string(file("style.css"))},
                    {"@RESULTS@", escape_script(data(results, load).dump(-1, ' ', true))},
                    {"@SCRIPT@", script()}});
}

} // namespace macula::report
