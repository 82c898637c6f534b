#include "motion/capture/tracking/agreeing_cameras.hpp"

#include <utility>

namespace raks::capture {
namespace {

// Forgets what cameras saw while they disagree, what a person said of it included.
void forget_moves(const std::vector<CameraMove>& moves, TrackRunInput& run, FrameViews& views) {
    for (const CameraMove& move : moves) {
        const std::size_t camera = *run.rig->index_of(move.camera);
        views.forget(camera, move.first, move.last);
        std::erase_if(run.said, [&](const SaidView& said) {
            return said.camera == camera && said.frame >= move.first && said.frame <= move.last;
        });
    }
}

}  // namespace

Followed follow_what_agrees(const TrackingPlan& plan, const FollowMarkers& follow) {
    const std::size_t frame_count = plan.line.frame_count;
    FrameViews views = plan.all_views();
    Followed followed{follow(plan.run, views, frame_count), {}, 0};
    std::size_t calls = 1;
    for (std::size_t left = plan.run.rig->cameras.size(); left > 2; --left) {
        TrackRunInput run = plan.run;
        FrameViews fewer = plan.all_views();
        forget_moves(followed.moves, run, fewer);
        const auto found = find_moved_camera(run, fewer, followed.tracked);
        if (found.empty()) {
            break;
        }
        forget_moves(found, run, fewer);
        auto tracked = follow(run, fewer, frame_count);
        ++calls;
        FrameViews whole = plan.all_views();
        forget_moves(followed.moves, run, whole);
        const auto again = find_moved_camera(run, whole, tracked);
        if (again.empty() || again.front().camera != found.front().camera) {
            break;
        }
        followed.tracked = std::move(tracked);
        followed.call = calls - 1;
        followed.moves.insert(followed.moves.end(), found.begin(), found.end());
    }
    return followed;
}

}  // namespace raks::capture
