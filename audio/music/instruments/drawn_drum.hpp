#pragma once

#include <array>
#include <vector>

#include "base/dice.hpp"

namespace raks::audio {

/// A drum machine's sound: a membrane whose pitch falls, with up to four further modes, noise
/// through a band-pass, and metal (inharmonic sines through a high-pass).
struct DrawnDrum {
    /// Modes of the membrane besides its lowest.
    static constexpr int kMostModes = 4;
    static constexpr int kPartials = 6;        ///< sines of the metal
    double hertz = 100.0;                      ///< of the membrane, after its fall
    double fall = 0.0;                         ///< the pitch starts higher by this share of it
    double fall_time = 0.02;                   ///< s until 1/e of the fall
    double body = 1.0;                         ///< level of the membrane
    double body_t60 = 0.3;                     ///< s
    std::array<double, kMostModes> modes{};    ///< level of each
    std::array<double, kMostModes> ratios{};   ///< frequency of each to the membrane's
    double noise = 0.0;                        ///< level of the noise
    double noise_hertz = 2'000.0;              ///< middle of its band-pass
    double noise_q = 0.7;                      ///< Q of its band-pass
    double noise_t60 = 0.2;                    ///< s
    double noise_rise = 0.0005;                ///< s: what is shaken or scraped swells
    int bursts = 1;                            ///< of noise: hands do not clap at once
    double burst_gap = 0.01;                   ///< s
    double metal = 0.0;                        ///< level of the metal
    double metal_hertz = 4'000.0;              ///< its lowest sine
    double metal_t60 = 0.2;                    ///< s
    std::array<double, kPartials> partials{};  ///< frequency of each to metal_hertz
    double drive = 1.0;                        ///< gain into a soft limit; 1: none
    double level = 1.0;                        ///< in the mix; `strike` leaves it to the caller
};

/// Draws a sound of the kind that belongs to a key of General MIDI's percussion map (0-127).
[[nodiscard]] DrawnDrum draw_drum(int key, Dice& dice);

/// Samples of one stroke, mono, peak 1 whatever `level` is, at `rate` samples a second. The same
/// drum gives the same samples.
[[nodiscard]] std::vector<float> strike(const DrawnDrum& drum, int rate);

}  // namespace raks::audio
