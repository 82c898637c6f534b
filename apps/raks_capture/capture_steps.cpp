#include "apps/raks_capture/capture_steps.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace raks::apps {
namespace {

using Path = std::filesystem::path;
using FileTime = std::filesystem::file_time_type;

std::optional<FileTime> time_of_change(const Path& file) {
    std::error_code problem;
    const FileTime time = std::filesystem::last_write_time(file, problem);
    return problem ? std::nullopt : std::optional(time);
}

// Those films, or calibration films, that the plan names.
std::vector<Path> films_of(const CapturePlan& plan, Path PlannedCamera::*film) {
    std::vector<Path> films;
    for (const PlannedCamera& camera : plan.cameras) {
        if (!(camera.*film).empty()) {
            films.push_back(plan.file(camera.*film));
        }
    }
    return films;
}

std::vector<Path> files_of(const CapturePlan& plan, const std::vector<const char*>& names) {
    std::vector<Path> files;
    files.reserve(names.size());
    for (const char* const name : names) {
        files.push_back(plan.file(name));
    }
    return files;
}

std::vector<Path> joined(std::vector<Path> one, const std::vector<Path>& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

// Whether the films of the dance are those of the board, too.
bool shows_both(const CapturePlan& plan) {
    return std::all_of(plan.cameras.begin(), plan.cameras.end(), [](const PlannedCamera& camera) {
        return !camera.film.empty() && camera.film == camera.calibration;
    });
}

// Whether the clocks of the calibration films are to be told from their own sound: folders of
// pictures have none, and need none.
bool has_board_films(const CapturePlan& plan, const std::vector<Path>& boards) {
    return !boards.empty() && !shows_both(plan) &&
           std::none_of(boards.begin(), boards.end(), [](const Path& board) {
               std::error_code problem;
               return std::filesystem::is_directory(board, problem);
           });
}

// Without markers: joints instead of spots, and no board.
std::vector<CaptureStep> markerless_steps(const CapturePlan& plan,
                                          const std::vector<Path>& films,
                                          CaptureStep sync,
                                          CaptureStep solve,
                                          CaptureStep report) {
    std::vector<Path> seen;
    for (const PlannedCamera& camera : plan.cameras) {
        seen.push_back(plan.file("keypoints") / (camera.name + ".csv"));
    }
    // Where nothing is heard, clocks are told from the joints.
    sync.inputs = joined(std::move(sync.inputs), seen);
    sync.has_source = true;
    const std::vector<Path> boards = films_of(plan, &PlannedCamera::calibration);
    const std::vector<Path> placed = files_of(plan, {"capture.toml", "clocks.toml"});
    return {{"keypoints", {}, films, seen, !films.empty()},
            std::move(sync),
            {"calibrate",
             {"--dancer"},
             joined(joined(placed, seen), boards),
             files_of(plan, {"rig.toml"})},
            {"track",
             {"--method", "markerless"},
             joined(joined(placed, seen), files_of(plan, {"rig.toml", "edits.jsonl"})),
             files_of(plan, {"tracks.csv"})},
            std::move(solve),
            std::move(report)};
}

}  // namespace

std::vector<CaptureStep> capture_steps(const CapturePlan& plan) {
    const std::vector<Path> films = films_of(plan, &PlannedCamera::film);
    const std::vector<Path> boards = films_of(plan, &PlannedCamera::calibration);
    std::vector<Path> markers;
    if (!plan.markers.empty()) {
        markers.push_back(plan.file(plan.markers));
    }
    std::vector<Path> heard = films;
    if (!plan.music.empty()) {
        heard.push_back(plan.file(plan.music));
    }
    CaptureStep calibrate{"calibrate",
                          {},
                          joined(boards, files_of(plan, {"capture.toml", "calibration.toml"})),
                          files_of(plan, {"rig.toml"}),
                          !boards.empty()};
    CaptureStep sync{"sync",
                     {},
                     joined(heard, files_of(plan, {"capture.toml"})),
                     files_of(plan, {"clocks.toml"}),
                     !films.empty()};
    const std::vector<Path> followed =
        files_of(plan, {"capture.toml", "rig.toml", "clocks.toml", "labels.tsv", "edits.jsonl"});
    const std::vector<Path> seen = films.empty() ? files_of(plan, {"detections.csv"}) : films;
    CaptureStep track{
        "track", {}, joined(joined(followed, seen), markers), files_of(plan, {"tracks.csv"})};
    CaptureStep solve{"solve",
                      {},
                      joined(files_of(plan, {"capture.toml", "tracks.csv"}), markers),
                      files_of(plan, {"dance.bvh", "body.toml"})};
    CaptureStep report{"report",
                       {},
                       files_of(plan,
                                {"rig.toml",
                                 "clocks.toml",
                                 "tracks.csv",
                                 "flags.tsv",
                                 "moved.tsv",
                                 "edits.jsonl",
                                 "dance.bvh"}),
                       files_of(plan, {"report.html"})};
    if (plan.is_markerless) {
        return markerless_steps(plan, films, std::move(sync), std::move(solve), std::move(report));
    }
    if (shows_both(plan)) {
        calibrate.arguments = {"--clocks", plan.file("clocks.toml").string()};
        calibrate.inputs.push_back(plan.file("clocks.toml"));
        std::swap(calibrate, sync);
    }
    std::vector<CaptureStep> steps;
    if (has_board_films(plan, boards)) {
        const std::vector<Path> clocks = files_of(plan, {"board_clocks.toml"});
        steps.push_back(
            {"sync", {"--boards"}, joined(boards, files_of(plan, {"capture.toml"})), clocks});
        calibrate.inputs = joined(std::move(calibrate.inputs), clocks);
    }
    for (CaptureStep* const step : {&calibrate, &sync, &track, &solve, &report}) {
        steps.push_back(std::move(*step));
    }
    return steps;
}

StepState state_of(const CaptureStep& step) {
    std::optional<FileTime> oldest;
    for (const Path& output : step.outputs) {
        const auto time = time_of_change(output);
        if (!time) {
            return StepState::missing;
        }
        oldest = oldest ? std::min(*oldest, *time) : *time;
    }
    if (!step.has_source) {
        return StepState::given;
    }
    const bool is_older =
        std::any_of(step.inputs.begin(), step.inputs.end(), [&oldest](const Path& input) {
            const auto time = time_of_change(input);
            return time && oldest && *oldest < *time;
        });
    return is_older ? StepState::outdated : StepState::up_to_date;
}

}  // namespace raks::apps
