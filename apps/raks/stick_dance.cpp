// `raks stick dance.toml`: a written dance in a window while it is being written, or on a sheet.
#include <cstdio>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/terminal/say.hpp"
#include "apps/terminal/signals.hpp"
#include "base/time.hpp"
#include "engine/show/camera_moves.hpp"
#include "engine/show/dance_preview.hpp"
#include "engine/show/show.hpp"
#include "render/gl/window.hpp"
#include "render/overlay/key_bindings.hpp"
#include "render/overlay/overlay.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

Expected<void> write_figure(engine::DancePreview& preview,
                            const engine::Look& look,
                            const Path& output) {
    if (auto written = write_sheet(output, look, preview.sheet(kPosesPerBeat), figure_sheet());
        !written) {
        return written;
    }
    std::fputs(
        fmt::format(
            "{}: front and side of {}, eighths of a beat\n", output.string(), preview.figure())
            .c_str(),
        stdout);
    return {};
}

/// One sheet, or one for each figure: X_FIGURE.png.
Expected<void> write_figures(engine::DancePreview& preview,
                             const engine::Look& look,
                             const Path& output,
                             const std::string& wanted) {
    if (!wanted.empty()) {
        return write_figure(preview, look, output);
    }
    const std::vector<std::string> figures = preview.figures();
    for (std::size_t i = 0; i < figures.size(); ++i) {
        preview.show(i);
        Path path = output;
        path.replace_filename(fmt::format("{}_{}.png", output.stem().string(), figures[i]));
        if (auto written = write_figure(preview, look, path); !written) {
            return written;
        }
    }
    return {};
}

/// What is not the preview's means the same as in every window.
void act_on(const render::WindowEvent& event,
            const render::Camera& first,
            engine::DancePreview& preview,
            render::Window& window,
            render::Scene& scene) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) {
        if (preview.handle(*key)) {
            return;
        }
        const auto action = render::action_of(*key);
        if (action == render::Action::quit) {
            window.request_close();
        } else if (action == render::Action::reset_camera) {
            scene.camera = first;
        } else if (action == render::Action::toggle_fullscreen) {
            window.toggle_fullscreen();
        }
    } else if (const auto* drag = std::get_if<render::MouseDragEvent>(&event)) {
        engine::move_camera(scene.camera, *drag);
    } else if (const auto* scroll = std::get_if<render::ScrollEvent>(&event)) {
        engine::move_camera(scene.camera, *scroll);
    }
}

Expected<void> play_preview(render::Window& window,
                            const engine::Look& look,
                            engine::DancePreview& preview) {
    auto drawing = engine::create_drawing(look);
    if (!drawing) {
        return fail(drawing.error());
    }
    constexpr double kLookEvery = 0.25;  // seconds: was the file saved?
    render::Scene scene = look.scene;
    HostTime last = HostClock::now();
    double since_look = 0.0;
    while (!window.should_close() && !stop_signal()) {
        for (const render::WindowEvent& event : window.poll_events()) {
            act_on(event, look.scene.camera, preview, window, scene);
        }
        const HostTime now = HostClock::now();
        const double seconds = to_seconds(now - last);
        last = now;
        preview.advance(seconds);
        since_look += seconds;
        if (since_look > kLookEvery) {
            since_look = 0.0;
            if (preview.refresh() && !preview.fault().empty()) {
                say(preview.fault());
            }
        }
        const motion::Pose pose = preview.pose();
        scene.camera.pan_to(pose.hips_position);
        drawing->renderer.draw(scene, pose, window.frame());
        const std::string status = preview.status();
        render::OverlayState line;
        line.message = status;
        drawing->overlay.draw(
            line, render::OverlayView::hidden, window.frame(), window.content_scale());
        window.present();
    }
    return {};
}

}  // namespace

ExitCode stick_dance(const StickArguments& arguments) {
    auto preview = engine::DancePreview::create(
        arguments.input,
        arguments.figure,
        arguments.bpm > 0.0 ? std::optional(Bpm(arguments.bpm)) : std::nullopt);
    if (!preview) {
        return fail(preview.error());
    }
    auto look = engine::read_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    Path output = arguments.output;
    if (output.empty()) {
        auto window = render::Window::create({.title = "Raks: " + arguments.input.string(),
                                              .width = look->size.width,
                                              .height = look->size.height,
                                              .max_fps = arguments.settings.fps});
        if (window) {
            if (auto played = play_preview(*window, *look, *preview); !played) {
                return fail(played.error());
            }
            return kExitDone;
        }
        output = arguments.input.stem();
        output += ".png";
        say("no window (" + window.error().message + "): drawing sheets");
    }
    if (auto written = write_figures(*preview, *look, output, arguments.figure); !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
