/// `macula explain METHOD`: the stages of a method in words.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>

#include "host/app/aov.hpp"
#include "host/app/command.hpp"
#include "host/app/render_options.hpp"
#include "host/method/method.hpp"
#include "scenes/load.hpp"

namespace {

using namespace macula;

int list_methods() {
    for (const method::Method& method : method::methods())
        fmt::print("{:16} {}\n", method.name, method.purpose);
    return 0;
}

// The stages are those of a small frame: they depend on the lights, on the images asked for and on
// whether something reflects, not on the scene's size or the frame's.
int run(const app::RenderOptions& options) {
    if (options.method.empty())
        return list_methods();
    method::find_method(options.method); // an unknown one is refused before a device is opened
    render::Options engine = app::engine_options(options);
    engine.width = engine.height = 64;
    const compute::Device device = compute::open(options.device);
    const char* scene = engine.depth > 0 ? "cornell_spheres" : "cornell";
    const render::Renderer renderer(device, scene::load(scene), engine);
    fmt::print("{}", renderer.explain());
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<app::RenderOptions>();
    options->method.clear();
    options->depth = 0;
    app::add_device_option(command, options->device);
    command.add_option("method", options->method, "A method; without it, the methods are listed");
    command.add_option("--lights", options->lights, "point, area, soft or ao")
        ->capture_default_str();
    command
        .add_option("--depth", options->depth,
                    "Levels of reflected and refracted rays, as of a scene that has any")
        ->capture_default_str();
    command.add_option("--aov", options->aovs, "Images besides colour, see render --list-aovs")
        ->delimiter(',');
    return [options] { return run(*options); };
}

const app::Command command("explain", "Print the stages of a method", add);

} // namespace
