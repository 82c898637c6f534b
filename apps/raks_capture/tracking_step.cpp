#include "apps/raks_capture/tracking_step.hpp"

#include <algorithm>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/film_step.hpp"

namespace raks::apps {

bool is_body_followed(std::optional<TrackingMethod> said,
                      const capture::MarkerSet& markers,
                      std::size_t films) {
    // Salsa with five colours, each marker by itself: 51 % of the places are wrong with three
    // cameras, 8 % with four, and by a body 0.6 and 0.5 % (docs/measurements/capture.md).
    constexpr std::size_t kEnoughCameras = 5;
    constexpr std::ptrdiff_t kMarkersOfTrunk = 3;
    if (said) {
        return *said == TrackingMethod::angles;
    }
    using motion::Bone;
    const auto of_trunk = std::count_if(
        markers.markers.begin(), markers.markers.end(), [](const capture::Marker& marker) {
            return marker.bone == Bone::hips || marker.bone == Bone::spine ||
                   marker.bone == Bone::chest || marker.bone == Bone::upper_chest;
        });
    return films < kEnoughCameras && markers.colours().size() < markers.markers.size() &&
           of_trunk >= kMarkersOfTrunk;
}

Expected<TrackingGiven> load_tracking(const CapturePlan& plan,
                                      const std::filesystem::path& labels_file,
                                      capture::ChromaForm form,
                                      std::optional<TrackingMethod> method) {
    if (auto checked = check_cameras(plan); !checked) {
        return fail(std::move(checked.error()));
    }
    auto rig = load_capture_rig(plan);
    auto markers = load_markers(plan);
    auto clocks = load_clocks(plan);
    auto labels = load_labels(labels_file);
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
    TrackingGiven given{std::move(*rig),
                        std::move(*markers),
                        std::move(*seen),
                        std::move(*clocks),
                        std::move(*labels),
                        std::move(*edits),
                        {},
                        std::nullopt};
    given.options.frames_per_second = plan.frames_per_second;
    given.options.first_time = plan.start;
    given.options.height = plan.height;
    given.options.check_order = false;
    if (is_body_followed(method ? method : plan.method, given.markers, given.seen.films.size())) {
        given.angles.emplace();
        given.angles->body =
            plan.is_paper_body ? capture::BodyKind::paper : capture::BodyKind::dance;
    }
    return given;
}

Expected<FollowedMarkers> track_with(const TrackingGiven& given,
                                     const std::vector<capture::Edit>& edits) {
    const capture::TrackerInput input{
        given.rig, given.markers, given.seen, given.clocks, given.labels, edits};
    if (!given.angles) {
        auto stages = capture::track_markers(input, given.options);
        return stages ? Expected<FollowedMarkers>({std::move(*stages), std::nullopt, {}})
                      : fail(std::move(stages.error()));
    }
    auto followed = capture::track_angles(input, given.options, *given.angles);
    if (!followed) {
        return fail(std::move(followed.error()));
    }
    return FollowedMarkers{
        std::move(followed->stages), std::move(followed->angles), std::move(followed->shape)};
}

}  // namespace raks::apps
