#include "motion/dance/dynamics/manner.hpp"

#include <algorithm>
#include <cmath>

#include "base/time.hpp"

namespace raks::motion {
namespace {

// Time constants of the two smoothings in a row; seconds.
constexpr double kGrows = 0.12;
constexpr double kShrinks = 0.22;
// The moment counts as much as the last seconds: accents show, and a calm part stays calm.
constexpr float kOfNow = 0.5F;

/// Sizes in the calmest music, as usual, and in the fullest.
struct Range {
    float calm;
    float usual;
    float full;

    [[nodiscard]] float at(float energy) const noexcept {
        // The energies of the calmest, of the usual and of more than the fullest music: a drop
        // still has something to add.
        constexpr float kCalm = 0.28F;
        constexpr float kUsualFrom = 0.50F;
        constexpr float kUsualTo = 0.90F;
        constexpr float kFull = 1.10F;
        const float up = std::clamp((energy - kUsualTo) / (kFull - kUsualTo), 0.0F, 1.0F);
        const float down = std::clamp((kUsualFrom - energy) / (kUsualFrom - kCalm), 0.0F, 1.0F);
        return usual + up * (full - usual) + down * (calm - usual);
    }
};

// Larger than full, and hands meet the head and feet leave the reach of the legs; smaller than
// calm, and nobody sees which figure it is.
constexpr Range kBody{0.50F, 1.0F, 1.25F};
constexpr Range kArms{0.55F, 1.0F, 1.25F};
constexpr Range kSteps{0.52F, 1.0F, 1.18F};
constexpr Range kSharpness{0.05F, 0.35F, 0.70F};
constexpr Range kBend{-0.004F, 0.0F, 0.04F};

// What everything coming in at once adds, and the music going on after a stop; it wears off.
constexpr float kDropLift = 1.0F;
constexpr float kEntryLift = 0.40F;
constexpr double kLiftSeconds = 16.0;

float approached(float from, float to, double seconds) noexcept {
    const double share = 1.0 - std::exp(-to_seconds(kHop) / seconds);
    return from + static_cast<float>(share) * (to - from);
}

}  // namespace

void MannerOfMusic::hear(const MusicEvent& event) noexcept RAKS_NONBLOCKING {
    if (event.kind == MusicEvent::Kind::drop) {
        lift_ = kDropLift;
    } else if (event.kind == MusicEvent::Kind::entry && has_played_) {
        lift_ = std::max(lift_, kEntryLift);
    }
    has_played_ = has_played_ || event.kind == MusicEvent::Kind::stop;
}

void MannerOfMusic::advance(const MusicState& music) noexcept RAKS_NONBLOCKING {
    lift_ = approached(lift_, 0.0F, kLiftSeconds);
    // Sound that is gone gives nothing, whatever came before it.
    const float lift = lift_ * std::min(1.0F, 2.0F * music.energy.now);
    // What comes in at once counts at once.
    const float lately = std::max(music.energy.now, music.energy.lately);
    const float asked = kOfNow * music.energy.now + (1.0F - kOfNow) * lately + lift;
    const float wanted = std::clamp(asked, 0.0F, 1.3F);
    energy_ = approached(energy_, wanted, wanted > energy_ ? kGrows : kShrinks);
    eased_ = approached(eased_, energy_, energy_ > eased_ ? kGrows : kShrinks);
}

void MannerOfMusic::swing(Side side, float metres) noexcept RAKS_NONBLOCKING {
    constexpr float kWay = 0.10F;  // metres in which 63 % of the difference are made up
    float& steps = steps_[static_cast<std::size_t>(side)];
    steps += (kSteps.at(eased_) - steps) * (1.0F - std::exp(-metres / kWay));
}

Manner MannerOfMusic::manner() const noexcept RAKS_NONBLOCKING {
    return {kBody.at(eased_), kArms.at(eased_), steps_, kSharpness.at(eased_), kBend.at(eased_)};
}

// The slope is 1 - sharpness on a beat and 1 + sharpness half way to the next.
double sharpened(double beat, float sharpness) noexcept RAKS_NONBLOCKING {
    constexpr double kTurn = 2.0 * M_PI;
    return beat - static_cast<double>(sharpness) / kTurn * std::sin(kTurn * beat);
}

}  // namespace raks::motion
