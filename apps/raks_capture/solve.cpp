// `raks capture solve`: from marker tracks to a body that dances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

#include "apps/raks_capture/calibrate_dancer.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/keypoint_step.hpp"
#include "apps/raks_capture/solve_figures.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/markerless/point_tracks.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/formats/points.hpp"

namespace raks::apps {
namespace {

constexpr std::size_t kMostDoubtsSaid = 10;
// Joints that a network sees are off by more than markers, but nobody can take them off the body:
// where they are is believed from farther away, and more than what is usual. With the weights for
// markers legs came out 10 degrees too straight. Toes of rendered dancers that stand seem to move
// at up to 0.45 m/s, those of a larger dancer faster; heels that are lifted by a centimetre or
// three are common.
void suit_keypoints(capture::SolveOptions& options) {
    const double whole =
        options.height.value_or(capture::kMannequinHeight) / capture::kMannequinHeight;
    options.marker_deviation = 0.02;  // from where networks usually take joints to be
    options.outlier = 0.08;
    options.usual_posture_in_size = 0.05;
    options.usual_posture_in_motion = 0.01;
    options.standing = {0.45 * whole, 0.9 * whole, 0.01, 0.025, false};
}

capture::SolveOptions options_of(const SolveArguments& arguments, const CapturePlan& plan) {
    capture::SolveOptions options;
    const double height = arguments.height > 0.0 ? arguments.height : plan.height;
    if (height > 0.0) {
        options.height = height;
    }
    options.frames_per_second =
        arguments.frames_per_second > 0.0 ? arguments.frames_per_second : plan.frames_per_second;
    options.smoothness = arguments.smoothness;
    return options;
}

/// What people want to know of a solved dance: its body, its markers, its feet, its doubts.
void say_result(const capture::SolvedDance& dance) {
    double squares = 0.0;
    const capture::MarkerFit* worst = &dance.markers.front();
    for (const capture::MarkerFit& marker : dance.markers) {
        squares += marker.difference * marker.difference;
        worst = marker.difference > worst->difference ? &marker : worst;
    }
    std::size_t planted = 0;
    for (const motion::Pose& pose : dance.poses) {
        planted += (pose.foot_contact[0] ? 1U : 0U) + (pose.foot_contact[1] ? 1U : 0U);
    }
    say(fmt::format(
        "{:.1f} s at {:.4g} frames a second; a body of {:.2f} m; markers within {:.1f} mm (rms), "
        "{} within {:.1f}; feet stand {:.0f} % of the time",
        static_cast<double>(dance.poses.size()) / dance.frames_per_second,
        dance.frames_per_second,
        capture::kMannequinHeight * dance.size.whole,
        1000.0 * std::sqrt(squares / static_cast<double>(dance.markers.size())),
        worst->name,
        1000.0 * worst->difference,
        50.0 * static_cast<double>(planted) / static_cast<double>(dance.poses.size())));
    const std::size_t said = std::min(kMostDoubtsSaid, dance.doubts.size());
    for (std::size_t i = 0; i < said; ++i) {
        const capture::SolveDoubt& doubt = dance.doubts[i];
        say(fmt::format("frames {} to {}: {}", doubt.first, doubt.last, doubt.what));
    }
    if (said < dance.doubts.size()) {
        say(fmt::format("and {} doubtful stretches more", dance.doubts.size() - said));
    }
}

// Solves and shows how far it is.
Expected<capture::SolvedDance> solve_showing(const capture::Tracks& tracks,
                                             const capture::MarkerSet& markers,
                                             capture::SolveOptions& options) {
    ProgressLine progress("body");
    options.progress = [&progress](double share) {
        progress.show(share);
        return !stop_signal();
    };
    return capture::solve(tracks, markers, options);
}

Expected<capture::PointReading> reading_of(const SolveArguments& arguments) {
    constexpr std::size_t kMostReadingBytes = std::size_t{1} << 20U;
    capture::PointReading reading;
    if (!arguments.unit.empty()) {
        reading.metres_per_unit = motion::metres_of_unit(arguments.unit);
    }
    if (!arguments.up.empty()) {
        reading.up = arguments.up.front();
    }
    if (!arguments.names.empty()) {
        const auto text = read_text_file(arguments.names, kMostReadingBytes);
        auto names =
            text ? capture::read_point_names(*text, arguments.names.string()) : fail(text.error());
        if (!names) {
            return fail(std::move(names.error()));
        }
        reading.names = std::move(*names);
    }
    if (!arguments.markers.empty()) {
        const auto text = read_text_file(arguments.markers, kMostReadingBytes);
        auto markers =
            text ? capture::read_marker_set(*text, arguments.markers.string()) : fail(text.error());
        if (!markers) {
            return fail(std::move(markers.error()));
        }
        reading.markers = std::move(*markers);
    }
    return reading;
}

// A file of anybody's points becomes a BVH.
ExitCode solve_points(const SolveArguments& arguments) {
    const auto reading = reading_of(arguments);
    if (!reading) {
        return fail(reading.error());
    }
    const auto file = motion::read_motion(arguments.folder, {});
    if (!file) {
        return fail(file.error());
    }
    const auto* const clip = std::get_if<motion::PointClip>(&*file);
    if (clip == nullptr) {
        return fail(arguments.folder.string() +
                    ": holds a skeleton that moves already, no points; train or play it as it is");
    }
    const auto points = capture::point_tracks(*clip, *reading);
    if (!points) {
        return fail(Error(points.error()).in(arguments.folder.string()));
    }
    for (const auto& lines : {clip->warnings, points->notes}) {
        for (const std::string& line : lines) {
            say(arguments.folder.string() + ": " + line);
        }
    }
    capture::SolveOptions options = options_of(arguments, CapturePlan{});
    if (is_of_keypoints(points->tracks)) {
        suit_keypoints(options);
    }
    const auto dance = solve_showing(points->tracks, points->markers, options);
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    if (!dance) {
        return fail(Error(dance.error()).in(arguments.folder.string()));
    }
    const Path output = arguments.output.empty() ? Path(arguments.folder).replace_extension(".bvh")
                                                 : arguments.output;
    if (auto written =
            motion::write_bvh(output, dance->skeleton, dance->poses, dance->frames_per_second);
        !written) {
        return fail(std::move(written.error()));
    }
    if (arguments.as_json) {
        print_json(solve_json(*dance, std::nullopt));
    } else {
        say_result(*dance);
        say(output.string() + ": written");
    }
    return kExitDone;
}

}  // namespace

ExitCode solve_capture(const SolveArguments& arguments) {
    std::error_code problem;
    if (std::filesystem::is_regular_file(arguments.folder, problem)) {
        return solve_points(arguments);
    }
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const auto tracks = load_tracks(plan->folder);
    if (!tracks) {
        return fail(tracks.error());
    }
    const auto markers = markers_of(*plan, *tracks);
    if (!markers) {
        return fail(markers.error());
    }
    capture::SolveOptions options = options_of(arguments, *plan);
    if (is_of_keypoints(*tracks)) {
        options.height = dancer_height(*plan, arguments.height);
        suit_keypoints(options);
    }
    auto body = load_body(*plan, arguments.body);
    if (!body) {
        return fail(std::move(body.error()));
    }
    options.body = std::move(*body);
    auto start = load_angles(*plan, options.body);
    if (!start) {
        return fail(std::move(start.error()));
    }
    options.start = std::move(*start);
    const auto dance = solve_showing(*tracks, *markers, options);
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    if (!dance) {
        return fail(Error(dance.error()).in(arguments.folder.string()));
    }
    if (auto written = motion::write_bvh(
            plan->file("dance.bvh"), dance->skeleton, dance->poses, dance->frames_per_second);
        !written) {
        return fail(std::move(written.error()));
    }
    if (auto written = write_file(plan->file("body.toml"), capture::body_text(*dance, *markers));
        !written) {
        return fail(std::move(written.error()));
    }
    if (!arguments.as_json) {
        say_result(*dance);
        return kExitDone;
    }
    const auto clip = motion::read_bvh(plan->file("dance.bvh"));
    if (!clip) {
        return fail(clip.error());
    }
    print_json(solve_json(*dance, body_facts(*clip)));
    return kExitDone;
}

}  // namespace raks::apps
