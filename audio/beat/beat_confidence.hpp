#pragma once

#include "audio/beat/network/confidence_model.hpp"
#include "audio/beat/rival_pulses.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

static_assert(kConfidenceFeatures == 1 + kRivalKinds + 5);

/// The features of a beat of `bpm`: 1; tanh of the margins over the best rival of each kind and
/// over no beat at all; the evidence on the beats; the tempo in octaves from 120 BPM, and their
/// square; `right` from -1 to 1. Rivals outside the tracked tempi are none. `right`: probability
/// that the network for the metre gives the beat's pulse, 0.5 where nothing is known. `on_beats`:
/// [0, 1], 1 where the evidence of beats is full. Real-time: yes.
[[nodiscard]] ConfidenceFeatures confidence_features(const PulseMargins& margins,
                                                     float right,
                                                     double bpm,
                                                     float on_beats) noexcept RAKS_NONBLOCKING;

/// What the margins say of the beat.
struct BeatVerdict {
    float confidence = 0.0F;  ///< probability that it is the beat, [0, 1]
    double rival_rate = 1.0;  ///< beats of the likeliest rival to one of ours
    float rival = 0.0F;       ///< its probability, [0, 1]
};

/// How sure the beat is, and what it may be instead. Arguments as of confidence_features().
/// Real-time: yes.
[[nodiscard]] BeatVerdict judge_beat(const ConfidenceModel& model,
                                     const PulseMargins& margins,
                                     float right,
                                     double bpm,
                                     float on_beats) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
