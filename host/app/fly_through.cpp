#include "host/app/fly_through.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/app/collage.hpp"
#include "host/app/frame_files.hpp"
#include "host/app/render_options.hpp"
#include "host/metric/statistics.hpp"
#include "scenes/load.hpp"

namespace macula::app {
namespace {

constexpr std::uint32_t kColumns = 2; // of the pictures side by side; of the sheet all in a row
// Of logpolar: the thesis's 4 is for pictures of three times this size along each axis.
constexpr float kAlpha = 1.5f;
constexpr std::uint32_t kSheetEvery = 8; // frames between the contact sheet's rows

class Flight {
  public:
    Flight(const FlyThrough& options, const compute::Device& device,
           const std::filesystem::path& out)
        : options_(options), device_(device), out_(out), scene_(scene::load(options.scene)),
          views_(view_options(options), scene_), ms_(options.methods.size()),
          samples_(options.methods.size()) {}

    void run() {
        if (std::ranges::find(options_.methods, std::string("lowres")) != options_.methods.end())
            measure_share();
        std::vector<render::Renderer> renderers;
        std::vector<FrameFiles> files;
        for (const char* method : options_.methods) {
            renderers.push_back(make(method));
            files.emplace_back(out_ / method, std::vector<std::string>{"png"},
                               std::vector<std::string>{}, 1.0f,
                               output::Metadata{{"scene", options_.scene}, {"method", method}});
            render(renderers.back(), options_.first); // builds the kernels
            renderers.back().reset();
        }
        std::filesystem::create_directories(out_ / "side_by_side");
        const auto height = views_.display().height;
        const auto columns = static_cast<std::uint32_t>(options_.methods.size());
        Collage sheet(columns * (views_.display().width / 2), height / 2 * sheet_rows());
        for (std::uint32_t i = 0; i < options_.frames; ++i)
            fly(renderers, files, i, sheet);
        sheet.write(out_ / "contact_sheet.png");
        print();
    }

  private:
    static ViewOptions view_options(const FlyThrough& options) {
        ViewOptions view;
        view.display = options.display;
        view.size = options.size;
        view.gaze = options.gaze;
        return view;
    }

    render::Renderer make(const char* method) const {
        render::Options engine;
        engine.method = method;
        engine.lights = frame::LightMode::area;
        engine.width = views_.display().width;
        engine.height = views_.display().height;
        engine.tangents = tangents_of(views_.display().eye(scene::Eye::mono));
        engine.lowres_scale = static_cast<float>(std::sqrt(share_));
        engine.log_polar.alpha = kAlpha;
        engine.geometry.cache_directory = bvh_cache_folder();
        return {device_, scene_, engine};
    }

    render::FrameReport render(render::Renderer& renderer, std::uint32_t frame) {
        const EyeFrame view = views_.at(frame, scene::Eye::mono);
        return renderer.render(frame, view.camera, view.gaze);
    }

    /// The part of the pixels that `weier` samples along the path.
    void measure_share() {
        render::Renderer weier = make("weier");
        double rays = 0.0;
        for (std::uint32_t i = 0; i < options_.frames; ++i) {
            const render::FrameReport report = render(weier, options_.first + i);
            rays += camera_rays(report);
        }
        share_ = rays / (static_cast<double>(options_.frames) * views_.display().width *
                         views_.display().height);
    }

    static double camera_rays(const render::FrameReport& report) {
        return static_cast<double>(
            report.rays[static_cast<std::size_t>(kernel::RayClass::primary)] +
            report.rays[static_cast<std::size_t>(kernel::RayClass::sparse)]);
    }

    std::uint32_t sheet_rows() const { return (options_.frames + kSheetEvery - 1) / kSheetEvery; }

    void fly(std::vector<render::Renderer>& renderers, const std::vector<FrameFiles>& files,
             std::uint32_t i, Collage& sheet) {
        const std::uint32_t frame = options_.first + i;
        const scene::Display& display = views_.display();
        Collage grid(kColumns * display.width,
                     (options_.methods.size() + kColumns - 1) / kColumns * display.height);
        for (std::size_t m = 0; m < options_.methods.size(); ++m) {
            const render::FrameReport report = render(renderers[m], frame);
            double ms = 0.0;
            for (const frame::StageTime& stage : report.stages)
                ms += stage.device_ms;
            ms_[m].push_back(ms > 0.0 ? ms : report.wall_ms);
            samples_[m] += camera_rays(report);
            files[m].write(renderers[m], i);
            const auto column = static_cast<std::uint32_t>(m);
            const std::uint32_t left = column % kColumns * display.width;
            const std::uint32_t top = column / kColumns * display.height;
            grid.place(renderers[m].map("colour"), left, top);
            mark_gaze(grid, frame, left, top);
            if (i % kSheetEvery == 0)
                add_to_sheet(sheet, renderers[m].map("colour"), frame, column, i / kSheetEvery);
        }
        grid.write(out_ / "side_by_side" / fmt::format("frame_{:04}.png", i));
    }

    void add_to_sheet(Collage& sheet, const render::Image& image, std::uint32_t frame,
                      std::uint32_t column, std::uint32_t row) {
        const scene::Display& display = views_.display();
        Collage picture(display.width, display.height);
        picture.place(image, 0, 0);
        mark_gaze(picture, frame, 0, 0);
        sheet.place_half(picture, column * (display.width / 2), row * (display.height / 2));
    }

    void mark_gaze(Collage& picture, std::uint32_t frame, std::uint32_t left, std::uint32_t top) {
        double x = 0.0, y = 0.0;
        const scene::GazeSample sample = views_.at(frame, scene::Eye::mono).sample;
        if (scene::project(views_.display(), scene::Eye::mono, sample.of(scene::Eye::mono), x, y))
            picture.mark(left + x, top + y);
    }

    void print() const {
        const auto width = views_.display().width, height = views_.display().height;
        fmt::print("\nfly-through of {}, {} frames of {} x {}, area lights, gaze: {}\n",
                   options_.scene, options_.frames, width, height, views_.gaze_source());
        fmt::print("{:<21} {:>14} {:>14} {:>10}\n", "method", "samples/pixel", "ms (median)",
                   "speed-up");
        for (std::size_t m = 0; m < options_.methods.size(); ++m)
            fmt::print("{:<21} {:>14.3f} {:>14.2f} {:>10.2f}\n", options_.methods[m],
                       samples_[m] / (static_cast<double>(options_.frames) * width * height),
                       metric::median(ms_[m]), metric::median(metric::ratios(ms_[0], ms_[m])));
    }

    const FlyThrough& options_;
    const compute::Device& device_;
    std::filesystem::path out_;
    scene::Scene scene_;
    Views views_;
    double share_ = 0.2;                  // of the pixels, until it is measured
    std::vector<std::vector<double>> ms_; // by method
    std::vector<double> samples_;
};

} // namespace

void fly_through(const FlyThrough& flight, const compute::Device& device,
                 const std::filesystem::path& out) {
    Flight(flight, device, out).run();
}

} // namespace macula::app
