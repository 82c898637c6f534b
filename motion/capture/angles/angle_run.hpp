// Angle run: the frame-by-frame part of the angle tracker.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/angles/angle_filter.hpp"
#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/angles/angle_tracker.hpp"
#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/tracking/frame_views.hpp"
#include "motion/capture/tracking/track_run.hpp"

namespace raks::capture {

/// Frames [first, end).
struct FrameRange {
    std::size_t first = 0;
    std::size_t end = 0;
};

/// One run through the frames of a take with a body of one shape. Threads: one caller; it uses
/// those of the filter.
class AngleRun {
 public:
    /// What is referred to must outlive it.
    AngleRun(const TrackRunInput& input,
             FrameViews& views,
             std::size_t frame_count,
             const FrameContext& context,
             const AngleTrackerOptions& options,
             const AngleFilterOptions& filter);

    /// The first posture: by labels, or where too few are given by what the first seconds show.
    /// Returns its frame. Errors: those of posture_by_labels; neither labels nor a body that is
    /// found.
    [[nodiscard]] Expected<std::size_t> begin();

    /// Every frame of a stretch, from that of the first posture on, forward and then backward.
    /// A person who stops it keeps the frames that were done; the others are lost.
    void follow(std::size_t start, FrameRange range);

    /// Every frame of the take.
    [[nodiscard]] FrameRange all() const noexcept { return {0, track_.states.size()}; }

    /// Fits each posture once more between its neighbours, all of them at once. More rounds than
    /// one round off what is quick.
    void refine_all();

    /// What the cameras saw of each marker where the postures have it: frames of the range x
    /// markers.
    [[nodiscard]] std::vector<TrackedMarker> tracked(FrameRange range);

    [[nodiscard]] AngleTrack& track() noexcept { return track_; }

 private:
    /// The spots of a frame, with those that a person said and no detector found.
    struct FrameSpots {
        std::vector<SeenSpot> spots;
        std::vector<bool> is_hidden;  ///< by marker
        std::vector<SaidView> said;
    };
    [[nodiscard]] FrameSpots spots_of(std::size_t frame) const;
    // A posture that the spots of a frame alone tell, and how badly it fits; none: none is found.
    struct SoughtPosture {
        BodyState state;
        double energy = 0.0;
        bool is_whole = false;  ///< all limbs are seen
    };
    [[nodiscard]] std::optional<std::size_t> seek_first();
    [[nodiscard]] std::optional<SoughtPosture> sought_at(std::size_t frame);
    [[nodiscard]] BodyState refined_at(std::size_t frame,
                                       const std::vector<double>& deviations) const;
    // What was noticed of the frames before does not hold where another pass begins.
    void forget();
    // Where the body or a limb was lost, and found again, it is followed from there backward; what
    // fits better is kept.
    void close_gaps(FrameRange range);
    // How badly the posture of a frame fits, and whether the body or a limb is lost there.
    [[nodiscard]] std::pair<double, bool> assess(std::size_t frame) const;
    // Finds a frame from its neighbour, and the one beyond that.
    void advance(std::size_t frame, std::size_t before, std::size_t beyond);
    // Looks for the body in a frame by itself.
    [[nodiscard]] std::optional<FilteredPosture> seek_posture(std::size_t frame,
                                                              const FrameSpots& spots,
                                                              const FrameMarks& marks);
    // Counts the frames in which hardly a marker of a limb is seen where it should be.
    void notice_limbs(const FrameMarks& marks, const BodyState& state);
    [[nodiscard]] std::vector<glm::dvec3> velocities_between(const BodyState& far,
                                                             const BodyState& near,
                                                             std::size_t before,
                                                             std::size_t beyond) const;
    // Whether enough markers of the trunk are seen where a posture has them.
    [[nodiscard]] bool is_on_spots(const FrameMarks& marks, const BodyState& state) const;
    [[nodiscard]] bool tell(std::size_t done) const;
    [[nodiscard]] std::vector<glm::dvec3> velocities_at(std::size_t frame) const;
    // A marker by its views, or by the body where they are too few.
    [[nodiscard]] TrackedMarker measured(const std::vector<PointView>& views,
                                         const glm::dvec3& on_body) const;
    const TrackRunInput& input_;
    FrameViews& views_;
    FrameContext context_;
    const AngleTrackerOptions& options_;
    AngleFilter filter_;
    int threads_;
    AngleTrack track_;
    std::vector<BodyState> known_;
    int missed_ = 0;                        // frames since the body was seen
    std::vector<std::size_t> limb_misses_;  // by limb: frames since it was seen
    std::vector<LimbSight> limb_sights_;
};

}  // namespace raks::capture
