// `raks capture track`: follows the markers through all films.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/track_doubts.hpp"
#include "apps/raks_capture/tracking_step.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"
#include "motion/capture/tracking/track_errors.hpp"

namespace raks::apps {
namespace {

Expected<void> write_tracks(const CapturePlan& plan, const capture::TrackerStages& stages) {
    const capture::Tracks& tracks = stages.smoothed;
    const std::pair<const char*, std::string> files[] = {
        {"tracks.csv", capture::tracks_text(tracks)},
        {"flags.tsv", capture::flags_text(tracks)},
        {"moved.tsv", capture::moves_text(stages.moves)},
        {"tracks.trc", capture::trc_text(tracks, "tracks.trc")}};
    for (const auto& [name, text] : files) {
        if (auto written = write_file(plan.file(name), text); !written) {
            return written;
        }
    }
    return {};
}

// How far each stage is from the truth.
Expected<void> print_errors(const capture::TrackerStages& stages, const Path& folder) {
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
    return {};
}

std::string summary_of(const capture::Tracks& tracks) {
    std::size_t lost = 0;
    std::size_t filled = 0;
    for (const capture::MarkerPlace& place : tracks.places) {
        lost += place.source == capture::PlaceSource::lost ? 1U : 0U;
        filled += place.source == capture::PlaceSource::filled ? 1U : 0U;
    }
    const double share = 100.0 / static_cast<double>(tracks.places.size());
    return fmt::format(
        "{} markers, {} frames: {:.1f} % filled, {:.1f} % lost; {} stretches to look at",
        tracks.markers.size(),
        tracks.frame_count,
        share * static_cast<double>(filled),
        share * static_cast<double>(lost),
        tracks.flags.size());
}

capture::ChromaForm form_named(std::string_view name) {
    return name == "crcb" ? capture::ChromaForm::crcb : capture::ChromaForm::normalised;
}

}  // namespace

ExitCode track(const TrackArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    auto given =
        load_tracking(*plan,
                      arguments.labels.empty() ? plan->file("labels.tsv") : arguments.labels,
                      form_named(arguments.colour));
    if (!given) {
        return stop_signal() ? ExitCode(exit_code_after_signals(kExitPartly))
                             : fail(std::move(given.error()));
    }
    given->options.sigma = arguments.sigma;
    given->options.acceleration = arguments.acceleration;
    given->options.smoothing = arguments.smoothing;
    given->options.check_order = !arguments.is_as_named;
    const auto stages = track_with(*given, given->edits);
    if (!stages) {
        return fail(Error(stages.error()).in(arguments.folder.string()));
    }
    if (auto written = write_tracks(*plan, *stages); !written) {
        return fail(std::move(written.error()));
    }
    for (const capture::CameraMove& move : stages->moves) {
        say(capture::words_of_move(move, stages->smoothed));
    }
    say(summary_of(stages->smoothed));
    for (const std::string& doubt : track_doubts(stages->smoothed, given->markers)) {
        say(doubt);
    }
    return arguments.truth.empty() ? ExitCode(kExitDone)
                                   : exit_code_of(print_errors(*stages, arguments.truth));
}

}  // namespace raks::apps
