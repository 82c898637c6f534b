#include "audio/beat/bar_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr float kForget = 0.93F;    // a beat: about four bars of memory
constexpr int kBeatsToChange = 8;   // a rotation must win for two bars
constexpr double kNearSlot = 0.13;  // beats around a slot that count for it

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

/// Correlation of profile and pattern, the profile turned by whole beats; each band is taken about
/// its own mean so that a loud band does not decide alone.
float match(const BarTracker::Profile& profile, const BarTracker::Profile& pattern, int turn) {
    float product = 0.0F;
    float profile_square = 1e-6F;
    float pattern_square = 1e-6F;
    for (std::size_t band = 0; band < profile[0].size(); ++band) {
        float profile_mean = 0.0F;
        float pattern_mean = 0.0F;
        for (std::size_t slot = 0; slot < profile.size(); ++slot) {
            profile_mean += profile[slot][band] / static_cast<float>(profile.size());
            pattern_mean += pattern[slot][band] / static_cast<float>(pattern.size());
        }
        for (std::size_t slot = 0; slot < profile.size(); ++slot) {
            const std::size_t at = (slot + 2 * static_cast<std::size_t>(turn)) % profile.size();
            const float a = profile[at][band] - profile_mean;
            const float b = pattern[slot][band] - pattern_mean;
            product += a * b;
            profile_square += a * a;
            pattern_square += b * b;
        }
    }
    return product / std::sqrt(profile_square * pattern_square);
}

}  // namespace

void BarTracker::reset() noexcept RAKS_NONBLOCKING { *this = BarTracker(); }

void BarTracker::hold(long beat_number) noexcept RAKS_NONBLOCKING {
    origin_ = static_cast<int>(((beat_number % kBeatsPerBar) + kBeatsPerBar) % kBeatsPerBar);
    confidence_ = 1.0F;
    is_held_ = true;
}

void BarTracker::add(const Onset& onset, double beat_position) noexcept RAKS_NONBLOCKING {
    const double half = 2.0 * beat_position;
    const double nearest = std::round(half);
    if (std::abs(half - nearest) < 2.0 * kNearSlot) {
        const long slot = std::lround(nearest);
        auto& bands = profile_[static_cast<std::size_t>(((slot % kSlots) + kSlots) % kSlots)];
        for (std::size_t band = 0; band < bands.size(); ++band) {
            bands[band] += std::max(0.0F, onset.normalized[band]);
        }
    }
    const long beat = std::lround(std::floor(beat_position));
    if (beat == last_beat_) {
        return;
    }
    last_beat_ = beat;
    for (auto& bands : profile_) {
        for (float& value : bands) {
            value *= kForget;
        }
    }
    decide();
}

void BarTracker::decide() noexcept {
    if (is_held_) {
        return;
    }
    std::array<float, kBeatsPerBar> scores{};
    for (std::size_t turn = 0; turn < scores.size(); ++turn) {
        scores[turn] = -1.0F;
        for (const Profile& pattern : kPatterns) {
            scores[turn] = std::max(scores[turn], match(profile_, pattern, static_cast<int>(turn)));
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
