/// `macula gaze`: recordings of other programs into ours, and what a gaze looks like in numbers.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "host/app/command.hpp"
#include "scenes/gaze/import.hpp"
#include "scenes/gaze/spec.hpp"

namespace {

using namespace macula;

struct Import {
    std::filesystem::path file, out, head_out;
    std::string format;
};

struct Sample {
    std::string gaze, tracker, display = "dk2";
    double seconds = 5.0, rate = 0.0;
};

/// Whole or not at all.
void write_text(const std::filesystem::path& path, const std::string& text) {
    const std::filesystem::path temporary = path.string() + ".part";
    {
        std::ofstream file(temporary, std::ios::binary);
        file << text;
        file.close();
        if (!file)
            throw std::runtime_error(fmt::format("writing '{}' failed", temporary.string()));
    }
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error)
        throw std::runtime_error(fmt::format("writing '{}': {}", path.string(), error.message()));
}

void report(const char* what, std::size_t samples, std::int64_t last_ns,
            const std::filesystem::path& path) {
    fmt::print("{}: {} samples, {:.2f} s{}\n", what, samples, 1e-9 * static_cast<double>(last_ns),
               path.empty() ? "" : " -> " + path.string());
}

int import_trace(const Import& options) {
    const scene::ImportedTrace trace = scene::import_trace(options.file, options.format);
    const auto& gaze = trace.gaze.samples;
    const auto& head = trace.head.samples;
    if (!options.out.empty() && gaze.empty())
        throw std::invalid_argument(options.file.string() + " holds no gaze, only the head");
    if (!options.head_out.empty() && head.empty())
        throw std::invalid_argument(options.file.string() + " holds no head, only the gaze");
    if (!options.out.empty())
        write_text(options.out, to_csv(trace.gaze));
    if (!options.head_out.empty())
        write_text(options.head_out, to_csv(trace.head));
    fmt::print("format: {}\n", trace.format);
    if (!gaze.empty())
        report("gaze", gaze.size(), gaze.back().time_ns, options.out);
    if (!head.empty())
        report("head", head.size(), head.back().time_ns, options.head_out);
    for (const std::string& note : trace.notes)
        fmt::print("note: {}\n", note);
    return 0;
}

int sample_gaze(const Sample& options) {
    const scene::Display display = scene::find_display(options.display);
    const double rate = options.rate > 0.0 ? options.rate : display.refresh_hz;
    if (!(options.seconds >= 0.0 && options.seconds <= 86400.0 && rate <= 1e5))
        throw std::invalid_argument("--seconds must be 0 to 86400 and --rate at most 100000");
    const scene::GazePointer gaze =
        scene::tracked(scene::parse_gaze(options.gaze, {display, scene::Eye::mono, {}}),
                       scene::parse_tracker(options.tracker));
    fmt::print("seconds,measured,right_degrees,up_degrees,valid,confidence,widening\n");
    for (std::int64_t i = 0; static_cast<double>(i) / rate <= options.seconds; ++i) {
        const scene::GazeSample s = gaze->at(std::llround(static_cast<double>(i) * (1e9 / rate)));
        const glm::dvec2 angles = scene::angles_of_direction(s.direction);
        fmt::print("{:.6f},{:.6f},{:.4f},{:.4f},{:d},{:.3f},{:.3f}\n",
                   static_cast<double>(i) / rate, 1e-9 * static_cast<double>(s.time_ns), angles.x,
                   angles.y, s.valid, s.confidence, s.widening);
    }
    return 0;
}

app::Run add(CLI::App& command) {
    auto import = std::make_shared<Import>();
    auto sample = std::make_shared<Sample>();
    CLI::App* importing =
        command.add_subcommand("import", "Turn a recording of another program into ours");
    importing->add_option("file", import->file, "The recording")->required();
    importing->add_option("--out", import->out, "The gaze, for --gaze FILE.csv");
    importing->add_option("--head-out", import->head_out, "The head, for --head FILE.csv");
    importing->add_option("--format", import->format,
                          fmt::format("One of {} (default: told by its first line)",
                                      fmt::join(scene::trace_formats(), ", ")));
    CLI::App* sampling =
        command.add_subcommand("sample", "Print where a gaze looks, one line a frame");
    sampling->add_option("gaze", sample->gaze, "As --gaze of render")->required();
    sampling->add_option("--tracker", sample->tracker, "As --tracker of render");
    sampling->add_option("--display", sample->display, "Whose refresh rate and pixels count")
        ->capture_default_str();
    sampling->add_option("--seconds", sample->seconds, "How long")->capture_default_str();
    sampling->add_option("--rate", sample->rate, "Lines a second (default: the display's)");
    command.require_subcommand(1);
    return [import, sample, importing] {
        return importing->parsed() ? import_trace(*import) : sample_gaze(*sample);
    };
}

const app::Command command("gaze", "Import recorded gaze and heads; print a gaze in numbers", add);

} // namespace
