#pragma once

#include <chrono>

#include "base/time.hpp"

/// What counts as a beat: the same for the tracker that runs along and for the search over a whole
/// song.
namespace raks::audio {

/// The onset strength is greatest in the window whose middle lies this much after the onset;
/// measured on clicks.
inline constexpr double kOnsetLagHops = -0.05;
/// Evidence on beats: at the first value as much as noise has, at the second certain; of the mean
/// onset strength around the beat.
inline constexpr float kLeastStrength = 0.15F;
inline constexpr float kFullStrength = 0.9F;  ///< see kLeastStrength
/// The same of a network's greatest probability around the beat.
inline constexpr float kLeastEvidence = 0.08F;
inline constexpr float kFullEvidence = 0.35F;  ///< see kLeastEvidence
/// Below this confidence no beat is announced.
inline constexpr float kAnnounceConfidence = 0.02F;
/// Least distance of two announced beats, as a share of the beat.
inline constexpr double kLeastGap = 0.45;
/// In the first hops of a sound the grid is set to the estimate at once.
inline constexpr int kFirstHops = 150;
/// How long before it sounds a beat is predicted.
inline constexpr Nanos kPredictedLead = std::chrono::milliseconds(100);

}  // namespace raks::audio
