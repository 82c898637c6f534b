#pragma once

#include <span>
#include <vector>

#include "audio/evaluate/beat_metrics.hpp"
#include "audio/evaluate/reliability.hpp"

/// What kind of mistake a tracker makes where its beats are wrong, and whether it knows.
/// Every function is pure. Threads: any. Real-time: no.
namespace raks::audio {

/// The places `offset`, `offset` + 1 / `rate`, ... counted in reference beats, as times: straight
/// lines between the beats. A rate of 2 doubles the tempo, an offset of 0.5 is the off-beat.
[[nodiscard]] std::vector<double> other_pulse(BeatTimes reference, double rate, double offset);

/// The pulse that an estimate follows in place of the beat, if it follows one. All false where the
/// beats are right (F-measure of 0.9 and more).
struct BeatFault {
    bool is_octave = false;     ///< double tempo, or half of it on odd or even beats
    bool is_three_two = false;  ///< three beats for two or two for three, from any third or half
    bool is_off_beat = false;   ///< the right tempo half a beat off
    bool is_third_off = false;  ///< the right tempo one or two thirds of a beat off
};
/// An estimate follows a pulse when its F-measure with it is 0.8 and more.
[[nodiscard]] BeatFault fault_of(BeatTimes reference, BeatTimes estimate);

/// Of each announced beat within the reference's time: whether a reference beat lies within
/// kHitTolerance, each counted for one claim only. `confidences`: one a beat.
[[nodiscard]] std::vector<Claim> beat_claims(BeatTimes reference,
                                             BeatTimes estimate,
                                             std::span<const float> confidences);

/// Of each announced beat that hits a reference beat: whether it has that beat's bar position.
/// Empty where bar positions are not known. `bar_confidences`: one a beat.
[[nodiscard]] std::vector<Claim> bar_claims(BeatTimes reference,
                                            std::span<const int> reference_positions,
                                            BeatTimes estimate,
                                            std::span<const int> positions,
                                            std::span<const float> bar_confidences);

}  // namespace raks::audio
