// `raks capture solve`: from marker tracks to a body that dances.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/solve_figures.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/skeleton/formats/bvh.hpp"

namespace raks::apps {
namespace {

constexpr std::size_t kMostDoubtsSaid = 10;

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

}  // namespace

ExitCode solve_capture(const SolveArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const auto markers = load_markers(*plan);
    if (!markers) {
        return fail(markers.error());
    }
    const auto tracks = load_tracks(plan->folder);
    if (!tracks) {
        return fail(tracks.error());
    }
    capture::SolveOptions options = options_of(arguments, *plan);
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
    const auto dance = [&] {
        ProgressLine progress("body");
        options.progress = [&progress](double share) {
            progress.show(share);
            return !stop_signal();
        };
        return capture::solve(*tracks, *markers, options);
    }();
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
