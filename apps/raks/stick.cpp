#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks/clip_document.hpp"
#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/raks/stick_joints.hpp"
#include "apps/raks/stick_window.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/clip_transport.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/text_lines.hpp"
#include "render/scene/point_figure.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Poses of a sheet over a whole clip: two rows of twelve.
constexpr std::size_t kSheetPoses = 24;

// Errors: those of the reader, whose warnings are printed.
Expected<motion::MotionFile> read_file_of(const StickArguments& arguments) {
    auto file =
        motion::read_motion(arguments.input, clip_reading(arguments.fps, arguments.skeleton));
    if (file) {
        for (const std::string& warning :
             std::visit([](const auto& clip) { return clip.warnings; }, *file)) {
            say(arguments.input.string() + ": " + warning);
        }
    }
    return file;
}

// What was taken in doubt, and the unit where nobody gave it.
void say_what_was_found(const motion::MotionClip& clip,
                        const render::ClipFigures& figures,
                        const StickArguments& arguments) {
    const std::string name = arguments.input.string();
    for (const std::string& note : figures.notes()) {
        say(name + ": " + note);
    }
    if (!arguments.body.has_unit() && !clip.metres_per_unit) {
        const auto& body = figures.body();
        say(fmt::format("{}: one unit is taken for {}: {} (--unit, --height or --scale sets it)",
                        name,
                        motion::unit_name(figures.metres_per_unit()),
                        body ? body->size.reason : "by its height at rest"));
    }
}

// What of points is as given, as the file says, or else guessed, with a line that says so.
render::PointFrame frame_of(const motion::PointClip& clip, const StickArguments& arguments) {
    auto guess = render::guess_point_frame(clip);
    const motion::BodyOptions given = arguments.body.options();
    if (given.metres_per_unit) {
        guess.frame.metres_per_unit = *given.metres_per_unit;
        guess.is_unit_guessed = false;
    }
    if (given.up) {
        guess.frame.up = *given.up;
        guess.is_up_guessed = false;
    }
    const std::string name = arguments.input.string();
    if (guess.is_unit_guessed) {
        say(fmt::format(
            "{}: one unit is taken for {:.4g} m, by the points' height (--scale sets it)",
            name,
            guess.frame.metres_per_unit));
    }
    if (guess.is_up_guessed) {
        say(fmt::format("{}: {} is taken for up, as the points reach further along it",
                        name,
                        guess.frame.up.z > 0.5 ? "z" : "y"));
    }
    return guess.frame;
}

// The frames to draw: the one asked for, or up to 24 evenly over the clip, with the first and last.
std::vector<std::size_t> frames_to_draw(std::size_t frame_count,
                                        const std::optional<std::size_t>& frame) {
    if (frame) {
        return {*frame};
    }
    const std::size_t count = std::min(kSheetPoses, frame_count);
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i) {
        frames.push_back(count == 1 ? 0 : i * (frame_count - 1) / (count - 1));
    }
    return frames;
}

// Draws these frames from the front and the side, and prints their numbers.
Expected<void> write_frames(const Path& output,
                            const engine::Look& look,
                            const std::string& name,
                            const render::RecordedFigures& figures,
                            const std::vector<std::size_t>& frames) {
    render::PoseSheetConfig config;
    // A single frame is drawn large.
    const bool is_alone = frames.size() == 1;
    config.columns = is_alone ? 1 : 12;
    config.tile_width = is_alone ? 720 : 180;
    config.tile_height = is_alone ? 960 : 240;
    std::vector<render::ClipFigure> bodies;
    bodies.reserve(frames.size());
    for (const std::size_t frame : frames) {
        bodies.push_back(figures.at(frame));
    }
    const float aspect =
        static_cast<float>(config.tile_width) / static_cast<float>(config.tile_height);
    for (render::Camera& camera : config.cameras) {
        camera = framed(camera, figures);
        for (const render::ClipFigure& body : bodies) {
            camera = render::enclosing(camera, aspect, body);
        }
    }
    // A frame alone is the picture that was asked for, without a word on it.
    SheetLabels labels;
    if (!is_alone) {
        labels.title = printable(name, 120) + ", frames";
        for (const std::size_t frame : frames) {
            labels.poses.push_back(std::to_string(frame));
        }
    }
    auto studio = SheetStudio::open(look, best_quality(look));
    if (!studio) {
        return fail(studio.error());
    }
    if (auto written = studio->write_sheet(output, bodies, config, labels); !written) {
        return written;
    }
    std::string numbers;
    for (const std::size_t frame : frames) {
        numbers += fmt::format(" {}", frame);
    }
    print_text(
        fmt::format("{}: front and side of frames{}\n", printable(output.string()), numbers));
    return {};
}

// The transport of the window: paused at the frame asked for, or playing.
template <typename Clip>
engine::ClipTransport transport_of(const Clip& clip, const std::optional<std::size_t>& frame) {
    return frame ? engine::ClipTransport(clip.frame_count, clip.frames_per_second, *frame)
                 : engine::ClipTransport(clip.frame_count, clip.frames_per_second);
}

// Plays what a recording shows in the window, or where there is none draws a sheet.
template <typename Clip>
Expected<void> show(const StickArguments& arguments,
                    const Clip& clip,
                    const render::RecordedFigures& figures) {
    const std::string name = arguments.input.string();
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    // Without a display the sheet takes the window's place.
    Path output = arguments.output;
    if (output.empty()) {
        auto window = open_stick_window(name, *look, arguments.settings);
        if (window) {
            ClipContent content(figures,
                                transport_of(clip, arguments.frame),
                                frames_to_draw(clip.frame_count, std::nullopt));
            look->scene.camera = content.framed(look->scene.camera);
            return show_in_window(std::move(*window), *look, content);
        }
        output = arguments.input.stem();
        output += ".png";
        say("no window (" + window.error().message + "): drawing a sheet");
    }
    return write_frames(output,
                        *look,
                        arguments.input.filename().string(),
                        figures,
                        frames_to_draw(clip.frame_count, arguments.frame));
}

// Frames count from 0.
template <typename Clip>
Expected<void> check_frame(const StickArguments& arguments, const Clip& clip) {
    if (arguments.frame && *arguments.frame >= clip.frame_count) {
        return fail(fmt::format("{}: has no frame {}, its last is {}",
                                arguments.input.string(),
                                *arguments.frame,
                                clip.frame_count - 1));
    }
    return {};
}

// A skeleton as a stick figure.
Expected<void> show_recording(const StickArguments& arguments, motion::MotionClip& clip) {
    if (auto found = look_for_joints(arguments, clip); !found) {
        return found;
    }
    if (!arguments.joints_output.empty()) {
        return write_joints(arguments, clip);
    }
    const auto figures = render::ClipFigures::create(clip, arguments.body.options());
    if (!figures) {
        return fail(arguments.input.string() + ": " + figures.error().message);
    }
    say_what_was_found(clip, *figures, arguments);
    if (arguments.as_json) {
        print_text(clip_document(arguments.input.string(), clip, *figures) + "\n");
        return {};
    }
    return show(arguments, clip, *figures);
}

// Points as they are.
Expected<void> show_recording(const StickArguments& arguments, const motion::PointClip& clip) {
    if (!arguments.joints_output.empty() || arguments.joints.any() || arguments.as_json) {
        return fail(arguments.input.string() +
                    ": holds points, which have no joints; leave --joint, --joints, "
                    "--write-joints and --json out");
    }
    const auto figures = render::PointFigures::create(clip, frame_of(clip, arguments));
    if (!figures) {
        return fail(arguments.input.string() + ": " + figures.error().message);
    }
    return show(arguments, clip, *figures);
}

}  // namespace

ExitCode stick(const StickArguments& arguments) {
    // Checked before the clip is read.
    if (!arguments.output.empty() && arguments.output.extension() != ".png") {
        return fail(arguments.output.string() + ": cannot write this kind of picture; known: .png");
    }
    // A written dance has a window and sheets of its own.
    if (motion::lower(arguments.input.extension().string()) == ".toml") {
        return stick_dance(arguments);
    }
    auto file = read_file_of(arguments);
    if (!file) {
        return fail(file.error());
    }
    const auto shown = std::visit(
        [&](auto& clip) {
            auto checked = check_frame(arguments, clip);
            return checked ? show_recording(arguments, clip) : checked;
        },
        *file);
    if (!shown) {
        return fail(shown.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
