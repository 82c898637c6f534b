#include "motion/dance/dynamics/feelings.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "base/time.hpp"
#include "motion/dance/dynamics/phrases.hpp"

namespace raks::motion {
namespace {

// Streams of random numbers.
constexpr std::uint64_t kEmotionStream = 21;
constexpr std::uint64_t kTeethStream = 22;
constexpr std::uint64_t kAwayStream = 23;

constexpr float kEase = 0.11F;          // seconds; of each stage of the filter
constexpr float kEyesSeconds = 0.035F;  // seconds; eyes are quicker than faces

// An emotion passes this long after the last one: at an accent or a bar line between the two.
constexpr double kShortestGap = 1.5;  // seconds
constexpr double kLongestGap = 2.8;
constexpr double kGapOfWaiting = 4.0;
constexpr double kShortestPass = 1.3;
constexpr double kLongestPass = 2.6;
constexpr float kSmallestPass = 0.50F;  // how much of it there is
constexpr float kLargestPass = 0.85F;
constexpr float kOfWaiting = 0.70F;     // of that, while the dancer waits
constexpr float kAccentToPass = 0.55F;  // strength from which an accent brings an emotion
constexpr double kRecalled = 0.6;       // growth of an emotion's chance with each draw without it

// What happens in the music: seconds for which it is seen, and how much.
constexpr double kSurprised = 1.1;
constexpr float kSurprise = 0.80F;
constexpr double kCalmAfterStop = 3.0;
constexpr double kRelieved = 1.8;
constexpr double kJoyOfDrop = 2.6;
constexpr double kJoyAtEnd = 5.0;

constexpr float kJoy = 0.35F;      // of full energy
constexpr float kJoyFrom = 0.55F;  // energy
constexpr float kJoyTo = 1.10F;
constexpr float kBaseLeft = 0.20F;     // of the base under something that is whole
constexpr float kTeethAccent = 0.65F;  // strength
constexpr double kTeethApart = 1.3;    // seconds
constexpr double kTeethShow = 0.45;

// Of a body that works: the height of the hips against standing at which it begins and is whole.
constexpr float kDeepFrom = 0.88F;
constexpr float kDeepTo = 0.76F;
constexpr int kJump = 9;              // hops without a foot on the floor
constexpr float kStrainFades = 0.5F;  // seconds
constexpr float kStrainUsual = 6.0F;
constexpr float kStrainShown = 0.55F;

// In the first count and a half of a phrase one looks at who watches.
constexpr double kOpensBefore = 0.06;  // bars
constexpr double kOpens = 0.35;
constexpr double kAwaySeconds = 2.4;  // of one look

float share(float seconds) noexcept {
    return 1.0F - std::exp(-static_cast<float>(to_seconds(kHop)) / seconds);
}

Feeling eased(const Feeling& from, const Feeling& to) noexcept {
    Feeling next = interpolate(from, to, share(kEase));
    next.audience = from.audience + share(kEyesSeconds) * (to.audience - from.audience);
    return next;
}

bool is_within(double now, double since, double seconds) noexcept {
    return now >= since && now < since + seconds;
}

}  // namespace

/// What happens in the music.
void Feelings::hear(const FeelingMoment& moment, double now) noexcept {
    using Kind = MusicEvent::Kind;
    const MusicState& music = moment.music;
    has_danced_ = has_danced_ || moment.is_dancing;
    switch (music.event.kind) {
        case Kind::stop:
            stopped_ = has_danced_ ? now : kNever;
            is_stopped_ = has_danced_;
            break;
        case Kind::entry:
            went_on_ = is_stopped_ ? now : kNever;
            is_stopped_ = false;
            break;
        case Kind::drop:
            dropped_ = now;
            is_stopped_ = false;
            break;
        case Kind::end:
            ended_ = has_danced_ ? now : kNever;
            break;
        default:
            break;
    }
    if (music.accent.strength >= kTeethAccent && moment.is_dancing) {
        const double drawn = CounterRandom(moment.seed, kTeethStream).uniform(++accents_);
        if (drawn < static_cast<double>(moment.mood.teeth) && now - showed_teeth_ > kTeethApart) {
            showed_teeth_ = now;
        }
    }
}

/// What the body does. Who dances deep all the time does not strain all the time.
void Feelings::strain(const FeelingMoment& moment) noexcept {
    hops_in_air_ = moment.is_in_air ? hops_in_air_ + 1 : 0;
    const float deep = moment.is_dancing ? smoothstep(kDeepTo, kDeepFrom, moment.height) : 1.0F;
    const float asked = std::max(1.0F - deep, hops_in_air_ >= kJump ? 0.8F : 0.0F);
    usual_strain_ += share(kStrainUsual) * (asked - usual_strain_);
    const float shown = std::max(0.0F, asked - 0.8F * usual_strain_);
    strain_ = std::max(shown, strain_ * (1.0F - share(kStrainFades)));
}

/// Which emotion passes next: never the base mood, nor the same twice running, and those sooner
/// that were not seen for long. Calm music brings the quiet ones, full music the bright ones.
Emotion Feelings::draw(const FeelingMoment& moment) noexcept {
    const float lively = std::clamp(moment.energy, 0.0F, 1.0F);
    std::array<double, kEmotionCount> chances{};
    double sum = 0.0;
    for (std::size_t i = 0; i < kEmotionCount; ++i) {
        const auto emotion = static_cast<Emotion>(i);
        const bool is_quiet = emotion == Emotion::sad || emotion == Emotion::relaxed;
        const bool is_bright = emotion == Emotion::happy || emotion == Emotion::angry;
        const float suits = is_quiet ? 1.4F - lively : is_bright ? 0.4F + lively : 1.0F;
        const auto missed = static_cast<double>(draws_ - drawn_[i]);
        const bool is_on = emotion == moment.mood.base || (draws_ > 0 && emotion == passing_);
        chances[i] = is_on ? 0.0
                           : static_cast<double>(moment.mood.passing[i] * suits) *
                                 (1.0 + kRecalled * missed);
        sum += chances[i];
    }
    double left = sum * CounterRandom(moment.seed, kEmotionStream).uniform(4 * draws_);
    for (std::size_t i = 0; i < kEmotionCount; ++i) {
        left -= chances[i];
        if (left < 0.0) {
            return static_cast<Emotion>(i);
        }
    }
    return moment.mood.base;  // no other is wanted
}

void Feelings::pass(const FeelingMoment& moment, double now) noexcept {
    const MusicState& music = moment.music;
    const double place = music.grid.bar_position(music.grid.beats_at(music.time));
    const bool is_late = place > 0.5 * music.grid.beats_per_bar;
    const bool is_at_line = was_late_in_bar_ && !is_late;
    was_late_in_bar_ = is_late;
    const double gap = now - passes_until_;
    const bool is_called = is_at_line || music.accent.strength >= kAccentToPass;
    const bool is_due = moment.is_dancing ? gap >= kLongestGap || (gap >= kShortestGap && is_called)
                                          : gap >= kGapOfWaiting;
    // What happens in the music comes first.
    const bool is_other = is_within(now, stopped_, kSurprised) ||
                          is_within(now, went_on_, kRelieved) ||
                          is_within(now, dropped_, kJoyOfDrop);
    if (!is_due || is_other) {
        return;
    }
    const Emotion drawn = draw(moment);
    const CounterRandom random(moment.seed, kEmotionStream);
    const auto uniform = [&](std::uint64_t i) { return random.uniform(4 * draws_ + i); };
    passing_ = drawn;
    passing_size_ = kSmallestPass + (kLargestPass - kSmallestPass) *
                                        static_cast<float>(uniform(1)) *
                                        std::clamp(0.4F + moment.energy, 0.0F, 1.0F);
    passing_size_ *= moment.is_dancing ? 1.0F : kOfWaiting;
    passes_until_ = now + kShortestPass + (kLongestPass - kShortestPass) * uniform(2);
    // One number says whether a brow is raised, which, and how far.
    const double brow = uniform(3);
    const auto often = static_cast<double>(moment.mood.brows);
    const bool is_raised = brow < often;
    const double half = is_raised ? 2.0 * brow / often - 1.0 : 0.0;
    passing_brows_ =
        is_raised ? static_cast<float>(half < 0.0 ? half - 1.0 : half + 1.0) / 2.0F : 0.0F;
    ++draws_;
    drawn_[static_cast<std::size_t>(drawn)] = draws_;
}

/// What the music brings to the face; returns how much of the face it takes, [0, 1].
float Feelings::cause(double now, Feeling& target) const noexcept {
    if (is_within(now, stopped_, kSurprised)) {
        target.of(Emotion::surprised) = kSurprise;
        return 1.0F;
    }
    if (is_stopped_ && is_within(now, stopped_, kSurprised + kCalmAfterStop)) {
        target.of(Emotion::relaxed) = 0.5F;
        return 1.0F;
    }
    if (is_within(now, dropped_, kJoyOfDrop)) {
        // Joy with wide eyes.
        target.of(Emotion::happy) = 0.8F;
        target.of(Emotion::surprised) = 0.5F;
        target.teeth = 0.5F;
        return 1.0F;
    }
    if (is_within(now, went_on_, kRelieved)) {
        target.of(Emotion::happy) = 0.5F;
        target.of(Emotion::relaxed) = 0.4F;
        return 1.0F;
    }
    if (is_within(now, ended_, kJoyAtEnd)) {
        target.of(Emotion::happy) = 0.6F;
        target.of(Emotion::relaxed) = 0.5F;
        return 1.0F;
    }
    if (now < passes_until_) {
        target.of(passing_) = passing_size_;
        target.brows = passing_brows_;
        return passing_size_ / kLargestPass;
    }
    return 0.0F;
}

Feeling Feelings::target(const FeelingMoment& moment, double now) const noexcept {
    const DanceMood& mood = moment.mood;
    Feeling target;
    float taken = cause(now, target);
    if (strain_ > 0.0F) {
        for (float& emotion : target.emotions) {
            emotion *= 1.0F - 0.6F * strain_;
        }
        target.of(Emotion::angry) += kStrainShown * strain_;
        target.teeth = std::max(target.teeth, 0.6F * strain_);
        taken = std::max(taken, strain_);
    }
    const float left = 1.0F - (1.0F - kBaseLeft) * taken;
    target.of(mood.base) += left * mood.strength;
    if (moment.is_dancing) {
        target.of(Emotion::happy) += left * kJoy * smoothstep(kJoyFrom, kJoyTo, moment.energy);
    }
    if (is_within(now, showed_teeth_, kTeethShow)) {
        target.teeth = std::max(target.teeth, 0.8F);
        target.of(Emotion::happy) += 0.25F;
    }
    float sum = 0.0F;
    for (const float emotion : target.emotions) {
        sum += emotion;
    }
    for (float& emotion : target.emotions) {
        emotion /= std::max(sum, 1.0F);
    }
    const bool opens = moment.bar < kOpens || moment.bar > Phrases::kBars - kOpensBefore;
    const auto look = static_cast<std::uint64_t>(std::max(now, 0.0) / kAwaySeconds);
    const bool is_past =
        CounterRandom(moment.seed, kAwayStream).uniform(look) < static_cast<double>(mood.away);
    const bool is_at_partner = moment.is_in_couple && moment.is_dancing;
    target.audience = opens || !(is_at_partner || is_past) ? 1.0F : 0.0F;
    return target;
}

void Feelings::advance(const FeelingMoment& moment) noexcept RAKS_NONBLOCKING {
    const double now = to_seconds(moment.music.time.time_since_epoch());
    hear(moment, now);
    strain(moment);
    pass(moment, now);
    eased_[0] = eased(eased_[0], target(moment, now));
    eased_[1] = eased(eased_[1], eased_[0]);
}

}  // namespace raks::motion
