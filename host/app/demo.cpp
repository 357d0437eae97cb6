/// `macula demo`: the pictures and the fly-throughs of ./demo, and what they took.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/app/command.hpp"
#include "host/app/fly_through.hpp"
#include "host/app/frame_files.hpp"
#include "host/app/render_options.hpp"
#include "scenes/load.hpp"

namespace {

using namespace macula;

struct Options {
    std::string device;
    std::filesystem::path out = "demo";
};

struct Picture {
    const char* scene;
    frame::LightMode lights;
    std::uint32_t width, height, frame, samples_per_pixel;
};

constexpr Picture kPictures[] = {
    {"atrium", frame::LightMode::ambient_occlusion, 960, 600, 0, 1},
    {"atrium", frame::LightMode::area, 960, 600, 200, 4},
    {"whitted", frame::LightMode::point, 640, 480, 0, 4},
    {"cornell", frame::LightMode::area, 512, 512, 0, 4},
};

// A third of the headset's pixels and a quarter of the screen's, along each axis.
const app::FlyThrough kHall = {"atrium",
                               "dk2",
                               "394x488",
                               "target:speed=60",
                               60,
                               48,
                               {"full", "weier", "lowres", "logpolar+taa+upscale"}};
const app::FlyThrough kMoving = {"whitted_moving",
                                 "desktop_1080p",
                                 "480x270",
                                 "target:speed=30",
                                 30,
                                 48,
                                 {"full", "weier", "rrm", "logpolar+taa+upscale"}};

void print_row(const Picture& picture, const render::Renderer& renderer,
               const render::FrameReport& report) {
    const auto& geometry = renderer.geometry();
    double device_ms = 0.0;
    for (const frame::StageTime& stage : report.stages)
        device_ms += stage.device_ms;
    fmt::print("{:<10} {:<6} {:>5}x{:<5} {:>10} {:>8.2f} s {:>11} {:>9.1f} {:>8.1f} ms\n",
               picture.scene, frame::name(picture.lights), picture.width, picture.height,
               geometry.triangles, geometry.build_seconds, report.total_rays(),
               static_cast<double>(report.total_rays()) / (1e3 * device_ms), device_ms);
    for (const frame::StageTime& stage : report.stages)
        fmt::print("    {:<40} {:>9.2f} ms\n", stage.stage, stage.device_ms);
}

int run(const Options& options) {
    const compute::Device device = compute::open(options.device);
    fmt::print("device: {} ({})\n", device.facts().name, device.facts().driver_version);
    fmt::print("{:<10} {:<6} {:>11} {:>10} {:>10} {:>11} {:>9} {:>11}\n", "scene", "lights", "size",
               "triangles", "BVH", "rays", "Mrays/s", "frame");
    for (const Picture& picture : kPictures) {
        render::Options engine;
        engine.width = picture.width;
        engine.height = picture.height;
        engine.lights = picture.lights;
        engine.samples_per_pixel = picture.samples_per_pixel;
        engine.geometry.cache_directory = app::bvh_cache_folder();
        const scene::Scene scene = scene::load(picture.scene);
        render::Renderer renderer(device, scene, engine);
        renderer.render(picture.frame); // warms up: the first launch of a kernel builds it
        const render::FrameReport report = renderer.render(picture.frame);
        const auto folder = options.out / fmt::format("{}-{}", picture.scene, name(picture.lights));
        const app::FrameFiles files(folder, {"exr", "png"}, {}, 1.0f, {{"scene", picture.scene}});
        files.write(renderer, picture.frame);
        print_row(picture, renderer, report);
    }
    app::fly_through(kHall, device, options.out / "fly-through");
    app::fly_through(kMoving, device, options.out / "moving");
    fmt::print("pictures: {}\n", std::filesystem::absolute(options.out).string());
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    app::add_device_option(command, options->device);
    command.add_option("--out", options->out, "Folder for the pictures")->capture_default_str();
    return [options] { return run(*options); };
}

const app::Command
    command("demo", "Render the demo pictures and fly-throughs, and print what they took", add);

} // namespace
