#pragma once

#include <array>
#include <vector>

#include "base/dice.hpp"

namespace raks::audio {

/// A drum machine's sound: a membrane whose pitch falls, with up to four further modes, noise
/// through a band-pass, and metal (sines at no harmonics through a high-pass).
struct DrawnDrum {
    static constexpr int kMostModes = 4;
    static constexpr int kPartials = 6;  ///< of metal
    double hertz = 100.0;                ///< of the membrane, after its fall
    double fall = 0.0;                   ///< begins that much higher, as a part of the frequency
    double fall_time = 0.02;             ///< s until 1/e of it
    double body = 1.0;                   ///< level of the membrane
    double body_t60 = 0.3;               ///< s
    std::array<double, kMostModes> modes{};   ///< level of each
    std::array<double, kMostModes> ratios{};  ///< frequency of each to the membrane's
    double noise = 0.0;
    double noise_hertz = 2'000.0;
    double noise_q = 0.7;
    double noise_t60 = 0.2;      ///< s
    double noise_rise = 0.0005;  ///< s: what is shaken or scraped swells
    int bursts = 1;              ///< of noise: hands do not clap at once
    double burst_gap = 0.01;     ///< s
    double metal = 0.0;
    double metal_hertz = 4'000.0;
    double metal_t60 = 0.2;                    ///< s
    std::array<double, kPartials> partials{};  ///< ratios
    double drive = 1.0;
    double level = 1.0;
};

/// Of the kind that a key of General MIDI's percussion map is.
[[nodiscard]] DrawnDrum draw_drum(int key, Dice& dice);

/// One stroke, mono, peak 1 before `level`.
[[nodiscard]] std::vector<float> strike(const DrawnDrum& drum, int rate);

}  // namespace raks::audio
