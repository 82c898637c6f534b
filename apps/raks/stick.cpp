#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks/clip_document.hpp"
#include "apps/raks/commands.hpp"
#include "apps/raks/stick_beats.hpp"
#include "apps/raks/stick_film.hpp"
#include "apps/raks/stick_joints.hpp"
#include "apps/raks/stick_pair.hpp"
#include "apps/raks/stick_points.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/text_lines.hpp"
#include "render/scene/point_body.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Errors: those of the reader, whose warnings are printed.
Expected<motion::MotionFile> read_file_of(const StickArguments& arguments, const Path& path) {
    auto file = motion::read_motion(
        path, clip_reading(arguments.fps, arguments.skeleton, arguments.body.arm_angle));
    if (file) {
        for (const std::string& warning :
             std::visit([](const auto& clip) { return clip.warnings; }, *file)) {
            say(path.string() + ": " + warning);
        }
    }
    return file;
}

// What was taken in doubt, and the unit where nobody gave it.
void say_what_was_found(const motion::MotionClip& clip,
                        const render::ClipBodies& recorded,
                        const StickArguments& arguments) {
    const std::string name = arguments.input.string();
    for (const std::string& note : recorded.notes()) {
        say(fmt::format("{}: {}", name, note));
    }
    const auto& body = recorded.body();
    const bool is_said = body && body->is_unit_doubtful();
    if (!arguments.body.has_unit() && !clip.metres_per_unit && !is_said) {
        say(fmt::format("{}: {}",
                        name,
                        motion::unit_note(recorded.metres_per_unit(),
                                          body ? body->size.reason : "by its height at rest")));
    }
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

template <typename Clip>
ShownClip shown_clip(const StickArguments& arguments, const Clip& clip) {
    return {arguments.input.filename().string(), clip.frame_count, clip.frames_per_second, {}, {}};
}

// A skeleton as a stick figure.
ExitCode show_recording(const StickArguments& arguments, motion::MotionClip& clip) {
    if (!arguments.edges.empty()) {
        return fail(arguments.input.string() +
                    ": has a hierarchy, which joins its joints; --edges is for points");
    }
    if (auto found = look_for_joints(arguments, clip); !found) {
        return fail(std::move(found.error()));
    }
    if (!arguments.joints_output.empty()) {
        return exit_code_of(write_joints(arguments, clip));
    }
    const auto recorded = render::ClipBodies::create(clip, arguments.body.options());
    if (!recorded) {
        return fail(arguments.input.string() + ": " + recorded.error().message);
    }
    say_what_was_found(clip, *recorded, arguments);
    if (arguments.as_json) {
        print_text(clip_document(arguments.input.string(), clip, *recorded) + "\n");
        return kExitDone;
    }
    return exit_code_of(show_recorded(arguments, shown_clip(arguments, clip), *recorded));
}

// Points as they are, or joined.
ExitCode show_recording(const StickArguments& arguments, motion::PointClip& clip) {
    const std::string name = arguments.input.string();
    if (!arguments.joints_output.empty() || arguments.joints.any()) {
        return fail(name +
                    ": holds points, which have no joints; leave --joint, --joints and "
                    "--write-joints out");
    }
    auto joined = join_points(arguments, name, std::move(clip));
    if (!joined) {
        return fail(std::move(joined.error()));
    }
    const int done = joined->is_partly ? kExitPartly : kExitDone;
    if (arguments.as_json) {
        print_text(points_document(name, joined->points) + "\n");
        return done;
    }
    const ShownClip shown = shown_clip(arguments, joined->points.clip);
    std::vector<motion::WorldPoints> motions;
    motions.push_back(std::move(joined->points));
    const auto recorded = render::PointBodies::create(std::move(motions));
    if (!recorded) {
        return fail(name + ": " + recorded.error().message);
    }
    if (auto finished = show_recorded(arguments, shown, *recorded); !finished) {
        return fail(std::move(finished.error()));
    }
    return done;
}

// Options that two motions have no use for, or that a rate cannot have.
Expected<void> check_options(const StickArguments& arguments) {
    if (arguments.rate == 0.0) {
        return fail("--rate 0 would stand still; give --frame N for one frame");
    }
    const bool has_joints = arguments.joints.any() || !arguments.joints_output.empty();
    if (!arguments.other.empty() && has_joints) {
        return fail("--joint, --joints and --write-joints are for one motion");
    }
    return check_clip_options(arguments.joints, {arguments.skeleton});
}

}  // namespace

ExitCode stick(const StickArguments& arguments) {
    // Checked before the clip is read.
    if (auto checked = check_options(arguments); !checked) {
        return fail(std::move(checked.error()));
    }
    if (!arguments.counts.empty()) {
        return stick_beats(arguments);
    }
    // A written dance has a window and sheets of its own.
    if (motion::lower(arguments.input.extension().string()) == ".toml") {
        return stick_dance(arguments);
    }
    if (motion::lower(arguments.input.extension().string()) == ".cells") {
        return fail(printable(arguments.input.string()) +
                    ": is a dance of takes; raks sheet --dance FOLDER draws it");
    }
    if (auto checked = check_stick_output(arguments); !checked) {
        return fail(std::move(checked.error()));
    }
    auto file = read_file_of(arguments, arguments.input);
    if (!file) {
        return fail(file.error());
    }
    if (auto checked =
            std::visit([&](const auto& clip) { return check_frame(arguments, clip); }, *file);
        !checked) {
        return fail(std::move(checked.error()));
    }
    if (!arguments.other.empty()) {
        auto other = read_file_of(arguments, arguments.other);
        return other ? stick_pair(arguments, std::move(*file), std::move(*other))
                     : ExitCode(fail(std::move(other.error())));
    }
    return std::visit([&](auto& clip) { return show_recording(arguments, clip); }, *file);
}

}  // namespace raks::apps
