/// `macula render`: frames of a scene into files.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <memory>

#include "host/app/aov.hpp"
#include "host/app/command.hpp"
#include "host/app/frame_files.hpp"
#include "host/app/render_options.hpp"
#include "host/app/variants.hpp"

namespace {

using namespace macula;

// Set by Ctrl-C: the frame in progress is finished and written, then the loop ends.
volatile std::sig_atomic_t interrupted = 0;

void on_interrupt(int /*signal*/) {
    interrupted = 1;
}

constexpr int kInterrupted = 130; // as shells report SIGINT

output::Metadata metadata_of(const app::RenderOptions& options, const compute::Device& device) {
    const frame::LightMode lights =
        frame::parse_light_mode(options.lights).value_or(frame::LightMode::point);
    const std::uint32_t light_samples =
        options.light_samples.value_or(frame::default_light_samples(lights));
    return {{"version", MACULA_VERSION},
            {"commit", MACULA_COMMIT},
            {"scene", options.scene},
            {"method", options.method},
            {"lights", options.lights},
            {"samples_per_pixel", std::to_string(options.samples_per_pixel)},
            {"light_samples", std::to_string(light_samples)},
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

nlohmann::ordered_json gaze_json(const scene::GazeSample& sample, scene::Eye eye) {
    const glm::dvec2 angles = scene::angles_of_direction(sample.of(eye));
    return {{"degrees", {angles.x, angles.y}},
            {"time_ns", sample.time_ns},
            {"valid", sample.valid},
            {"confidence", sample.confidence},
            {"widening", sample.widening}};
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

/// One eye's view: a renderer with its own history, and its files.
struct EyeRun {
    scene::Eye eye;
    render::Renderer renderer;
    app::FrameFiles files;
    app::EyeFrame view; // of the last frame
};

/// "A" or "A,B": the devices of the eyes; the second eye's is the first's where only one is named.
std::vector<compute::Device> open_devices(const std::string& selectors, std::size_t eyes) {
    const std::size_t comma = eyes == 2 ? selectors.find(',') : std::string::npos;
    std::vector<compute::Device> devices{compute::open(selectors.substr(0, comma))};
    if (comma != std::string::npos)
        devices.push_back(compute::open(selectors.substr(comma + 1)));
    return devices;
}

/// The lens of the display. Throws std::invalid_argument where none is known.
stage::LensDistortion lens_of(const scene::Display& display) {
    for (const scene::Distortion& colour : display.distortion)
        if (!colour.empty())
            return display.distortion;
    throw std::invalid_argument(
        fmt::format("--distort: no distortion is known of the display \"{}\"", display.name));
}

/// `engine`: but for the view.
EyeRun make_eye(const app::RenderOptions& options, render::Options engine,
                std::shared_ptr<render::DeviceScene> on_device, const scene::Scene& scene,
                const app::Views& views, scene::Eye eye, bool alone) {
    engine.width = views.display().width;
    engine.height = views.display().height;
    if (!options.display.empty())
        engine.tangents = app::tangents_of(views.display().eye(eye));
    if (options.distort)
        engine.lens = lens_of(views.display());
    output::Metadata metadata = metadata_of(options, on_device->device);
    metadata.emplace_back("distorted", options.distort ? "yes" : "no");
    if (!options.display.empty()) {
        metadata.emplace_back("display", views.display().name);
        metadata.emplace_back("eye", scene::name(eye));
    }
    if (!options.gaze.empty())
        metadata.emplace_back("gaze", views.gaze_source());
    return {eye,
            render::Renderer(std::move(on_device), scene, engine),
            app::FrameFiles(alone ? options.out : options.out / scene::name(eye), options.formats,
                            options.aovs, options.exposure, std::move(metadata)),
            {}};
}

/// Renders the frame of every eye: at the same time where each has its own device, else one after
/// the other, so that their times are their own.
std::vector<render::FrameReport> render_eyes(std::vector<EyeRun>& eyes, app::Views& views,
                                             std::uint32_t frame, bool together) {
    std::vector<render::FrameReport> reports;
    for (EyeRun& run : eyes) {
        run.view = views.at(frame, run.eye);
        run.renderer.start(frame, run.view.camera, run.view.gaze);
        if (!together)
            reports.push_back(run.renderer.finish());
    }
    for (EyeRun& run : eyes) {
        if (together)
            reports.push_back(run.renderer.finish());
    }
    return reports;
}

/// Writes and prints what a frame of one eye gave.
void deliver(const app::RenderOptions& options, const EyeRun& run,
             const render::FrameReport& report, bool json) {
    const auto written = run.files.write(run.renderer, report.frame);
    if (options.hash)
        fmt::print("hash {}\n", run.renderer.hash());
    if (json) {
        nlohmann::ordered_json line = to_json(report, run.renderer, written);
        line["eye"] = scene::name(run.eye);
        if (!options.gaze.empty())
            line["gaze"] = gaze_json(run.view.sample, run.eye);
        fmt::print("{}\n", line.dump());
    }
    std::fflush(stdout);
}

int render_frames(app::RenderOptions options) {
    const std::vector<scene::Eye> which = app::eyes_of(options);
    const std::vector<compute::Device> devices = open_devices(options.device, which.size());
    const app::FrameRange range = app::parse_frames(options.frames);
    const scene::Scene scene = app::load_scene(options);
    app::take_views_of(scene, options);
    for (const std::string& warning : scene.warnings)
        fmt::print(stderr, "macula: warning: {}\n", warning);
    if (options.variant.empty()) {
        for (const compute::Device& device : devices)
            app::print_tuning_warnings(device);
    }
    app::Views views(options, scene);
    const render::Options engine = app::engine_options(options);
    std::vector<std::shared_ptr<render::DeviceScene>> on_devices;
    for (const compute::Device& device : devices)
        on_devices.push_back(std::make_shared<render::DeviceScene>(device, scene, engine.geometry));
    std::vector<EyeRun> eyes;
    for (std::size_t i = 0; i < which.size(); ++i)
        eyes.push_back(make_eye(options, engine, on_devices[std::min(i, devices.size() - 1)], scene,
                                views, which[i], which.size() == 1));
    for (const std::string& note : eyes.front().renderer.geometry().notes)
        fmt::print(stderr, "macula: {}\n", note);
    const bool json = options.json || (isatty(STDOUT_FILENO) == 0 && !options.hash);
    std::signal(SIGINT, on_interrupt);
    const Progress progress(range);
    const auto is_there = [&](std::uint32_t frame) {
        return options.resume && std::all_of(eyes.begin(), eyes.end(), [&](const EyeRun& run) {
                   return run.files.exist(frame);
               });
    };
    // A history needs all frames before, and motion vectors the last one.
    const bool needs_all = eyes.front().renderer.has_history();
    std::uint32_t end = range.end;
    while (end > range.first && is_there(end - 1))
        --end;
    for (std::uint32_t frame = range.first; frame < end && interrupted == 0; ++frame) {
        const bool done = is_there(frame);
        if (done && !needs_all && is_there(frame + 1))
            continue;
        const auto reports = render_eyes(eyes, views, frame, devices.size() > 1);
        for (std::size_t i = 0; i < eyes.size() && !done; ++i)
            deliver(options, eyes[i], reports[i], json);
        progress.show(reports.front());
    }
    if (const std::string status = views.gaze_status(); !status.empty())
        fmt::print(stderr, "macula: gaze: {}\n", status);
    return interrupted != 0 ? kInterrupted : 0;
}

int run(const app::RenderOptions& options) {
    if (options.list_variants) {
        app::print_variants(compute::open(options.device));
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
