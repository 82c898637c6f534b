// `raks capture track`: follows the markers through all films.
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "apps/raks_capture/angle_figures.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/track_doubts.hpp"
#include "apps/raks_capture/tracking_step.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "motion/capture/markers/track_c3d.hpp"
#include "motion/capture/tracking/feet_floor.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"
#include "motion/capture/tracking/track_errors.hpp"

namespace raks::apps {
namespace {

// Those of an earlier method are of other tracks.
void drop_angles(const CapturePlan& plan) {
    std::error_code problem;
    std::filesystem::remove(plan.file("angles.csv"), problem);
}

// `angles`: of a body that was followed as a whole.
Expected<void> write_tracks(const CapturePlan& plan,
                            const capture::Tracks& tracks,
                            const std::string& moves,
                            const std::optional<std::string>& angles) {
    std::vector<NamedFile> files = {
        {plan.file("flags.tsv"), capture::flags_text(tracks)},
        {plan.file("moved.tsv"), moves},
        {plan.file("tracks.trc"), capture::trc_text(tracks, "tracks.trc")},
        {plan.file("tracks.c3d"), capture::c3d_bytes(tracks)}};
    if (angles) {
        files.push_back({plan.file("angles.csv"), *angles});
    }
    // Last: what follows from it is not older than the others.
    files.push_back({plan.file("tracks.csv"), capture::tracks_text(tracks)});
    auto written = write_files(files);
    if (written && !angles) {
        drop_angles(plan);
    }
    return written;
}

std::optional<std::string> angles_of(const TrackingGiven& given, const FollowedMarkers& followed) {
    return followed.angles
               ? std::optional(capture::angles_text(*followed.angles, given.angles->body))
               : std::nullopt;
}

// How far each stage is from the truth.
Expected<void> print_errors(const TrackingGiven& given,
                            const FollowedMarkers& followed,
                            const Path& folder) {
    const capture::TrackerStages& stages = followed.stages;
    const auto truth = load_tracks(folder);
    if (!truth) {
        return fail(truth.error());
    }
    const std::pair<const char*, const capture::Tracks*> rows[] = {
        {"triangulated", &stages.triangulated},
        {"filtered", &stages.filtered},
        {"smoothed", &stages.smoothed}};
    for (const auto& [name, tracks] : rows) {
        const auto errors = capture::track_errors(*tracks, *truth);
        if (!errors) {
            return fail(errors.error());
        }
        fmt::print(
            "{:12} mean {:5.2f} mm, {:5.2f} as the world lies best, over 100 mm or lost "
            "{:6.3f} %{}\n",
            name,
            1000.0 * errors->mean,
            1000.0 * errors->aligned_mean,
            100.0 * errors->wrong_share(),
            tracks == &stages.smoothed
                ? fmt::format(", {:.1f} % of them flagged", 100.0 * errors->flagged_share())
                : "");
    }
    return followed.angles ? print_angle_errors(followed, given.angles->body, folder)
                           : Expected<void>{};
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string cost_of(const capture::Tracks& tracks, double cpu) {
    const double seconds = static_cast<double>(tracks.frame_count) / tracks.frames_per_second;
    constexpr double kMinute = 60.0;
    return fmt::format("{:.0f} CPU-s a minute of the dance, {:.0f} frames a second of CPU",
                       cpu / seconds * kMinute,
                       static_cast<double>(tracks.frame_count) / cpu);
}

std::string summary_of(const capture::Tracks& tracks) {
    std::size_t filled = 0;
    for (const capture::MarkerPlace& place : tracks.places) {
        filled += place.source == capture::PlaceSource::filled ? 1U : 0U;
    }
    const double share = 100.0 / static_cast<double>(tracks.places.size());
    return fmt::format(
        "{} markers, {} frames: {:.1f} % filled, {:.1f} % lost; {} stretches to look at",
        tracks.markers.size(),
        tracks.frame_count,
        share * static_cast<double>(filled),
        100.0 * lost_share(tracks),
        tracks.flags.size());
}

// What arguments say of the method; none: what capture.toml says, or follows from the cameras.
std::optional<TrackingMethod> method_of(const TrackArguments& arguments) {
    if (arguments.method.empty()) {
        return std::nullopt;
    }
    return arguments.method == "angles" ? TrackingMethod::angles : TrackingMethod::positions;
}

// Says why a body is followed though nobody asked for it.
void say_method(const TrackArguments& arguments,
                const CapturePlan& plan,
                const TrackingGiven& given) {
    const std::string too_few = too_few_for_colours(given.markers, given.seen.films.size());
    if (!too_few.empty()) {
        say(too_few);
    } else if (given.angles && arguments.method.empty() && !plan.method) {
        say(
            fmt::format("{} cameras cannot tell markers of one colour apart by themselves: the "
                        "whole body is followed (--method angles)",
                        given.seen.films.size()));
    }
}

// What arguments say of following by angles.
Expected<void> set_angles(const TrackArguments& arguments,
                          const CapturePlan& plan,
                          capture::AngleTrackerOptions& options) {
    auto body = load_body(plan, arguments.body);
    if (!body) {
        return fail(std::move(body.error()));
    }
    options.body = std::move(*body);
    options.fits_body = !arguments.is_body_kept;
    options.body_error = arguments.body_error;
    options.filter.likelihood = arguments.likelihood == "epipolar"
                                    ? capture::Likelihood::epipolar
                                    : capture::Likelihood::reprojection;
    options.filter.filter =
        arguments.filter == "full" ? capture::FilterKind::full : capture::FilterKind::partitioned;
    options.filter.particles = static_cast<std::size_t>(arguments.particles);
    options.filter.layers = static_cast<std::size_t>(arguments.layers);
    options.filter.is_polished = !arguments.is_unpolished;
    options.filter.seed = arguments.seed;
    options.filter.threads = arguments.threads > 0
                                 ? arguments.threads
                                 : static_cast<int>(std::thread::hardware_concurrency());
    return {};
}

// What is to be expected of following a body by these markers and edits.
void say_warnings(const TrackingGiven& given) {
    for (const capture::Edit& edit : given.edits) {
        if (edit.kind == capture::EditKind::swap || edit.kind == capture::EditKind::fill) {
            say("edits that swap or fill are for the method of positions; they are passed over");
            break;
        }
    }
    if (const std::string doubt = colour_doubt(given.markers); !doubt.empty()) {
        say(doubt);
    }
}

// Follows the markers. A person who stops it keeps what is done.
Expected<FollowedMarkers> follow(TrackingGiven& given) {
    ProgressLine progress("tracking");
    if (given.angles) {
        given.angles->progress = [&progress](double share) {
            progress.show(share);
            return !stop_signal();
        };
    }
    return track_with(given, given.edits);
}

// Where no board told the floor, the feet do: the rig is put on it, and the markers are followed
// once more in that world.
Expected<FollowedMarkers> follow_on_floor(const CapturePlan& plan,
                                          const FollowedMarkers& before,
                                          TrackingGiven& given) {
    const auto levelling =
        capture::level_by_feet(before.stages.smoothed, given.markers, plan.height);
    if (!levelling) {
        say("the floor is not known: no marker of a foot was followed together with one of the "
            "head "
            "or trunk");
        return before;
    }
    capture::level(given.rig, *levelling);
    if (auto written = write_file(plan.file("rig.toml"), capture::rig_text(given.rig)); !written) {
        return fail(std::move(written.error()));
    }
    say("no board told where the floor is: it is guessed from the dancer's feet");
    return follow(given);
}

capture::ChromaForm form_named(std::string_view name) {
    return name == "crcb" ? capture::ChromaForm::crcb : capture::ChromaForm::normalised;
}

// What moved, how much is there, what angles cost, and what is doubtful.
void say_what_came(const TrackingGiven& given, const FollowedMarkers& followed, double cpu) {
    const capture::TrackerStages& stages = followed.stages;
    for (const capture::CameraMove& move : stages.moves) {
        say(capture::words_of_move(move, stages.smoothed));
    }
    say(summary_of(stages.smoothed));
    if (followed.angles) {
        say(cost_of(stages.smoothed, cpu));
        for (const std::string& line : angle_lines(followed, given.angles->body)) {
            say(line);
        }
    }
    for (const auto& doubts : {film_doubts(given.rig, given.seen, given.clocks),
                               track_doubts(stages.smoothed, given.markers)}) {
        for (const std::string& doubt : doubts) {
            say(doubt);
        }
    }
}

// Without markers: the joints that a network saw.
ExitCode track_joints(const CapturePlan& plan, const TrackArguments& arguments) {
    if (!arguments.truth.empty()) {
        return fail(
            "--truth is of markers; raks capture compare --align tells how far the dance "
            "of a take without markers is from the true one");
    }
    const auto given = load_joint_tracking(plan);
    if (!given) {
        return fail(given.error());
    }
    const auto followed = track_with(*given, given->edits);
    if (!followed) {
        return fail(Error(followed.error()).in(plan.file("edits.jsonl").string()));
    }
    const capture::Tracks& tracks = followed->stages.smoothed;
    for (const std::string& line : followed->lines) {
        say(line);
    }
    const auto written = write_tracks(plan, tracks, capture::moves_text({}), std::nullopt);
    if (written) {
        say(summary_of(tracks));
    }
    return exit_code_of(written);
}

}  // namespace

ExitCode track(const TrackArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const bool is_markerless =
        arguments.method.empty() ? plan->is_markerless : arguments.method == "markerless";
    if (is_markerless) {
        return track_joints(*plan, arguments);
    }
    auto given =
        load_tracking(*plan,
                      arguments.labels.empty() ? plan->file("labels.tsv") : arguments.labels,
                      form_named(arguments.colour),
                      method_of(arguments));
    if (!given) {
        return stop_signal() ? ExitCode(exit_code_after_signals(kExitPartly))
                             : fail(std::move(given.error()));
    }
    given->options.sigma = arguments.sigma;
    given->options.acceleration = arguments.acceleration;
    given->options.smoothing = arguments.smoothing;
    given->options.check_order = !arguments.is_as_named;
    say_method(arguments, *plan, *given);
    if (given->angles) {
        if (auto set = set_angles(arguments, *plan, *given->angles); !set) {
            return fail(std::move(set.error()));
        }
        say_warnings(*given);
    }
    const double cpu_before = cpu_seconds();
    auto followed = follow(*given);
    if (followed && given->rig.floor == capture::FloorOrigin::unknown && !stop_signal()) {
        followed = follow_on_floor(*plan, *followed, *given);
    }
    if (!followed) {
        return fail(Error(followed.error()).in(arguments.folder.string()));
    }
    const double cpu = cpu_seconds() - cpu_before;
    const capture::TrackerStages& stages = followed->stages;
    if (auto written = write_tracks(*plan,
                                    stages.smoothed,
                                    capture::moves_text(stages.moves),
                                    angles_of(*given, *followed));
        !written) {
        return fail(std::move(written.error()));
    }
    say_what_came(*given, *followed, cpu);
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    if (!arguments.truth.empty()) {
        if (auto printed = print_errors(*given, *followed, arguments.truth); !printed) {
            return fail(std::move(printed.error()));
        }
    }
    const std::string too_much = too_much_lost(stages.smoothed);
    if (too_much.empty()) {
        return kExitDone;
    }
    say(too_much);
    return kExitPartly;
}

}  // namespace raks::apps
