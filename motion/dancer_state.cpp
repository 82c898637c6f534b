#include "motion/dancer_state.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/collar_bones.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/dynamics/solo_arms.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Seconds, times 1 - 1 / pace: how much later the mean landing comes at another pace (`raks eval
// dance`, salsa, lead and follow, paces 0.70 to 1.41).
constexpr double kLandingLeadByPace = 0.06;
// Limit of the lead that a figure asks for
constexpr Nanos kMostLandingLead = std::chrono::milliseconds(60);
// Bars before and after the first count of a phrase in which the head turns to the audience
constexpr double kOpensBefore = 0.12;
constexpr double kOpens = 0.30;

/// How far ahead of the phase the pose is read, so that landings fall on the beat. `delay`: how
/// late the figure's steps come down at the learnt tempo. A landing is detected where a foot falls
/// under a fixed speed, whatever the tempo, so in a dance faster than learnt it is found later in
/// the last slowing of a step.
Nanos landing_lead(Nanos delay, double pace) noexcept {
    return std::clamp(delay, -kMostLandingLead, kMostLandingLead) +
           nanos_from_seconds(kLandingLeadByPace * (1.0 - 1.0 / std::clamp(pace, 0.6, 1.6)));
}

/// Move from a figure's start to where this dancer stands on the stage.
FloorMove stage_of(const DanceContent& content, const DancerPart& part) {
    FloorMove stage = part.is_in_couple ? content.couple : content.stage;
    stage.offset += part.place;
    return stage;
}

/// The metre of a dance; in a couple the mean period of both, so that both change octave at once.
DanceMetre metre_of(const DanceContent& content, const DanceLibrary* partner) {
    DanceMetre metre = content.metre;
    if (partner != nullptr) {
        const Bpm other = partner->content().metre.learnt_tempo;
        metre.learnt_tempo = Bpm::from_period(
            0.5 * (metre.learnt_tempo.seconds_per_beat() + other.seconds_per_beat()));
    }
    return metre;
}

}  // namespace

/// Changes to another dance. Wishes name figures of the old one by number, so they are dropped.
void Dancer::State::take_up(DanceId other) noexcept {
    find(other);
    wish = FigureWish();
}

void Dancer::State::find(DanceId other) noexcept {
    genre = other;
    dance = repertoire->of(other);
    stage = stage_of(content(), part);
    metre = metre_of(content(), part.partner ? part.partner->of(other) : nullptr);
}

/// The same figure at the same beat, as this repertoire has it. The difference between both bodies'
/// poses decays like that of any change.
void Dancer::State::go_on_from(const State& before) noexcept {
    static_cast<Course&>(*this) = static_cast<const Course&>(before);
    if (repertoire->of(before.genre) == nullptr) {
        // A dance that is not solved yet: from standing, where the other one was.
        take_up(repertoire->first());
        is_dancing = false;
        still.end();
        standing.stand(place());
        idle.begin(time_of_hop(last_hop), content().chooser.habits(), part.ways);
    } else {
        find(before.genre);
        sequence.go_on_in(content(), stage);
    }
    if (last_hop >= 0) {
        changed_at = time_of_hop(last_hop);
        if (is_dancing && !is_free()) {
            feet.carry_over(skeleton,
                            shown,
                            shown_before,
                            danced(changed_at, Nanos(0)),
                            danced(changed_at, -kHop));
        }
        smoothing.start(
            shown, shown_before, target(changed_at, Nanos(0)), target(changed_at, -kHop));
    }
}

/// Where the dancer stands while nothing is danced: a soloist always at the same place, facing the
/// audience; one of a couple where the dance has ended.
FloorMove Dancer::State::place() const noexcept {
    return floor_of(content(), stage, stands_turned) * inverse(content().stage);
}

void Dancer::State::reset() noexcept RAKS_NONBLOCKING {
    static_cast<Course&>(*this) = Course();
    take_up(repertoire->first());
    standing.stand(place());
    idle.begin(StreamTime{}, content().chooser.habits(), part.ways);
    bars_to_wait = part.bars_late;
    shown = shown_before = waiting(StreamTime{}, Nanos(0), looks);
}

/// Whether nothing but the figures is to be seen: with the paper's generator.
bool Dancer::State::is_free() const noexcept { return content().generator == Generator::frames; }

/// Whether the dance follows more of the music than its beats.
bool Dancer::State::has_dynamics() const noexcept {
    return part.dynamics == Dynamics::on && !is_free();
}

Beats Dancer::State::shown_phase(StreamTime now, Nanos ahead) const noexcept {
    return still.is_on() ? still.phase(now + ahead)
                         : phase.phase_after(ahead + landing_lead(delay, pace));
}

/// The pose of the figures at a phase; who dances a couples' dance alone has arms of its own.
Pose Dancer::State::danced_at(Beats shown_at) const noexcept {
    const Manner own = has_dynamics() ? manner.manner() : Manner();
    Pose pose = sequence.at(shown_at, own);
    if (!part.is_in_couple && !is_free()) {
        dance_solo_arms(content().solo, {shown_at.count(), part.ways, own.arms}, skeleton, pose);
    }
    return pose;
}

/// The same, `ahead` of the hop at `now`.
Pose Dancer::State::danced(StreamTime now, Nanos ahead) const noexcept {
    if (still.posture() && still.is_at_rest(now + ahead)) {
        return *still.posture();
    }
    return danced_at(shown_phase(now, ahead));
}

/// The pose of one who does not dance.
Pose Dancer::State::waiting(StreamTime now, Nanos ahead, const Looks& own) const noexcept {
    const StreamTime time = now + ahead;
    Pose pose = standing.at(skeleton, time);
    if (!has_dynamics()) {
        return pose;
    }
    // A movement turns the head away from what is looked at.
    own.apply(skeleton, pose);
    idle.move(skeleton, time, {felt, grid.beats_at(time).count()}, pose);
    hands.apply(skeleton, time, hands_beat(now, ahead), pose);
    fingers.apply(time, hands_beat(now, ahead), pose);
    idle.shake(time, pose);
    return pose;
}

/// What the dancer does beside the figures.
Pose Dancer::State::layered(StreamTime now,
                            Nanos ahead,
                            const Looks& own,
                            Pose pose) const noexcept {
    if (has_dynamics()) {
        breath.apply(now + ahead, pose);
    }
    hits.apply(now + ahead, pose);
    limit_collar_bones(skeleton, pose);
    const double beat = hands_beat(now, ahead);
    hands.apply(skeleton, now + ahead, beat, pose);
    fingers.apply(now + ahead, beat, pose);
    // One of a couple looks at the other.
    if (has_dynamics() && !part.is_in_couple) {
        own.apply(skeleton, pose);
    } else if (has_dynamics()) {
        own.lift_head(skeleton, pose);
    }
    return pose;
}

/// The pose before inertialization, its feet as far from their places as at the last hop.
Pose Dancer::State::target(StreamTime now, Nanos ahead) const noexcept {
    if (!is_dancing) {
        return waiting(now, ahead, looks);
    }
    const Pose pose = danced(now, ahead);
    return is_free() ? pose : layered(now, ahead, looks, feet.with_lag(skeleton, pose));
}

/// The same for the hop after the last that `own` has seen.
Pose Dancer::State::next(StreamTime now,
                         Nanos ahead,
                         PlantedFeet& own,
                         const Looks& looking) const noexcept {
    if (!is_dancing) {
        return waiting(now, ahead, looking);
    }
    if (is_free()) {
        return target(now, ahead);
    }
    const auto steps =
        still.is_on() ? PlantedFeet::OwnSteps::wait : PlantedFeet::OwnSteps::may_begin;
    return layered(now, ahead, looking, own.apply(skeleton, danced(now, ahead), steps));
}

/// Where the head turns to, one hop on.
void Dancer::State::look_on(StreamTime now) noexcept {
    if (has_dynamics()) {
        const bool opens = phrases.bar() < kOpens || phrases.bar() > Phrases::kBars - kOpensBefore;
        const LookFor what = !is_dancing              ? LookFor::wait
                             : still.is_on() || opens ? LookFor::pose
                                                      : LookFor::dance;
        looks.advance(skeleton, now, part.ways, what, shown);
    }
}

/// What the face shows, and how deep a breath is.
void Dancer::State::feel(const MusicState& music) noexcept {
    const float stands = skeleton.offsets[index_of(Bone::hips)].y;
    feelings.advance({.music = music,
                      .mood = repertoire->mood_of(genre),
                      .seed = part.ways,
                      .is_dancing = is_dancing,
                      .is_in_couple = part.is_in_couple,
                      .bar = phrases.bar(),
                      .energy = manner.energy(),
                      .height = stands > 0.0F ? shown.hips_position.y / stands : 1.0F,
                      .is_in_air = !shown.foot_contact[0] && !shown.foot_contact[1]});
    breath.advance(manner.energy(), still.is_at_rest(music.time));
}

// The pose with what is left of the last change. Joint rotations and hips decay independently of
// one another, so the feet are put once more where the pose has them.
Pose Dancer::State::smoothed(StreamTime now, Nanos ahead, Pose pose) const noexcept {
    const Nanos since = now + ahead - changed_at;
    const bool is_left = smoothing.is_active(since);
    const Pose wanted = pose;
    if (is_left) {
        pose = smoothing.apply(wanted, since);
    }
    if (!is_dancing && is_left) {
        standing.plant(skeleton, now + ahead, pose);
    } else if (is_dancing && !is_free()) {
        if (is_left) {
            put_feet_as(skeleton, wanted, pose);
        }
        clear_hands(skeleton, pose);
    }
    return pose;
}

/// Steps change their length with the music, each while its foot is in the air. Those of a couple
/// stay as they are: both have to come out at the same places.
void Dancer::State::note_swings() noexcept {
    if (part.is_in_couple || (shown.foot_contact[0] && shown.foot_contact[1])) {
        return;
    }
    const WorldPose now = world_body(skeleton, shown);
    const WorldPose before = world_body(skeleton, shown_before);
    for (const Side side : kSides) {
        if (!shown.foot_contact[static_cast<std::size_t>(side)]) {
            const Bone foot = on_side(Bone::left_foot, side);
            manner.swing(side, glm::distance(now.position(foot), before.position(foot)));
        }
    }
}

/// The motion changes at this hop. The difference between what was shown and the new target is
/// measured one and two hops ago, where both are known, and decays from there.
void Dancer::State::change(StreamTime now) noexcept {
    changed_at = now - kHop;
    if (is_dancing && !is_free()) {
        feet.carry_over(skeleton, shown, shown_before, danced(now, -kHop), danced(now, -2 * kHop));
    }
    smoothing.start(shown, shown_before, target(now, -kHop), target(now, -2 * kHop));
}

}  // namespace raks::motion
