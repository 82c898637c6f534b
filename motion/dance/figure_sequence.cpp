#include "motion/dance/figure_sequence.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/pose_join.hpp"

namespace raks::motion {
namespace {

// Two figures may plant a foot this far apart, metres; beyond it the foot would visibly slide.
constexpr float kSeenToSlide = 0.03F;
// How a foot moves from one figure to the next, in order of preference: (1) during the next
// figure's own step, if that takes at least 0.135 s; (2) during the last figure's step; (3) by an
// added step.
//
// 0.135 s is kLeastSwing, measured at the learnt tempo; it also holds for (2), since a foot that
// changes figures in half of that time is thrown. In (1), if the last figure steps at the same
// time, the foot goes straight from where it stood: one that turned back half way up was detected
// as a landing, 0.1 s early. In (3), the step lasts until the next figure plants the foot, if it is
// in the air as the join ends; otherwise the left foot steps before the change and the right one
// after it. Units: beats, except where given.
constexpr double kLeastSwing = 0.135;  // seconds
// Latest end, after the change, of a swing that began before it.
constexpr double kLatestSwing = 1.3;
// A swing may only seem to land if it ends less than this before the margin does...
constexpr double kCreeps = 0.2;
// ... with the foot lower than this, metres; a higher one still hangs in the air.
constexpr float kCreepsUnder = 0.05F;
constexpr double kStepNearest = 0.1;   // an added step lies between this...
constexpr double kStepFarthest = 0.7;  // ... and this, before or after the change
constexpr double kLongestStep = 0.8;   // a longer step gets slow enough to be detected as a landing
constexpr float kStepLift = 0.05F;     // metres, at the middle of the step
constexpr int kFootSamples = 16;       // samples of both figures over the join
constexpr float kStillMetres = 0.012F;  // metres between two samples, up to which a foot rests
// Where a figure begins with the foot that carries, the weight goes back to the other one in time
// for that step, which leaves the floor 0.6 beats before count 1 or later. A foot that stands in
// both figures goes over between the last touch, a beat before, and that.
constexpr std::array<double, 2> kWeightGoesBack = {-1.45, -0.35};  // beats from the change
constexpr std::array<double, 2> kBothStand = {-1.0, -0.6};         // beats from the change
constexpr double kLooksAtFeet = -0.7;      // when places are compared; beats from the change
constexpr float kNearFeet = 0.12F;         // metres that a foot may stand apart then
constexpr double kShortestToChange = 4.0;  // beats of a figure
constexpr std::uint64_t kSideStream = 6;   // of random numbers
// Calm music, in which figures may be danced at half the tempo, and how many of those that can are.
constexpr double kCalmEnergy = 0.30;
constexpr double kSlowShare = 0.5;
constexpr int kLongestSlow = 4;  // beats of a figure: it must be over soon when all comes in
constexpr std::uint64_t kTempoStream = 7;

// Horizontal distance.
float over_floor(const glm::vec3& a, const glm::vec3& b) noexcept {
    return glm::length(glm::vec2(a.x - b.x, a.z - b.z));
}

/// The paper's generator plants no foot, so there rotations suffice.
Pose average(const DanceContent& content,
             const Pose& from,
             const Pose& to,
             float share,
             const std::array<FootShare, 2>& feet) noexcept {
    return content.generator == Generator::frames
               ? interpolate(from, to, share)
               : joined_poses(content.skeleton, from, to, share, feet);
}

}  // namespace

// All half turns of a dance are about the same point, so that of any such figure serves.
FloorMove floor_of(const DanceContent& content,
                   const FloorMove& stage,
                   bool is_turned) noexcept RAKS_NONBLOCKING {
    if (is_turned) {
        for (const LibraryFigure& figure : content.figures) {
            if (figure.turns_half) {
                return stage * figure.place * figure.move * inverse(figure.place);
            }
        }
    }
    return stage;
}

void FigureSequence::start(const DanceContent& content,
                           const FloorMove& stage,
                           const DancerPart& part,
                           bool stands_turned) noexcept RAKS_NONBLOCKING {
    content_ = &content;
    stage_ = stage;
    seed_ = part.seed;
    ways_ = part.ways;
    is_in_couple_ = part.is_in_couple;
    // Two would have to decide alike, though their feet are not.
    slows_ = part.dynamics == Dynamics::on;
    mirrors_ = part.dynamics == Dynamics::on && !part.is_in_couple;
    before_.reset();
    next_.reset();
    current_ = {choose(0, number_), 0.0, stands_turned, {}};
}

FigureChoice FigureSequence::choose(std::size_t figure, std::uint64_t number) const noexcept {
    const LibraryFigure& own = content_->figures[figure];
    FigureChoice choice = choose_ways(figure, ways_, number);
    choice.size = figure_size(own.size_by_tempo, own.learnt_tempo, tempo_);
    return choice;
}

double FigureSequence::end_of(const Danced& danced) const noexcept RAKS_NONBLOCKING {
    return danced.start + danced.stretch * content_->figures[danced.choice.figure].beats;
}

bool FigureSequence::turned_after(const Danced& danced) const noexcept {
    return danced.is_turned != content_->figures[danced.choice.figure].turns_half;
}

void FigureSequence::advance(Beats phase,
                             double energy,
                             FigureWish& wish) noexcept RAKS_NONBLOCKING {
    const double end = end_of(current_);
    if (!next_ && phase.count() >= end - kDecided) {
        const bool is_turned = turned_after(current_);
        const Audience audience = is_in_couple_ ? Audience::none
                                  : is_turned   ? Audience::behind
                                                : Audience::ahead;
        const std::size_t figure = content_->chooser.next(
            {current_.choice.figure, energy, audience}, wish, seed_, number_ + 1);
        // The next figure is drawn before the feet are planned: how a foot joins depends on both.
        next_ = {choose(figure, number_ + 1), end, is_turned, {}};
        take_tempo(*next_, energy, wish.is_locked);
        take_side(*next_, wish.is_locked);
        const std::array<FootState, 2> feet = states_of_feet(current_, *next_);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            next_->feet[s] = next_->changes_foot ? foot_join_to_other_foot(*next_, side, feet[s])
                                                 : foot_join(current_, *next_, side, feet[s]);
        }
        wish.is_another = false;
        wish.figure.reset();
    }
    // The change itself; the last figure is kept until its feet have joined.
    if (next_ && phase.count() >= end) {
        before_ = current_;
        current_ = *next_;
        next_.reset();
        ++number_;
    }
}

void FigureSequence::jump(Beats phase) noexcept RAKS_NONBLOCKING {
    const bool is_turned = turned_after(current_);
    ++number_;
    current_ = {choose(0, number_), 0.0, is_turned, {}};
    const double beats = figure().beats;
    // The first figure repeats from phase 0, so the phase tells its beat.
    current_.start = beats * std::floor(phase.count() / beats);
    before_.reset();
    next_.reset();
}

Pose FigureSequence::pose_of(const Danced& danced,
                             double phase,
                             const Manner& manner) const noexcept {
    const double beat = (phase - danced.start) / danced.stretch;
    const Pose pose = motion::pose_of(*content_, danced.choice, beat, manner);
    const LibraryFigure& figure = content_->figures[danced.choice.figure];
    const FloorMove& place = danced.choice.is_mirrored ? figure.sides.mirrored_place : figure.place;
    return (floor_of(*content_, stage_, danced.is_turned) * place)(pose);
}

std::optional<Side> FigureSequence::leading_foot(const Danced& danced) const noexcept {
    const std::optional<Side> leads = content_->figures[danced.choice.figure].sides.leads;
    if (!leads || !danced.choice.is_mirrored) {
        return leads;
    }
    return *leads == Side::left ? Side::right : Side::left;
}

void FigureSequence::take_tempo(Danced& next, double energy, bool is_locked) const noexcept {
    const LibraryFigure& figure = content_->figures[next.choice.figure];
    if (slows_ && !is_locked && figure.can_slow && figure.beats <= kLongestSlow &&
        energy < kCalmEnergy &&
        CounterRandom(seed_, kTempoStream).uniform(number_ + 1) < kSlowShare) {
        next.stretch = 2.0;
        next.choice.size = figure_size(
            figure.size_by_tempo, figure.learnt_tempo, Bpm(tempo_.bpm() / next.stretch));
    }
}

// The side on which it begins with the free foot, now and then the other one. Where no foot is
// free, both sides fit.
void FigureSequence::take_side(Danced& next, bool is_locked) const noexcept {
    const LibraryFigure& figure = content_->figures[next.choice.figure];
    if (!mirrors_ || !figure.sides.can_mirror) {
        return;
    }
    const double share = is_locked ? 0.0 : content_->chooser.habits().mirror;
    const bool wants_other = CounterRandom(seed_, kSideStream).uniform(number_ + 1) < share;
    const std::optional<Side> foot = leading_foot(current_);
    if (!foot || !figure.sides.leads) {
        next.choice.is_mirrored = wants_other != current_.choice.is_mirrored;
        return;
    }
    const bool fits_mirrored = *foot != *figure.sides.leads;
    next.choice.is_mirrored = fits_mirrored;
    if (wants_other) {
        next.choice.is_mirrored = !fits_mirrored;
        next.changes_foot = can_change_foot(current_, next);
        next.choice.is_mirrored = next.changes_foot != fits_mirrored;
    }
}

bool FigureSequence::can_change_foot(const Danced& before, const Danced& after) const noexcept {
    for (const Danced* const danced : {&before, &after}) {
        if (danced->stretch != 1.0 ||
            content_->figures[danced->choice.figure].beats < kShortestToChange) {
            return false;
        }
    }
    const double phase = after.start + kLooksAtFeet;
    const std::array<Pose, 2> poses = {pose_of(before, phase, {}), pose_of(after, phase, {})};
    const std::array<WorldPose, 2> worlds = {world_body(content_->skeleton, poses[0]),
                                             world_body(content_->skeleton, poses[1])};
    return std::all_of(kSides.begin(), kSides.end(), [&](Side side) {
        const auto s = static_cast<std::size_t>(side);
        return poses[0].foot_contact[s] && poses[1].foot_contact[s] &&
               over_floor(foot_place(content_->skeleton, worlds[0], side).pivot,
                          foot_place(content_->skeleton, worlds[1], side).pivot) < kNearFeet;
    });
}

double FigureSequence::margin_between(const Danced& before, const Danced& after) const noexcept {
    const int shorter = std::min(content_->figures[before.choice.figure].beats,
                                 content_->figures[after.choice.figure].beats);
    return std::min(FigurePassage::kMargin, 0.5 * shorter);
}

Pose FigureSequence::joined(const Danced& before,
                            const Danced& after,
                            double phase,
                            const Manner& manner) const noexcept {
    const auto [from, to] = body_join(before, after);
    const float share =
        smootherstep(static_cast<float>((phase - after.start - from) / (to - from)));
    std::array<FootShare, 2> feet{};
    for (std::size_t s = 0; s < feet.size(); ++s) {
        const FootJoin& join = after.feet[s];
        feet[s].share = share;
        // An own swing: the foot moves with it alone, by smootherstep, lifted by a parabola in its
        // share.
        if (join.to > join.from) {
            const double u = (phase - after.start - join.from) / (join.to - join.from);
            const float own = smootherstep(static_cast<float>(u));
            feet[s].share = own;
            feet[s].lift = join.is_lifted ? kStepLift * 4.0F * own * (1.0F - own) : 0.0F;
        }
        if (phase > after.start + join.held) {
            const WorldPose world =
                world_body(content_->skeleton, pose_of(before, after.start + join.held, manner));
            feet[s].held = foot_place(content_->skeleton, world, kSides[s]);
            feet[s].is_planted = join.is_planted;
        }
    }
    return average(
        *content_, pose_of(before, phase, manner), pose_of(after, phase, manner), share, feet);
}

std::array<double, 2> FigureSequence::body_join(const Danced& before,
                                                const Danced& after) const noexcept {
    const double margin = margin_between(before, after);
    return after.changes_foot ? kWeightGoesBack : std::array<double, 2>{-margin, margin};
}

double FigureSequence::joined_until(const Danced& before, const Danced& after) const noexcept {
    const auto ends = [](const FootJoin& a, const FootJoin& b) { return a.to < b.to; };
    const FootJoin& last = *std::max_element(after.feet.begin(), after.feet.end(), ends);
    return std::max(body_join(before, after)[1], last.to);
}

// Samples the figure's contacts from the join's end on, as finely as the join.
std::optional<double> FigureSequence::standing_from(const Danced& danced,
                                                    Side side,
                                                    double margin) const noexcept {
    const double latest =
        std::min(kLatestSwing, end_of(danced) - danced.start - FigurePassage::kMargin);
    const double sample = 2.0 * margin / kFootSamples;
    for (double beat = margin; beat <= latest; beat += sample) {
        const Pose pose = pose_of(danced, danced.start + beat, {});
        if (pose.foot_contact[static_cast<std::size_t>(side)]) {
            return beat > margin ? std::optional(beat) : std::nullopt;
        }
    }
    return std::nullopt;
}

// Samples both figures over the join and notes for each foot how long it swings in each of them,
// and how far apart its places are while it rests in both.
std::array<FigureSequence::FootState, 2> FigureSequence::states_of_feet(
    const Danced& before, const Danced& after) const noexcept {
    const double margin = margin_between(before, after);
    std::array<FootState, 2> feet{};
    std::array<std::array<glm::vec3, 2>, 2> last{};  // by figure, foot
    for (int sample = 0; sample <= kFootSamples; ++sample) {
        const double beat = margin * (2.0 * sample / kFootSamples - 1.0);
        const std::array<WorldPose, 2> poses = {
            world_body(content_->skeleton, pose_of(before, after.start + beat, {})),
            world_body(content_->skeleton, pose_of(after, after.start + beat, {}))};
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            FootState& foot = feet[s];
            bool rests = sample > 0;
            for (std::size_t figure = 0; figure < poses.size(); ++figure) {
                const glm::vec3 place = foot_place(content_->skeleton, poses[figure], side).pivot;
                const bool is_still = glm::distance(place, last[figure][s]) < kStillMetres;
                last[figure][s] = place;
                rests = rests && is_still;
                if (sample == 0 || is_still) {
                    foot.since[figure] = beat;
                } else if (beat - foot.since[figure] > foot.swings[figure].lasts()) {
                    foot.swings[figure] = {foot.since[figure], beat};
                }
            }
            if (rests) {
                foot.apart = std::max(foot.apart, over_floor(last[0][s], last[1][s]));
            }
        }
    }
    return feet;
}

// Chooses how a foot joins, in the order given above at kSeenToSlide.
FigureSequence::FootJoin FigureSequence::foot_join(const Danced& before,
                                                   const Danced& after,
                                                   Side side,
                                                   const FootState& foot) const noexcept {
    const double margin = margin_between(before, after);
    const double least = kLeastSwing * content_->metre.learnt_tempo.beats_per_second();
    const std::optional<double> stands = standing_from(after, side, margin);
    const FootJoin& last = foot.swings[0];
    FootJoin join = foot.swings[1];
    if (join.lasts() >= least) {
        const Pose pose = pose_of(after, after.start + join.to, {});
        const WorldPose world = world_body(content_->skeleton, pose);
        // The swing seems to end just before the margin, but the figure plants the foot later: it
        // only creeps near the floor. It then moves until it is planted.
        if (stands && margin - join.to <= kCreeps &&
            foot_place(content_->skeleton, world, side).pivot.y < kCreepsUnder) {
            join.to = *stands;
            join.held = foot.since[0];
        } else if (last.lasts() > 0.0 && last.from > -margin && last.from < join.to &&
                   last.to > join.from) {
            // Both step at once: straight from where it stood before the last figure's swing.
            join.held = last.from;
        }
        return join;
    }
    // Both plant it at about the same place: it may move with the body.
    if (foot.apart <= kSeenToSlide) {
        return {};
    }
    if (last.lasts() >= least) {
        return last;
    }
    const double scale = margin / FigurePassage::kMargin;
    if (stands && *stands - foot.since[1] >= least) {
        const double from = std::max(scale * kStepNearest, *stands - scale * kLongestStep);
        return {from, *stands, true, foot.since[0]};
    }
    // One foot after the other, or both would be in the air.
    const double first = side == Side::left ? -kStepFarthest : kStepNearest;
    return {scale * first, scale * (first + kStepFarthest - kStepNearest), true};
}

// The foot that begins goes over with its own step. The other one, which has come to rest a beat
// before, stays: at its place where that is about the same in both figures, else until it steps.
FigureSequence::FootJoin FigureSequence::foot_join_to_other_foot(
    const Danced& after, Side side, const FootState& foot) const noexcept {
    const double least = kLeastSwing * content_->metre.learnt_tempo.beats_per_second();
    const FootJoin& own = foot.swings[1];
    if (side == leading_foot(after) && own.lasts() >= least) {
        return own;
    }
    FootJoin join{kBothStand[0], kBothStand[1]};
    const std::optional<double> stands = standing_from(after, side, FigurePassage::kMargin);
    if (foot.apart > kSeenToSlide && stands) {
        join = {std::max(kStepNearest, *stands - kLongestStep), *stands};
        join.is_lifted = own.lasts() <= 0.0;
        join.held = kBothStand[1];
        join.is_planted = true;
    }
    return join;
}

// Joins may outlast the margin, so the one before is asked first.
Pose FigureSequence::at(Beats phase, const Manner& manner) const noexcept RAKS_NONBLOCKING {
    const double at = phase.count();
    if (before_ && at < current_.start + joined_until(*before_, current_)) {
        return joined(*before_, current_, at, manner);
    }
    if (next_ && at > next_->start + joined_until(current_, *next_)) {
        return pose_of(*next_, at, manner);
    }
    if (next_ && at > next_->start + body_join(current_, *next_)[0]) {
        return joined(current_, *next_, at, manner);
    }
    return pose_of(current_, at, manner);
}

}  // namespace raks::motion
