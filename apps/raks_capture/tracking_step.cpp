#include "apps/raks_capture/tracking_step.hpp"

#include <algorithm>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/film_step.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "base/file.hpp"
#include "motion/capture/markerless/followed_keypoints.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"

namespace raks::apps {

Expected<TrackingGiven> load_tracking(const CapturePlan& plan,
                                      const std::filesystem::path& labels_file,
                                      capture::ChromaForm form,
                                      std::optional<TrackingMethod> method) {
    if (auto checked = check_cameras(plan); !checked) {
        return fail(std::move(checked.error()));
    }
    method = method ? method : plan.method;
    auto rig = load_capture_rig(plan);
    auto markers = load_markers(plan);
    auto clocks = load_clocks(plan);
    // A body is found without labels, where spots have their colours already.
    const bool is_by_body = markers && is_body_followed(method, *markers, plan.cameras.size());
    const bool needs_labels =
        !is_by_body || is_there(labels_file) || !is_there(plan.file("detections.csv"));
    auto labels = needs_labels ? load_labels(labels_file) : std::vector<capture::MarkerLabel>{};
    auto edits = load_edits(plan);
    for (const Error* const error : {rig ? nullptr : &rig.error(),
                                     markers ? nullptr : &markers.error(),
                                     clocks ? nullptr : &clocks.error(),
                                     labels ? nullptr : &labels.error(),
                                     edits ? nullptr : &edits.error()}) {
        if (error != nullptr) {
            return fail(*error);
        }
    }
    auto seen = seen_by_cameras(plan, *rig, *markers, *labels, form);
    if (!seen) {
        return fail(std::move(seen.error()));
    }
    TrackingGiven given;
    given.rig = std::move(*rig);
    given.markers = std::move(*markers);
    given.seen = std::move(*seen);
    given.clocks = std::move(*clocks);
    given.labels = std::move(*labels);
    given.edits = std::move(*edits);
    given.options.frames_per_second = plan.frames_per_second;
    given.options.first_time = plan.start;
    given.options.height = plan.height;
    given.options.check_order = false;
    if (is_body_followed(method, given.markers, given.seen.films.size())) {
        auto body = load_body(plan, "");
        if (!body) {
            return fail(std::move(body.error()));
        }
        given.angles.emplace();
        given.angles->body = std::move(*body);
    }
    return given;
}

Expected<TrackingGiven> load_joint_tracking(const CapturePlan& plan) {
    auto dancer = load_keypoint_take(plan);
    if (!dancer) {
        return fail(std::move(dancer.error()));
    }
    auto rig = load_rig_in_order(plan);
    auto edits = load_edits(plan);
    if (!rig || !edits) {
        return fail(std::move(rig ? edits.error() : rig.error()));
    }
    TrackingGiven given;
    given.dancer = std::move(*dancer);
    given.rig = std::move(*rig);
    given.markers = capture::keypoint_markers();
    given.clocks = given.dancer->clocks;
    given.edits = std::move(*edits);
    return given;
}

bool is_without_markers(const CapturePlan& plan) {
    return plan.is_markerless ||
           (!is_there(plan.file("labels.tsv")) && !is_there(plan.file("detections.csv")) &&
            std::all_of(plan.cameras.begin(), plan.cameras.end(), [&plan](const auto& camera) {
                return is_there(keypoint_file(plan, camera.name));
            }));
}

Expected<FollowedMarkers> track_with(const TrackingGiven& given,
                                     const std::vector<capture::Edit>& edits) {
    if (given.dancer) {
        auto joints = capture::follow_keypoints(given.rig, given.dancer->take, edits);
        if (!joints) {
            return fail(std::move(joints.error()));
        }
        FollowedMarkers followed;
        followed.stages.smoothed = std::move(joints->tracks);
        followed.shown = std::move(joints->shown);
        followed.lines = std::move(joints->lines);
        return followed;
    }
    const capture::TrackerInput input{
        given.rig, given.markers, given.seen, given.clocks, given.labels, edits};
    if (!given.angles) {
        auto stages = capture::track_markers(input, given.options);
        return stages ? Expected<FollowedMarkers>({.stages = std::move(*stages)})
                      : fail(std::move(stages.error()));
    }
    auto followed = capture::track_angles(input, given.options, *given.angles);
    if (!followed) {
        return fail(std::move(followed.error()));
    }
    return FollowedMarkers{std::move(followed->stages),
                           std::move(followed->angles),
                           std::move(followed->shape),
                           std::move(followed->size)};
}

}  // namespace raks::apps
