#include "audio/beat/bar_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace raks::audio {
namespace {

constexpr float kForget = 0.93F;    // a beat: about four bars of memory
constexpr int kBeatsToChange = 8;   // a rotation must win for two bars
constexpr double kNearSlot = 0.13;  // beats around a slot that count for it

// Share of each band in a match: the bass says most about the bar.
constexpr std::array<float, kOnsetBands> kBandTrust = {0.45F, 0.35F, 0.2F};

// When the grid itself is doubted; shares of the onsets of drums and bass on the stronger beats.
constexpr int kBeatsToTrust = 12;
constexpr int kBeatsToAct = 4;
constexpr int kBeatsToShift = 20;
constexpr double kFastBpm = 112.0;
constexpr double kSlowBpm = 102.0;
constexpr float kEmptyShare = 0.30F;
constexpr float kWeakShare = 0.55F;
constexpr float kFullShare = 0.85F;
// At the tempi of salsa the high sounds (bell, guiro, shaker) mark the beats.
constexpr double kBellBpm = 150.0;
constexpr float kBellShare = 1.18F;
constexpr float kTumbaoShare = 1.4F;
constexpr float kBetweenShare = 0.7F;
constexpr float kClearlyBetter = 0.20F;  // of a correlation

/// Onsets expected in half beats 1, 1+, 2, 2+, 3, 3+, 4, 4+ of the bar: low, middle, high band.
constexpr std::array<BarTracker::Profile, 3> kPatterns = {{
    // Rock, pop, house: bass drum on 1 and 3 (1 stronger), snare on 2 and 4.
    {{{1.0F, 0.3F, 0.2F},
      {0, 0, 0},
      {0.1F, 1.0F, 0.3F},
      {0, 0, 0},
      {0.7F, 0.2F, 0.2F},
      {0.2F, 0, 0},
      {0.1F, 1.0F, 0.3F},
      {0, 0, 0}}},
    // Salsa: tumbao bass on 2+ and 4, open congas on 4 and 4+, bell on the odd beats.
    {{{0.0F, 0.2F, 0.6F},
      {0, 0, 0},
      {0.0F, 0.5F, 0.1F},
      {1.0F, 0.2F, 0},
      {0.1F, 0.2F, 0.6F},
      {0, 0, 0},
      {1.0F, 0.6F, 0.1F},
      {0.2F, 0.6F, 0}}},
    // Maqsum: D T - T D - T -.
    {{{1.0F, 0.3F, 0.1F},
      {0, 0.5F, 0.6F},
      {0, 0, 0},
      {0, 0.6F, 0.6F},
      {0.8F, 0.3F, 0.1F},
      {0, 0, 0},
      {0, 0.6F, 0.6F},
      {0, 0, 0}}},
}};

/// Correlation of profile and pattern, the profile turned by half beats; each band is taken about
/// its own mean and spread so that a loud band does not decide alone.
float match(const BarTracker::Profile& profile, const BarTracker::Profile& pattern, int turn) {
    float sum = 0.0F;
    for (std::size_t band = 0; band < profile[0].size(); ++band) {
        float profile_mean = 0.0F;
        float pattern_mean = 0.0F;
        for (std::size_t slot = 0; slot < profile.size(); ++slot) {
            profile_mean += profile[slot][band] / static_cast<float>(profile.size());
            pattern_mean += pattern[slot][band] / static_cast<float>(pattern.size());
        }
        float product = 0.0F;
        float profile_square = 1e-9F;
        float pattern_square = 1e-9F;
        for (std::size_t slot = 0; slot < profile.size(); ++slot) {
            const std::size_t at = (slot + static_cast<std::size_t>(turn)) % profile.size();
            const float a = profile[at][band] - profile_mean;
            const float b = pattern[slot][band] - pattern_mean;
            product += a * b;
            profile_square += a * a;
            pattern_square += b * b;
        }
        sum += kBandTrust[band] * product / std::sqrt(profile_square * pattern_square);
    }
    return sum;
}

}  // namespace

void BarTracker::reset() noexcept RAKS_NONBLOCKING { *this = BarTracker(); }

void BarTracker::hold(long beat_number) noexcept RAKS_NONBLOCKING {
    origin_ = static_cast<int>(((beat_number % kBeatsPerBar) + kBeatsPerBar) % kBeatsPerBar);
    confidence_ = 1.0F;
    is_held_ = true;
}

GridAdvice BarTracker::add(const Onset& onset,
                           double beat_position,
                           double bpm) noexcept RAKS_NONBLOCKING {
    const double half = 2.0 * beat_position;
    const double nearest = std::round(half);
    if (std::abs(half - nearest) < 2.0 * kNearSlot) {
        const long slot = std::lround(nearest);
        auto& bands = profile_[static_cast<std::size_t>(((slot % kSlots) + kSlots) % kSlots)];
        for (std::size_t band = 0; band < bands.size(); ++band) {
            bands[band] += onset.flux[band];
        }
    }
    const long beat = std::lround(std::floor(beat_position));
    if (beat == last_beat_) {
        return GridAdvice::keep;
    }
    last_beat_ = beat;
    for (auto& bands : profile_) {
        for (float& value : bands) {
            value *= kForget;
        }
    }
    ++beats_folded_;
    if (!is_held_) {
        decide();
    }
    return advise(bpm);
}

void BarTracker::forget_profile() noexcept {
    profile_ = {};
    beats_folded_ = 0;
    pending_ = GridAdvice::keep;
    pending_beats_ = 0;
    candidate_beats_ = 0;
}

GridAdvice BarTracker::octave_advice(double bpm) const noexcept {
    // Drums and bass decide the octave; hats and bells play eighths in every music.
    std::array<float, kSlots> energy{};
    for (std::size_t slot = 0; slot < energy.size(); ++slot) {
        energy[slot] = profile_[slot][0] + profile_[slot][1];
    }
    const float even = energy[0] + energy[4];
    const float odd = energy[2] + energy[6];
    const float between = 0.5F * (energy[1] + energy[3] + energy[5] + energy[7]);
    const float strong = std::max(even, odd);
    if (bpm > kFastBpm && between < kEmptyShare * strong &&
        std::min(even, odd) < kWeakShare * strong) {
        return even >= odd ? GridAdvice::halve : GridAdvice::halve_other;
    }
    if (bpm < kSlowBpm && between > kFullShare * strong) {
        return GridAdvice::double_up;
    }
    return GridAdvice::keep;
}

/// Half beats that are nearly empty cannot be the beats.
bool BarTracker::has_onsets_between() const noexcept {
    float on = 0.0F;
    float between = 0.0F;
    for (std::size_t slot = 0; slot < profile_.size(); ++slot) {
        const auto& bands = profile_[slot];
        (slot % 2 == 0 ? on : between) += bands[0] + bands[1] + bands[2];
    }
    return between > kBetweenShare * on;
}

/// A salsa heard half a beat off: the bell between our beats, and one bass note a bar (the tumbao's
/// 2+ or 4) far stronger than the others. A bass drum on every beat is no tumbao.
bool BarTracker::has_bell_between() const noexcept {
    float on = 0.0F;
    float between = 0.0F;
    std::array<float, kBeatsPerBar> bass{};
    for (std::size_t slot = 0; slot < profile_.size(); ++slot) {
        (slot % 2 == 0 ? on : between) += profile_[slot][2];
        if (slot % 2 == 0) {
            bass[slot / 2] = profile_[slot][0];
        }
    }
    std::sort(bass.begin(), bass.end(), std::greater<>());
    return between > kBellShare * on && bass[0] > kTumbaoShare * bass[1];
}

GridAdvice BarTracker::advise(double bpm) noexcept {
    if (beats_folded_ < kBeatsToTrust) {
        return GridAdvice::keep;
    }
    float on = -1.0F;
    float off = -1.0F;
    for (int turn = 0; turn < kSlots; ++turn) {
        for (const Profile& pattern : kPatterns) {
            float& best = turn % 2 == 0 ? on : off;
            best = std::max(best, match(profile_, pattern, turn));
        }
    }
    GridAdvice advice = octave_advice(bpm);
    // At a salsa's tempi the bell decides alone: tumbao and montuno fit several rotations.
    const bool is_off = bpm > kBellBpm ? has_bell_between() : off - on > kClearlyBetter;
    if (advice == GridAdvice::keep && is_off && beats_folded_ > kBeatsToShift &&
        has_onsets_between()) {
        advice = GridAdvice::shift_half;
    }
    pending_beats_ = advice == pending_ ? pending_beats_ + 1 : 0;
    pending_ = advice;
    if (advice == GridAdvice::keep || pending_beats_ < kBeatsToAct) {
        return GridAdvice::keep;
    }
    forget_profile();
    return advice;
}

void BarTracker::decide() noexcept {
    std::array<float, kBeatsPerBar> scores{};
    for (std::size_t turn = 0; turn < scores.size(); ++turn) {
        scores[turn] = -1.0F;
        for (const Profile& pattern : kPatterns) {
            scores[turn] =
                std::max(scores[turn], match(profile_, pattern, 2 * static_cast<int>(turn)));
        }
    }
    const int best =
        static_cast<int>(std::max_element(scores.begin(), scores.end()) - scores.begin());
    candidate_beats_ = best == candidate_ ? candidate_beats_ + 1 : 0;
    candidate_ = best;
    if (candidate_beats_ >= kBeatsToChange) {
        origin_ = best;
    }
    float runner_up = -1.0F;
    for (std::size_t turn = 0; turn < scores.size(); ++turn) {
        if (static_cast<int>(turn) != origin_) {
            runner_up = std::max(runner_up, scores[turn]);
        }
    }
    const float margin = scores[static_cast<std::size_t>(origin_)] - runner_up;
    confidence_ = std::clamp(2.0F * margin, 0.0F, 1.0F);
}

}  // namespace raks::audio
