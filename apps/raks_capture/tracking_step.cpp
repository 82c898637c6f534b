#include "apps/raks_capture/tracking_step.hpp"

#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/film_step.hpp"

namespace raks::apps {

Expected<TrackingGiven> load_tracking(const CapturePlan& plan,
                                      const std::filesystem::path& labels_file,
                                      capture::ChromaForm form) {
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
                        {}};
    given.options.frames_per_second = plan.frames_per_second;
    given.options.first_time = plan.start;
    given.options.height = plan.height;
    given.options.check_order = false;
    return given;
}

Expected<capture::TrackerStages> track_with(const TrackingGiven& given,
                                            const std::vector<capture::Edit>& edits) {
    return capture::track_markers(
        {given.rig, given.markers, given.seen, given.clocks, given.labels, edits}, given.options);
}

}  // namespace raks::apps
