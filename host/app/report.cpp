/// `macula report`: results of `macula bench quality` as one page.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "host/app/command.hpp"
#include "host/output/jpeg.hpp"
#include "host/report/page.hpp"
#include "host/report/results_file.hpp"

namespace {

using namespace macula;

struct Options {
    std::vector<std::filesystem::path> results;
    std::filesystem::path out = "report.html";
    int jpeg = 0; // quality; 0: the files as they are
    std::string title = "Macula: quality against time";
};

/// Under another name first: what is there is whole.
void write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::path part = path;
    part += ".part";
    std::ofstream file(part, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file)
        std::filesystem::rename(part, path, error);
    if (file && !error)
        return;
    const std::string cause = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(part, error);
    throw std::runtime_error(fmt::format("report: writing '{}' failed: {}", path.string(), cause));
}

int run(const Options& options) {
    std::vector<report::Results> results;
    for (const std::filesystem::path& file : options.results)
        results.push_back({file, report::read_results(file)});
    report::Load load = report::load_picture;
    if (options.jpeg != 0)
        load = [&](const std::filesystem::path& file) {
            return output::as_jpeg(file, options.jpeg);
        };
    write(options.out, report::page(results, options.title, load));
    std::size_t cases = 0;
    for (const report::Results& part : results)
        cases += part.cases.size();
    fmt::print("{}: {} cases, {:.1f} MB\n", options.out.string(), cases,
               1e-6 * static_cast<double>(std::filesystem::file_size(options.out)));
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    command
        .add_option("results", options->results,
                    "Files of JSON lines that `macula bench quality` wrote")
        ->required();
    command.add_option("-o,--out", options->out, "The page")->capture_default_str();
    command
        .add_option("--jpeg", options->jpeg,
                    "Quality, 1 to 100: the pictures as JPEG, which makes the page small (default: "
                    "the files as they are)")
        ->check(CLI::Range(1, 100));
    command.add_option("--title", options->title, "Its heading")->capture_default_str();
    return [options] { return run(*options); };
}

const app::Command command("report", "Show results of `bench quality` as one page of HTML", add);

} // namespace
