#include "host/kernel/source.hpp"

#include "host/cl/error.hpp"
#include "host/kernel/embedded.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace macula::kernel {
namespace {

namespace fs = std::filesystem;

bool read_file(const fs::path& path, std::string& text) {
    std::ifstream file(path, std::ios::binary);
    if (!file || !fs::is_regular_file(path))
        return false;
    text.assign(std::istreambuf_iterator<char>(file), {});
    return true;
}

/// The path of `#include "path"`, or empty when the line is no such directive.
std::string included_path(std::string_view line) {
    const auto skip_blanks = [&] {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    };
    const auto skip = [&](std::string_view word) {
        skip_blanks();
        if (!line.starts_with(word))
            return false;
        line.remove_prefix(word.size());
        return true;
    };
    if (!skip("#") || !skip("include") || !skip("\""))
        return {};
    return std::string(line.substr(0, line.find('"')));
}

std::string line_directive(std::size_t line, const std::string& display) {
    std::string quoted;
    for (const char c : display)
        quoted += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    return "#line " + std::to_string(line) + " \"" + quoted + "\"\n";
}

/// "a/b/../c.h" and "./c.h" name one file: cycles are found by name.
std::string normal(const fs::path& path) {
    return path.lexically_normal().generic_string();
}

} // namespace

Sources::Sources(fs::path overlay) : overlay_(std::move(overlay)) {
    if (!overlay_.empty() && !fs::is_directory(overlay_))
        throw compute::Error("kernel folder \"" + overlay_.string() +
                             "\" (MACULA_KERNEL_DIR) is not a folder");
}

bool Sources::find(const std::string& path, SourceFile& file) const {
    if (!overlay_.empty() && read_file(overlay_ / path, file.text)) {
        file.display = (overlay_ / path).string();
        return true;
    }
    for (const EmbeddedFile& embedded : embedded_files())
        if (embedded.path == path) {
            file.text = embedded.text;
            file.display = path;
            return true;
        }
    return false;
}

SourceFile Sources::find_included(const std::string& include, const std::string& includer,
                                  const std::string& place,
                                  const std::vector<std::string>& stack) const {
    SourceFile file;
    file.path = normal(include);
    if (!find(file.path, file)) {
        file.path = normal(fs::path(includer).parent_path() / include);
        if (!find(file.path, file))
            throw compute::Error(place + ": there is no kernel file \"" + include + "\"");
    }
    if (std::find(stack.begin(), stack.end(), file.path) != stack.end())
        throw compute::Error(place + ": \"" + include + "\" includes itself");
    return file;
}

void Sources::append(const SourceFile& file, std::vector<std::string>& stack,
                     std::string& out) const {
    stack.push_back(file.path);
    out += line_directive(1, file.display);
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < file.text.size();) {
        const std::size_t end = std::min(file.text.find('\n', begin), file.text.size());
        const std::string_view line = std::string_view(file.text).substr(begin, end - begin);
        begin = end + 1;
        ++number;
        const std::string include = included_path(line);
        if (include.empty()) {
            (out += line) += '\n';
            continue;
        }
        std::string place = file.display;
        (place += ':') += std::to_string(number);
        append(find_included(include, file.path, place, stack), stack, out);
        out += line_directive(number + 1, file.display);
    }
    stack.pop_back();
}

std::string Sources::expand(const std::string& program) const {
    SourceFile file;
    file.path = program + ".cl";
    if (!find(file.path, file))
        throw compute::Error("there is no kernel program \"" + program + "\" (kernels/" +
                             file.path + ")");
    std::string out;
    std::vector<std::string> stack;
    append(file, stack, out);
    return out;
}

std::vector<std::string> Sources::programs() const {
    std::set<std::string> names;
    const auto add = [&](const fs::path& path) {
        if (path.extension() == ".cl")
            names.insert(fs::path(path).replace_extension().generic_string());
    };
    for (const EmbeddedFile& embedded : embedded_files())
        add(embedded.path);
    if (!overlay_.empty())
        for (const auto& entry : fs::recursive_directory_iterator(overlay_))
            add(entry.path().lexically_relative(overlay_));
    return {names.begin(), names.end()};
}

} // namespace macula::kernel
