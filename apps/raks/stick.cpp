#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/clip_document.hpp"
#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/raks/stick_joints.hpp"
#include "apps/raks/stick_window.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/clip_transport.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/text_lines.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Poses of a sheet over a whole clip: two rows of twelve.
constexpr std::size_t kSheetPoses = 24;

// Errors: another kind of file, or those of the reader. Warnings of the reader are printed.
Expected<motion::MotionClip> read_clip(const StickArguments& arguments) {
    if (motion::lower(arguments.input.extension().string()) != ".bvh") {
        return fail(arguments.input.string() +
                    ": cannot read this kind of motion; known: .bvh, .toml");
    }
    motion::BvhOptions options;
    if (arguments.fps > 0.0) {
        options.frames_per_second = arguments.fps;
    }
    auto clip = motion::read_bvh(arguments.input, options);
    if (clip) {
        for (const std::string& warning : clip->warnings) {
            say(arguments.input.string() + ": " + warning);
        }
    }
    return clip;
}

// What was taken in doubt, and the unit where nobody gave it.
void say_what_was_found(const render::ClipFigures& figures, const StickArguments& arguments) {
    const std::string name = arguments.input.string();
    for (const std::string& note : figures.notes()) {
        say(name + ": " + note);
    }
    if (!arguments.body.has_unit()) {
        const bool is_body = figures.body().has_value();
        say(fmt::format("{}: one unit is taken for {}: {} (--unit, --height or --scale sets it)",
                        name,
                        motion::unit_name(figures.metres_per_unit()),
                        is_body ? figures.body()->size.reason : "by its height at rest"));
    }
}

// The frames to draw: the one asked for, or up to 24 evenly over the clip, with the first and last.
std::vector<std::size_t> frames_to_draw(const motion::MotionClip& clip,
                                        const std::optional<std::size_t>& frame) {
    if (frame) {
        return {*frame};
    }
    const std::size_t count = std::min(kSheetPoses, clip.frame_count);
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i) {
        frames.push_back(count == 1 ? 0 : i * (clip.frame_count - 1) / (count - 1));
    }
    return frames;
}

// Draws these frames from the front and the side, and prints their numbers.
Expected<void> write_frames(const Path& output,
                            const engine::Look& look,
                            const std::string& name,
                            const render::ClipFigures& figures,
                            const std::vector<std::size_t>& frames) {
    render::PoseSheetConfig config;
    // A single frame is drawn large.
    const bool is_alone = frames.size() == 1;
    config.columns = is_alone ? 1 : 12;
    config.tile_width = is_alone ? 720 : 180;
    config.tile_height = is_alone ? 960 : 240;
    for (render::Camera& camera : config.cameras) {
        camera = framed(camera, figures);
    }
    std::vector<render::ClipFigure> bodies;
    bodies.reserve(frames.size());
    for (const std::size_t frame : frames) {
        bodies.push_back(figures.at(frame));
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
engine::ClipTransport transport_of(const motion::MotionClip& clip,
                                   const std::optional<std::size_t>& frame) {
    return frame ? engine::ClipTransport(clip.frame_count, clip.frames_per_second, *frame)
                 : engine::ClipTransport(clip.frame_count, clip.frames_per_second);
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
    auto clip = read_clip(arguments);
    if (!clip) {
        return fail(clip.error());
    }
    const std::string name = arguments.input.string();
    if (auto found = look_for_joints(arguments, *clip); !found) {
        return fail(found.error());
    }
    if (!arguments.joints_output.empty()) {
        if (auto written = write_joints(arguments, *clip); !written) {
            return fail(written.error());
        }
        return kExitDone;
    }
    // Frames count from 0.
    if (arguments.frame && *arguments.frame >= clip->frame_count) {
        return fail(fmt::format(
            "{}: has no frame {}, its last is {}", name, *arguments.frame, clip->frame_count - 1));
    }
    const auto figures = render::ClipFigures::create(*clip, arguments.body.options());
    if (!figures) {
        return fail(name + ": " + figures.error().message);
    }
    say_what_was_found(*figures, arguments);
    if (arguments.as_json) {
        print_text(clip_document(name, *clip, *figures) + "\n");
        return kExitDone;
    }
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    look->scene.camera = framed(look->scene.camera, *figures);
    // Without a display the sheet takes the window's place.
    Path output = arguments.output;
    if (output.empty()) {
        auto window = open_stick_window(name, *look, arguments.settings);
        if (window) {
            ClipContent content(*figures, transport_of(*clip, arguments.frame));
            if (auto shown = show_in_window(std::move(*window), *look, content); !shown) {
                return fail(shown.error());
            }
            return kExitDone;
        }
        output = arguments.input.stem();
        output += ".png";
        say("no window (" + window.error().message + "): drawing a sheet");
    }
    if (auto written = write_frames(output,
                                    *look,
                                    arguments.input.filename().string(),
                                    *figures,
                                    frames_to_draw(*clip, arguments.frame));
        !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
