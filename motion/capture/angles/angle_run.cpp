#include "motion/capture/angles/angle_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "motion/capture/angles/first_posture.hpp"
#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/angles/posture_search.hpp"

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
constexpr int kSoughtAfterMisses = 3;   // frames
constexpr int kAstrayAfter = 4;         // frames
constexpr double kFirstSeconds = 10.0;  // in which a body is sought where labels do not tell it

}  // namespace

AngleRun::AngleRun(const TrackRunInput& input,
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

void AngleRun::follow(std::size_t start, FrameRange range) {
    std::size_t done = 1;
    for (std::size_t frame = start + 1; frame < range.end; ++frame) {
        advance(frame, frame - 1, frame - start > 1 ? frame - 2 : frame - 1);
        if (!tell(++done)) {
            return;
        }
    }
    forget();
    for (std::size_t frame = start; frame-- > range.first;) {
        advance(frame, frame + 1, std::min(frame + 2, range.end - 1));
        if (!tell(++done)) {
            return;
        }
    }
    close_gaps(range);
}

// Fits each posture once more between its neighbours, all of them at once. More rounds than one
// round off what is quick.
void AngleRun::refine_all() {
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
std::vector<TrackedMarker> AngleRun::tracked(FrameRange range) {
    std::vector<TrackedMarker> result;
    for (std::size_t frame = range.first; frame < range.end; ++frame) {
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

AngleRun::FrameSpots AngleRun::spots_of(std::size_t frame) const {
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
                return spot.camera == said.camera && spot.colour == input_.classes[said.marker] &&
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

Expected<std::size_t> AngleRun::begin() {
    const auto labelled = posture_by_labels(context_, input_);
    if (!labelled) {
        return fail(labelled.error());
    }
    std::optional<std::size_t> start;
    if (*labelled) {
        start = (*labelled)->frame;
        track_.states[*start] = (*labelled)->state;
    } else {
        start = seek_first();
    }
    if (!start) {
        return fail(fmt::format(
            "no body is found in the first {:.0f} s, and {}: begin with arms held out to the "
            "sides, all markers in view, or run raks capture label",
            kFirstSeconds,
            input_.said.empty() ? "there are no labels"
                                : "no moment has 3 markers of the trunk that are labelled in two "
                                  "cameras each"));
    }
    constexpr int kTimes = 2;
    for (int i = 0; i < kTimes; ++i) {
        advance(*start, *start, *start);
    }
    return *start;
}

// The first frame in which the whole body is found; if none is whole the one that fits best.
std::optional<std::size_t> AngleRun::seek_first() {
    constexpr double kStepSeconds = 0.1;
    const auto frames_of = [this](double seconds) {
        return std::max<std::size_t>(1, static_cast<std::size_t>(seconds / input_.seconds));
    };
    const std::size_t end = std::min(track_.states.size(), frames_of(kFirstSeconds));
    std::optional<std::size_t> start;
    double least = 0.0;
    for (std::size_t frame = 0; frame < end; frame += frames_of(kStepSeconds)) {
        const auto found = sought_at(frame);
        if (!found || (start && !found->is_whole && found->energy >= least)) {
            continue;
        }
        start = frame;
        least = found->energy;
        track_.states[frame] = found->state;
        if (found->is_whole) {
            break;
        }
    }
    return start;
}

std::optional<AngleRun::SoughtPosture> AngleRun::sought_at(std::size_t frame) {
    const FrameSpots spots = spots_of(frame);
    const FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
    const auto state = seek_posture(frame, spots, marks);
    if (!state) {
        return std::nullopt;
    }
    const auto places = marker_places_of(context_, state->state);
    const std::vector<JointGroup>& limbs = filter_.division().limbs;
    const bool is_whole = std::all_of(limbs.begin(), limbs.end(), [&](const JointGroup& limb) {
        return seen_share(places, marks, limb.markers, kSeenWithin) >= kLeastSeenOfLimb;
    });
    return SoughtPosture{state->state, reprojection_energy(places, marks, kMatchGate), is_whole};
}

BodyState AngleRun::refined_at(std::size_t frame, const std::vector<double>& deviations) const {
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
void AngleRun::forget() {
    missed_ = 0;
    limb_misses_.clear();
    limb_sights_.clear();
}

// Where the body or a limb was lost, and found again, it is followed from there backward; what
// fits better is kept.
void AngleRun::close_gaps(FrameRange range) {
    const std::size_t frames = range.end;
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
std::pair<double, bool> AngleRun::assess(std::size_t frame) const {
    const FrameSpots spots = spots_of(frame);
    FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
    const auto places = marker_places_of(context_, track_.states[frame]);
    marks.set_motion(places, velocities_at(frame));
    bool is_doubtful = track_.is_lost[frame];
    for (const JointGroup& limb : filter_.division().limbs) {
        is_doubtful =
            is_doubtful || seen_share(places, marks, limb.markers, kSeenWithin) < kLeastSeenOfLimb;
    }
    return {reprojection_energy(places, marks, kMatchGate), is_doubtful};
}

// Finds a frame from its neighbour, and the one beyond that.
void AngleRun::advance(std::size_t frame, std::size_t before, std::size_t beyond) {
    const BodyState near = track_.states[before];
    const bool has_velocity = !track_.is_lost[before] && !track_.is_lost[beyond];
    const BodyState far = has_velocity ? track_.states[beyond] : near;
    const BodyState predicted = context_.model.between(far, near, 1.0 + filter_.kept_velocity());
    const FrameSpots spots = spots_of(frame);
    FrameMarks marks(*input_.rig, spots.spots, input_.classes, spots.is_hidden, spots.said);
    marks.set_motion(marker_places_of(context_, predicted),
                     velocities_between(far, near, before, beyond));
    FilteredPosture found = filter_.find(marks, {predicted, known_, limb_sights_}, frame);
    missed_ = is_on_spots(marks, found.state) ? 0 : missed_ + 1;
    if (missed_ >= kSoughtAfterMisses || (missed_ > 0 && track_.is_lost[before])) {
        if (auto again = seek_posture(frame, spots, marks)) {
            found = std::move(*again);
            missed_ = 0;
        }
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

// Looks for the body in a frame by itself.
std::optional<FilteredPosture> AngleRun::seek_posture(std::size_t frame,
                                                      const FrameSpots& spots,
                                                      const FrameMarks& marks) {
    const auto start = search_posture(
        context_, {*input_.rig, spots.spots, input_.classes, marks, input_.sigma}, 0.5);
    if (!start) {
        return std::nullopt;
    }
    FilteredPosture found{*start, {}};
    const std::vector<LimbSight> all(filter_.division().limbs.size(), LimbSight::astray);
    constexpr int kTimes = 3;
    for (int i = 0; i < kTimes; ++i) {
        found = filter_.find(marks, {found.state, known_, all}, frame);
    }
    return is_on_spots(marks, found.state) ? std::optional(std::move(found)) : std::nullopt;
}

// Counts the frames in which hardly a marker of a limb is seen where it should be.
void AngleRun::notice_limbs(const FrameMarks& marks, const BodyState& state) {
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

std::vector<glm::dvec3> AngleRun::velocities_between(const BodyState& far,
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
bool AngleRun::is_on_spots(const FrameMarks& marks, const BodyState& state) const {
    return seen_share(marker_places_of(context_, state),
                      marks,
                      filter_.division().trunk.markers,
                      kSeenWithin) >= kLeastSeenOfTrunk;
}

bool AngleRun::tell(std::size_t done) const {
    return !options_.progress ||
           options_.progress(static_cast<double>(done) / static_cast<double>(track_.states.size()));
}

std::vector<glm::dvec3> AngleRun::velocities_at(std::size_t frame) const {
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
TrackedMarker AngleRun::measured(const std::vector<PointView>& views,
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

}  // namespace raks::capture
