/// `macula render`: frames of a scene into files.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>

#include "host/app/aov.hpp"
#include "host/app/command.hpp"
#include "host/app/frame_files.hpp"
#include "host/app/render_options.hpp"
#include "host/kernel/variants.hpp"

namespace {

using namespace macula;

// Set by Ctrl-C: the frame in progress is finished and written, then the loop ends.
volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int /*signal*/) {
    interrupted = 1;
}

constexpr int kInterrupted = 130; // as shells report SIGINT

output::Metadata metadata_of(const app::RenderOptions& options, const compute::Device& device) {
    return {{"version", MACULA_VERSION},
            {"commit", MACULA_COMMIT},
            {"scene", options.scene},
            {"method", options.method},
            {"lights", options.lights},
            {"samples_per_pixel", std::to_string(options.samples_per_pixel)},
            {"light_samples", std::to_string(options.light_samples)},
            {"ambient_occlusion_samples", std::to_string(options.ambient_occlusion_samples)},
            {"seed", std::to_string(options.seed)},
            {"device", device.facts().name},
            {"driver", device.facts().driver_version}};
}

nlohmann::ordered_json to_json(const render::FrameReport& report, const render::Renderer& renderer,
                               const std::vector<std::filesystem::path>& files) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::array();
    for (const frame::StageTime& stage : report.stages) {
        stages.push_back({{"stage", stage.stage},
                          {"launches", stage.launches},
                          {"device_ms", stage.device_ms},
                          {"host_ms", stage.host_ms}});
    }
    nlohmann::ordered_json rays;
    for (const kernel::RayClass ray_class : kernel::kRayClasses) {
        if (report.rays[static_cast<std::size_t>(ray_class)] != 0)
            rays[kernel::name(ray_class)] = report.rays[static_cast<std::size_t>(ray_class)];
    }
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const auto& file : files)
        names.push_back(file.string());
    return {{"frame", report.frame}, {"wall_ms", report.wall_ms}, {"rays", rays},
            {"stages", stages},      {"hash", renderer.hash()},   {"files", names}};
}

// One line that is written over; nothing when standard error is no terminal.
class Progress {
  public:
    explicit Progress(app::FrameRange range) : range_(range), shown_(isatty(STDERR_FILENO) != 0) {}
    ~Progress() {
        if (shown_)
            std::fputc('\n', stderr);
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const render::FrameReport& report) const {
        if (!shown_)
            return;
        constexpr std::uint32_t width = 30;
        const std::uint32_t done = report.frame + 1 - range_.first, all = range_.end - range_.first;
        const std::uint32_t filled = static_cast<std::uint32_t>(std::uint64_t{done} * width / all);
        fmt::print(stderr, "\r[{:=<{}}{: <{}}] {}/{} {:.1f} ms ", "", filled, "", width - filled,
                   done, all, report.wall_ms);
        std::fflush(stderr);
    }

  private:
    app::FrameRange range_;
    bool shown_;
};

int render_frames(const app::RenderOptions& options) {
    const compute::Device device = compute::open(options.device);
    const render::Options engine = app::engine_options(options);
    const app::FrameRange range = app::parse_frames(options.frames);
    const app::FrameFiles files(options.out, options.formats, options.aovs, options.exposure,
                                metadata_of(options, device));
    const scene::Scene scene = app::load_scene(options);
    for (const std::string& warning : scene.warnings)
        fmt::print(stderr, "macula: warning: {}\n", warning);
    render::Renderer renderer(device, scene, engine);
    for (const std::string& note : renderer.geometry().notes)
        fmt::print(stderr, "macula: {}\n", note);
    const bool json = options.json || (isatty(STDOUT_FILENO) == 0 && !options.hash);
    std::signal(SIGINT, on_interrupt);
    const Progress progress(range);
    bool skipped = false;
    for (std::uint32_t frame = range.first; frame < range.end && interrupted == 0; ++frame) {
        if (options.resume && files.exist(frame)) {
            skipped = true;
            continue;
        }
        if (skipped) // motion vectors need the view before
            renderer.render(frame - 1);
        skipped = false;
        const render::FrameReport report = renderer.render(frame);
        const auto written = files.write(renderer, frame);
        if (options.hash)
            fmt::print("hash {}\n", renderer.hash());
        if (json)
            fmt::print("{}\n", to_json(report, renderer, written).dump());
        std::fflush(stdout);
        progress.show(report);
    }
    return interrupted != 0 ? kInterrupted : 0;
}

int run(const app::RenderOptions& options) {
    if (options.list_variants) {
        const compute::Device device = compute::open(options.device);
        fmt::print("{}", kernel::list_variants(kernel::traits_of(device)));
        return 0;
    }
    if (options.list_aovs) {
        for (const app::Aov& aov : app::aovs())
            fmt::print("{:16} {}\n", aov.name, fmt::join(aov.channels, ", "));
        return 0;
    }
    if (options.scene.empty())
        throw std::invalid_argument("render: which scene? A built-in name or a file");
    return render_frames(options);
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<app::RenderOptions>();
    options->add_to(command);
    return [options] { return run(*options); };
}

const app::Command command("render", "Render frames of a scene into EXR and PNG files", add);

} // namespace
