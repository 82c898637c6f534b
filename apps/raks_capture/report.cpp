// `raks capture report`: one page of what came of a capture.
#include <fmt/format.h>

#include <utility>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_page.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/keypoint_step.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/tracking/track_errors.hpp"
#include "motion/skeleton/formats/bvh.hpp"

namespace raks::apps {
namespace {

// Puts a file of the capture into its place in the report, where the file is there.
template <typename Place, typename Load>
Expected<void> read_if_there(const Path& file, Place& place, const Load& load) {
    if (!is_there(file)) {
        return {};
    }
    auto read = load();
    if (!read) {
        return fail(std::move(read.error()));
    }
    place = std::move(*read);
    return {};
}

Expected<void> read_errors(const Path& folder, CaptureReport& report) {
    const auto truth = load_tracks(folder);
    if (!truth) {
        return fail(truth.error());
    }
    auto errors = capture::distances_from(*report.tracks, *truth);
    if (!errors) {
        return fail(std::move(errors.error()).in(folder.string()));
    }
    report.errors = std::move(*errors);
    return {};
}

Expected<void> read_body(const Path& file, CaptureReport& report) {
    if (!is_there(file)) {
        return {};
    }
    const auto clip = motion::read_bvh(file);
    if (!clip) {
        return fail(clip.error());
    }
    report.body = body_facts(*clip);
    return {};
}

Expected<void> read_angles(const CapturePlan& plan, CaptureReport& report) {
    const auto body = load_body(plan, "");
    const auto track = body ? load_angle_track(plan, *body) : fail(body.error());
    if (!track) {
        return fail(track.error());
    }
    if (*track) {
        report.joints = capture::joint_sureness(**track, *body);
    }
    return {};
}

Expected<CaptureReport> gather(const CapturePlan& plan, const ReportArguments& arguments) {
    CaptureReport report;
    report.name = std::filesystem::weakly_canonical(plan.folder).filename().string();
    auto done = read_if_there(
        plan.file("rig.toml"), report.rig, [&plan] { return load_capture_rig(plan); });
    if (done) {
        done = read_if_there(
            plan.file("clocks.toml"), report.clocks, [&plan] { return load_clocks(plan); });
    }
    if (done) {
        done = read_if_there(
            plan.file("tracks.csv"), report.tracks, [&plan] { return load_tracks(plan.folder); });
    }
    auto markers = report.tracks ? markers_of(plan, *report.tracks) : load_markers(plan);
    if (!markers) {
        return fail(std::move(markers.error()));
    }
    report.markers = std::move(*markers);
    if (done) {
        done = read_angles(plan, report);
    }
    if (done) {
        done = read_if_there(
            plan.file("edits.jsonl"), report.edits, [&plan] { return load_edits(plan); });
    }
    if (done) {
        done = read_if_there(
            plan.file("moved.tsv"), report.moves, [&plan] { return load_moves(plan); });
    }
    if (done) {
        done = read_body(plan.file("dance.bvh"), report);
    }
    if (done && !arguments.truth.empty()) {
        done = report.tracks ? read_errors(arguments.truth, report)
                             : fail(plan.folder.string() +
                                    ": has no tracks to compare; run raks capture track first");
    }
    if (!done) {
        return fail(std::move(done.error()));
    }
    return report;
}

// The film as a page links it.
std::string film_beside(const Path& page, const Path& film) {
    std::error_code problem;
    const Path folder = std::filesystem::absolute(page, problem).parent_path();
    const Path beside = std::filesystem::relative(film, folder, problem);
    return (problem || beside.empty() ? film : beside).generic_string();
}

}  // namespace

ExitCode report_capture(const ReportArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    auto report = gather(*plan, arguments);
    if (!report) {
        return fail(report.error());
    }
    const Path output = arguments.output.empty() ? plan->file("report.html") : arguments.output;
    if (const Path film = plan->file("side_by_side.mp4"); is_there(film)) {
        report->film = film_beside(output, film);
    }
    if (auto written = write_file(output, capture_page(*report)); !written) {
        return fail(std::move(written.error()));
    }
    say(output.string() + ": written");
    return kExitDone;
}

}  // namespace raks::apps
