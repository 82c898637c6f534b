#pragma once

#include <cstdint>
#include <vector>

namespace raks::audio::test {

/// Sounds without a beat, mono at 48 kHz. The same seed gives the same samples.
inline constexpr int kBeatlessRate = 48'000;

/// Noise of an rms level, white or of 3 dB less an octave.
std::vector<float> white_noise(double seconds, double level, std::uint64_t seed);
std::vector<float> pink_noise(double seconds, double level, std::uint64_t seed);

/// Clicks at any time, so many a second on average (a Poisson process).
std::vector<float> irregular_clicks(double seconds, double a_second, std::uint64_t seed);

/// Clapping of many hands: each clap a burst of noise of some milliseconds, at any time.
std::vector<float> applause(double seconds, std::uint64_t seed);

/// Talking: syllables of 80 to 300 ms, buzzing at a wandering pitch or hissing, with pauses.
std::vector<float> speech(double seconds, std::uint64_t seed);

}  // namespace raks::audio::test
