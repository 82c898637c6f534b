#include "motion/capture/angles/angle_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/dice.hpp"
#include "base/parallel.hpp"
#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/angles/posture_search.hpp"
#include "motion/capture/solving/frame_fit.hpp"
#include "motion/capture/tracking/agreeing_cameras.hpp"
#include "motion/capture/tracking/track_flags.hpp"
#include "motion/capture/tracking/tracking_plan.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

// Between its neighbours a posture is so far off, times the motion scale.
constexpr double kBetweenNeighbours = 1.0;
constexpr double kMatchGate = 12.0;  // pixels: a spot so near to a marker may be its own
// A place that only the body tells is believed so far: metres, at the end of a limb.
constexpr double kBodyDeviation = 0.03;

constexpr double kSeenWithin = 8.0;        // pixels: a marker so near to a spot is seen
constexpr double kLeastSeenOfTrunk = 0.3;  // of its markers by two pictures, or the body is lost
constexpr double kLeastSeenOfLimb = 0.6;
constexpr int kSoughtAfterMisses = 3;  // frames
constexpr int kAstrayAfter = 4;        // frames

/// One run through all frames.
class AngleRun {
 public:
    AngleRun(const TrackRunInput& input,
             FrameViews& views,
             std::size_t frame_count,
             const FrameContext& context,
             const AngleTrackerOptions& options,
             const AngleFilterOptions& filter)
        : input_(input),
          views_(views),
          context_(context),
          options_(options),
          filter_(context, filter),
          threads_(filter.threads) {
        track_.states.resize(frame_count);
        track_.deviations.assign(frame_count, std::vector<double>(context.model.variables()));
        track_.is_lost.resize(frame_count, true);
        track_.frames_per_second = 1.0 / input.seconds;
    }

    // Every frame, from that of the labels on, forward and then backward. A person who stops it
    // keeps the frames that were done; the others are lost.
    Expected<void> follow() {
        const auto start = begin();
        if (!start) {
            return fail(start.error());
        }
        const std::size_t frames = track_.states.size();
        std::size_t done = 1;
        for (std::size_t frame = *start + 1; frame < frames; ++frame) {
            advance(frame, frame - 1, frame - *start > 1 ? frame - 2 : frame - 1);
            if (!tell(++done)) {
                return {};
            }
        }
        forget();
        for (std::size_t frame = *start; frame-- > 0;) {
            advance(frame, frame + 1, std::min(frame + 2, frames - 1));
            if (!tell(++done)) {
                return {};
            }
        }
        close_gaps();
        return {};
    }

    // Fits each posture once more between its neighbours, all of them at once. More rounds than one
    // round off what is quick.
    void refine_all() {
        std::vector<double> deviations = motion_scale(context_.model, 1.0 / input_.seconds);
        for (double& deviation : deviations) {
            deviation *= kBetweenNeighbours;
        }
        std::vector<BodyState> refined = track_.states;
        run_parallel(track_.states.size(), threads_, [&](std::size_t frame) {
            if (!track_.is_lost[frame]) {
                refined[frame] = refined_at(frame, deviations);
            }
        });
        track_.states = std::move(refined);
    }

    // What the cameras saw of each marker where the postures have it.
    [[nodiscard]] std::vector<TrackedMarker> tracked() {
        std::vector<TrackedMarker> result;
        for (std::size_t frame = 0; frame < track_.states.size(); ++frame) {
            if (track_.is_lost[frame]) {
                result.resize(result.size() + input_.classes.size());
                continue;
            }
            const std::vector<glm::dvec3> places = marker_places_of(context_, track_.states[frame]);
            const std::vector<glm::dvec3> velocities = velocities_at(frame);
            const FrameSpots spots = spots_of(frame);
            FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
            marks.set_motion(places, velocities);
            std::vector<std::vector<PointView>> seen(places.size());
            for (const MatchedMark& matched : match_marks(places, marks, kMatchGate)) {
                const SeenSpot& spot = spots.spots[marks.marks()[matched.mark].spot];
                seen[matched.marker].push_back(view_of(spot, velocities[matched.marker]));
            }
            for (std::size_t marker = 0; marker < places.size(); ++marker) {
                result.push_back(measured(seen[marker], places[marker]));
            }
        }
        return result;
    }

    [[nodiscard]] AngleTrack& track() { return track_; }

 private:
    /// The spots of a frame, with those that a person said and no detector found.
    struct FrameSpots {
        std::vector<SeenSpot> spots;
        std::vector<bool> is_hidden;  ///< by marker
        std::vector<SaidView> said;
    };

    [[nodiscard]] FrameSpots spots_of(std::size_t frame) const {
        FrameSpots found{views_.at(frame), std::vector<bool>(input_.classes.size()), {}};
        for (const MarkerStretch& stretch : input_.hidden) {
            if (frame >= stretch.first && frame <= stretch.last) {
                found.is_hidden[stretch.marker] = true;
            }
        }
        for (const SaidView& said : input_.said) {
            if (said.frame != frame) {
                continue;
            }
            found.said.push_back(said);
            constexpr double kSaidRadius = 6.0;  // pixels, as FrameMarks has it
            const bool is_found =
                std::any_of(found.spots.begin(), found.spots.end(), [&](const SeenSpot& spot) {
                    return spot.camera == said.camera &&
                           spot.colour == input_.classes[said.marker] &&
                           glm::distance(spot.pixel, said.pixel) < kSaidRadius;
                });
            if (!is_found) {
                const Lens& lens = input_.rig->cameras[said.camera].lens;
                found.spots.push_back({said.camera,
                                       input_.classes[said.marker],
                                       said.pixel,
                                       direction_of(lens, said.pixel),
                                       said.late});
            }
        }
        return found;
    }

    // The first posture, from the frame in which most markers are labelled.
    Expected<std::size_t> begin() {
        std::vector<std::size_t> frames;
        for (const SaidView& said : input_.said) {
            frames.push_back(said.frame);
        }
        std::sort(frames.begin(), frames.end());
        frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
        std::size_t start = 0;
        FrameSight most;
        for (const std::size_t frame : frames) {
            FrameSight sight = labelled_at(frame);
            if (sight.markers.size() > most.markers.size()) {
                most = std::move(sight);
                start = frame;
            }
        }
        const auto of_trunk =
            std::count_if(most.markers.begin(), most.markers.end(), [this](const SeenMarker& seen) {
                return is_of_trunk(context_.marker_bones[seen.marker]);
            });
        if (of_trunk < 3) {
            return fail(
                "no moment has 3 markers of the trunk that are labelled in two cameras each; run "
                "raks capture label");
        }
        FrameContext wide = context_;
        wide.weights.outlier = 0.15;  // metres: markers may sit elsewhere
        const BodyState usual = context_.model.usual_state(context_.shape);
        track_.states[start] = find_frame(wide, most, usual).state;
        constexpr int kTimes = 2;
        for (int i = 0; i < kTimes; ++i) {
            advance(start, start, start);
        }
        return start;
    }

    [[nodiscard]] FrameSight labelled_at(std::size_t frame) const {
        FrameSight sight;
        for (std::size_t marker = 0; marker < input_.classes.size(); ++marker) {
            std::vector<PointView> views;
            for (const SaidView& said : input_.said) {
                if (said.frame == frame && said.marker == marker) {
                    views.push_back(
                        {said.camera,
                         direction_of(input_.rig->cameras[said.camera].lens, said.pixel)});
                }
            }
            if (const auto point = triangulate(*input_.rig, views, input_.sigma)) {
                sight.markers.push_back({marker, point->place, 0.01});
            }
        }
        return sight;
    }

    [[nodiscard]] BodyState refined_at(std::size_t frame,
                                       const std::vector<double>& deviations) const {
        const std::size_t last = track_.states.size() - 1;
        const std::size_t before = frame > 0 ? frame - 1 : frame;
        const std::size_t after = std::min(frame + 1, last);
        const bool has_both =
            before != frame && after != frame && !track_.is_lost[before] && !track_.is_lost[after];
        if (!has_both) {
            return track_.states[frame];
        }
        const BodyState between =
            context_.model.between(track_.states[before], track_.states[after], 0.5);
        const FrameSpots spots = spots_of(frame);
        FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
        marks.set_motion(marker_places_of(context_, track_.states[frame]), velocities_at(frame));
        return refine(context_, marks, input_.sigma, {between, deviations}, track_.states[frame]);
    }

    // What was noticed of the frames before does not hold where another pass begins.
    void forget() {
        missed_ = 0;
        limb_misses_.clear();
        limb_sights_.clear();
    }

    // Where the body or a limb was lost, and found again, it is followed from there backward; what
    // fits better is kept.
    void close_gaps() {
        const std::size_t frames = track_.states.size();
        std::vector<double> energies(frames);
        std::vector<bool> is_doubtful(frames);
        std::size_t run = 0;
        for (std::size_t frame = 0; frame < frames; ++frame) {
            const auto [energy, doubt] = assess(frame);
            energies[frame] = energy;
            run = doubt ? run + 1 : 0;
            for (std::size_t i = 0; run >= kAstrayAfter && i < run; ++i) {
                is_doubtful[frame - i] = true;
            }
            is_doubtful[frame] = is_doubtful[frame] || track_.is_lost[frame];
        }
        for (std::size_t last = frames; last-- > 1;) {
            if (!is_doubtful[last - 1] || is_doubtful[last] || track_.is_lost[last]) {
                continue;
            }
            forget();
            const AngleTrack before = track_;
            std::size_t frame = last;
            while (frame-- > 0) {
                advance(frame, frame + 1, std::min(frame + 2, std::min(last + 1, frames - 1)));
                const double energy = assess(frame).first;
                const bool is_better =
                    !track_.is_lost[frame] && (before.is_lost[frame] || energy < energies[frame]);
                if (!is_better) {
                    track_.states[frame] = before.states[frame];
                    track_.deviations[frame] = before.deviations[frame];
                    track_.is_lost[frame] = before.is_lost[frame];
                }
                if (!is_better && !is_doubtful[frame]) {
                    break;
                }
            }
            last = frame + 1;
        }
    }

    // How badly the posture of a frame fits, and whether the body or a limb is lost there.
    [[nodiscard]] std::pair<double, bool> assess(std::size_t frame) const {
        const FrameSpots spots = spots_of(frame);
        FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
        const auto places = marker_places_of(context_, track_.states[frame]);
        marks.set_motion(places, velocities_at(frame));
        bool is_doubtful = track_.is_lost[frame];
        for (const JointGroup& limb : filter_.division().limbs) {
            is_doubtful = is_doubtful ||
                          seen_share(places, marks, limb.markers, kSeenWithin) < kLeastSeenOfLimb;
        }
        return {reprojection_energy(places, marks, kMatchGate), is_doubtful};
    }

    // Finds a frame from its neighbour, and the one beyond that.
    void advance(std::size_t frame, std::size_t before, std::size_t beyond) {
        const BodyState near = track_.states[before];
        const bool has_velocity = !track_.is_lost[before] && !track_.is_lost[beyond];
        const BodyState far = has_velocity ? track_.states[beyond] : near;
        const BodyState predicted =
            context_.model.between(far, near, 1.0 + filter_.kept_velocity());
        const FrameSpots spots = spots_of(frame);
        FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
        marks.set_motion(marker_places_of(context_, predicted),
                         velocities_between(far, near, before, beyond));
        FilteredPosture found = filter_.find(marks, {predicted, known_, limb_sights_}, frame);
        missed_ = is_on_spots(marks, found.state) ? 0 : missed_ + 1;
        if (missed_ >= kSoughtAfterMisses || (missed_ > 0 && track_.is_lost[before])) {
            seek(frame, spots, marks, found);
        }
        track_.deviations[frame] = std::move(found.deviations);
        track_.is_lost[frame] = missed_ > 0;
        // A body that is lost waits where it was seen last.
        track_.states[frame] = missed_ > 0 ? near : std::move(found.state);
        notice_limbs(marks, track_.states[frame]);
        constexpr std::size_t kKeptEvery = 5;  // frames
        if (missed_ == 0 && frame % kKeptEvery == 0) {
            known_.push_back(track_.states[frame]);
        }
    }

    // Looks for a lost body in a frame by itself.
    void seek(std::size_t frame,
              const FrameSpots& spots,
              const FrameMarks& marks,
              FilteredPosture& found) {
        const auto start = search_posture(
            context_, {*input_.rig, spots.spots, input_.classes, marks, input_.sigma}, 0.5);
        if (!start) {
            return;
        }
        FilteredPosture again{*start, {}};
        const std::vector<LimbSight> all(filter_.division().limbs.size(), LimbSight::astray);
        constexpr int kTimes = 3;
        for (int i = 0; i < kTimes; ++i) {
            again = filter_.find(marks, {again.state, known_, all}, frame);
        }
        if (is_on_spots(marks, again.state)) {
            found = std::move(again);
            missed_ = 0;
        }
    }

    // Counts the frames in which hardly a marker of a limb is seen where it should be.
    void notice_limbs(const FrameMarks& marks, const BodyState& state) {
        const auto places = marker_places_of(context_, state);
        const std::vector<JointGroup>& limbs = filter_.division().limbs;
        limb_misses_.resize(limbs.size());
        limb_sights_.resize(limbs.size());
        for (std::size_t i = 0; i < limbs.size(); ++i) {
            const bool is_seen =
                seen_share(places, marks, limbs[i].markers, kSeenWithin) >= kLeastSeenOfLimb;
            limb_misses_[i] = is_seen ? 0 : limb_misses_[i] + 1;
            limb_sights_[i] = limb_misses_[i] >= kAstrayAfter ? LimbSight::astray
                              : is_seen                       ? LimbSight::seen
                                                              : LimbSight::missed;
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> velocities_between(const BodyState& far,
                                                             const BodyState& near,
                                                             std::size_t before,
                                                             std::size_t beyond) const {
        const std::vector<glm::dvec3> far_places = marker_places_of(context_, far);
        std::vector<glm::dvec3> velocities = marker_places_of(context_, near);
        const double seconds =
            input_.seconds * (static_cast<double>(before) - static_cast<double>(beyond));
        for (std::size_t i = 0; i < velocities.size(); ++i) {
            velocities[i] =
                seconds != 0.0 ? (velocities[i] - far_places[i]) / seconds : glm::dvec3(0.0);
        }
        return velocities;
    }

    // Whether enough markers of the trunk are seen where a posture has them.
    [[nodiscard]] bool is_on_spots(const FrameMarks& marks, const BodyState& state) const {
        return seen_share(marker_places_of(context_, state),
                          marks,
                          filter_.division().trunk.markers,
                          kSeenWithin) >= kLeastSeenOfTrunk;
    }

    [[nodiscard]] bool tell(std::size_t done) const {
        return !options_.progress || options_.progress(static_cast<double>(done) /
                                                       static_cast<double>(track_.states.size()));
    }

    [[nodiscard]] std::vector<glm::dvec3> velocities_at(std::size_t frame) const {
        const std::size_t before = frame > 0 ? frame - 1 : frame;
        const std::size_t after = std::min(frame + 1, track_.states.size() - 1);
        const auto from = marker_places_of(context_, track_.states[before]);
        auto to = marker_places_of(context_, track_.states[after]);
        const double seconds =
            input_.seconds * static_cast<double>(std::max<std::size_t>(1, after - before));
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] = (to[i] - from[i]) / seconds;
        }
        return to;
    }

    // A marker by its views, or by the body where they are too few.
    [[nodiscard]] TrackedMarker measured(const std::vector<PointView>& views,
                                         const glm::dvec3& on_body) const {
        TrackedMarker marker;
        marker.views = views.size();
        const auto point = triangulate(*input_.rig, views, input_.sigma);
        constexpr double kLargestResidual = 4.0;  // sigma
        if (point && point->residual < kLargestResidual * input_.sigma + 1.0) {
            marker.measured = MeasuredPlace{point->place, point->covariance};
            marker.views = point->views.size();
            marker.residual = point->residual;
        } else {
            marker.measured = MeasuredPlace{on_body, glm::dmat3(kBodyDeviation * kBodyDeviation)};
            marker.is_of_body = true;
        }
        marker.belief = first_belief(*marker.measured);
        return marker;
    }

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

// Makes a body wrong: each bone and each place on it by another factor.
void spoil(double error, std::uint64_t seed, BodyShape& shape) {
    Dice dice(seed, 620);
    for (glm::dvec3& place : shape.marker_places) {
        place *= 1.0 + dice.normal(error);
    }
    for (std::size_t i = 1; i < shape.offsets.size(); ++i) {
        shape.offsets[i] *= 1.0 + dice.normal(error);
    }
}

}  // namespace

Expected<AngleStages> track_angles(const TrackerInput& input,
                                   const TrackerOptions& options,
                                   const AngleTrackerOptions& angles) {
    const auto plan = plan_tracking(input, options, LabelNeed::needed);
    if (!plan) {
        return fail(plan.error());
    }
    const BodyModel model(angles.body);
    BodySize size;
    size.whole = options.height > 0.0 ? options.height / kMannequinHeight : 1.0;
    BodyShape shape = shape_of(size, input.markers);
    if (angles.body_error > 0.0) {
        spoil(angles.body_error, angles.filter.seed, shape);
    }
    std::vector<motion::Bone> bones;
    for (const Marker& marker : input.markers.markers) {
        bones.push_back(marker.bone);
    }
    FrameWeights weights;
    weights.usual = 0.05;
    const FrameContext context{model, bones, shape, weights};
    AngleFilterOptions filter = angles.filter;
    filter.sigma = options.sigma;
    filter.frames_per_second = options.frames_per_second;
    std::vector<AngleTrack> runs;
    std::optional<Error> error;
    const Followed followed = follow_what_agrees(
        *plan, [&](const TrackRunInput& run, FrameViews& views, std::size_t frame_count) {
            AngleRun follower(run, views, frame_count, context, angles, filter);
            if (auto done = follower.follow(); !done) {
                error = std::move(done.error());
                return std::vector<TrackedMarker>(frame_count * run.classes.size());
            }
            if (filter.is_polished) {
                follower.refine_all();
            }
            auto tracked = follower.tracked();
            runs.push_back(std::move(follower.track()));
            return tracked;
        });
    if (error) {
        return fail(std::move(*error));
    }
    const Tracks empty = plan->empty_tracks();
    AngleStages result{{empty, empty, empty, followed.moves}, runs[followed.call], shape};
    result.angles.first_time = plan->line.first;
    fill_stages(followed.tracked,
                plan->run,
                options.smoothing,
                result.stages.triangulated,
                result.stages.filtered,
                result.stages.smoothed);
    return result;
}

}  // namespace raks::capture
