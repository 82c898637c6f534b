#include "motion/capture/tracking/marker_tracker.hpp"

#include "motion/capture/tracking/agreeing_cameras.hpp"
#include "motion/capture/tracking/track_flags.hpp"
#include "motion/capture/tracking/track_run.hpp"
#include "motion/capture/tracking/tracking_plan.hpp"

namespace raks::capture {

Expected<TrackerStages> track_markers(const TrackerInput& input, const TrackerOptions& options) {
    const auto plan = plan_tracking(input, options, LabelNeed::needed);
    if (!plan) {
        return fail(plan.error());
    }
    const Followed followed = follow_what_agrees(*plan, run_tracker);
    const Tracks empty = plan->empty_tracks();
    TrackerStages stages{empty, empty, empty, followed.moves};
    fill_stages(followed.tracked,
                plan->run,
                options.smoothing,
                stages.triangulated,
                stages.filtered,
                stages.smoothed);
    return stages;
}

}  // namespace raks::capture
