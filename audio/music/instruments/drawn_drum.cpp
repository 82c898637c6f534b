#include "audio/music/instruments/drawn_drum.hpp"

#include <algorithm>
#include <cmath>

#include "audio/music/generator/dsp.hpp"
#include "audio/music/styles/general_midi_drums.hpp"
#include "base/decibels.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

/// Ranges from which the sounds of one kind are drawn: levels, hertz, seconds. A level range of 0
/// to 0 leaves that part out.
struct Kind {
    // The membrane: level, frequency, decay; how far its pitch may fall; number of further modes.
    LogRange body;
    LogRange hertz;
    LogRange body_t60;
    double most_fall;
    int modes;
    // Noise through the band-pass: level, middle, decay.
    LogRange noise;
    LogRange noise_hertz;
    LogRange noise_t60;
    // Metal through the high-pass: level, lowest sine, decay.
    LogRange metal;
    LogRange metal_hertz;
    LogRange metal_t60;
};

constexpr LogRange kNone = {0.0, 0.0};
// For parts whose level is none: never audible.
constexpr LogRange kAny = {1'000.0, 8'000.0};
constexpr LogRange kShort = {0.02, 0.1};

constexpr Kind kKickKind = {{0.8, 1.0},
                            {38, 75},
                            {0.12, 0.9},
                            4.0,
                            1,
                            {0.02, 0.4},
                            {1'000, 6'000},
                            {0.01, 0.06},
                            kNone,
                            kAny,
                            kShort};
constexpr Kind kSnareKind = {{0.2, 0.8},
                             {140, 260},
                             {0.06, 0.3},
                             0.6,
                             2,
                             {0.4, 1.0},
                             {1'200, 7'000},
                             {0.08, 0.5},
                             kNone,
                             kAny,
                             kShort};
constexpr Kind kClapKind = {
    kNone, kAny, kShort, 0.0, 0, {0.8, 1.0}, {800, 3'000}, {0.08, 0.5}, kNone, kAny, kShort};
constexpr Kind kHatKind = {kNone,
                           kAny,
                           kShort,
                           0.0,
                           0,
                           {0.2, 1.0},
                           {5'000, 14'000},
                           {0.03, 0.15},
                           {0.1, 1.0},
                           {3'000, 9'000},
                           {0.03, 0.15}};
constexpr Kind kOpenHatKind = {kNone,
                               kAny,
                               kShort,
                               0.0,
                               0,
                               {0.2, 1.0},
                               {5'000, 14'000},
                               {0.2, 1.0},
                               {0.1, 1.0},
                               {3'000, 9'000},
                               {0.2, 1.0}};
constexpr Kind kCymbalKind = {kNone,
                              kAny,
                              kShort,
                              0.0,
                              0,
                              {0.2, 0.8},
                              {4'000, 12'000},
                              {0.5, 2.5},
                              {0.2, 1.0},
                              {1'500, 6'000},
                              {0.5, 3.0}};
constexpr Kind kSkinKind = {{0.7, 1.0},
                            {80, 420},
                            {0.08, 0.6},
                            0.5,
                            4,
                            {0.02, 0.5},
                            {800, 6'000},
                            {0.01, 0.12},
                            kNone,
                            kAny,
                            kShort};
constexpr Kind kWoodKind = {{0.7, 1.0},
                            {500, 2'800},
                            {0.02, 0.12},
                            0.05,
                            3,
                            {0.01, 0.3},
                            {1'500, 6'000},
                            {0.005, 0.03},
                            kNone,
                            kAny,
                            kShort};
constexpr Kind kBellKind = {{0.1, 0.6},
                            {400, 1'400},
                            {0.1, 0.6},
                            0.0,
                            3,
                            {0.01, 0.1},
                            {2'000, 8'000},
                            {0.01, 0.05},
                            {0.3, 1.0},
                            {700, 5'000},
                            {0.1, 1.2}};
constexpr Kind kShakerKind = {kNone,
                              kAny,
                              kShort,
                              0.0,
                              0,
                              {0.8, 1.0},
                              {3'000, 11'000},
                              {0.03, 0.2},
                              {0.01, 0.5},
                              {5'000, 10'000},
                              {0.03, 0.3}};

/// A kind of sound, and a factor on its pitch: lower drums of a kind get a lower one.
struct Sound {
    const Kind* kind;
    double pitch = 1.0;
};

/// Kind of a General MIDI key. Keys that are not named here are drums with a skin.
Sound sound_of(int key) {
    switch (key) {
        case drum_named("acoustic_kick"):
        case drum_named("kick"):
            return {&kKickKind};
        case drum_named("snare"):
        case drum_named("electric_snare"):
            return {&kSnareKind};
        case drum_named("clap"):
            return {&kClapKind};
        case drum_named("closed_hat"):
        case drum_named("pedal_hat"):
            return {&kHatKind};
        case drum_named("open_hat"):
            return {&kOpenHatKind};
        case drum_named("crash"):
        case drum_named("ride"):
        case drum_named("china"):
        case drum_named("ride_bell"):
        case drum_named("splash"):
        case drum_named("crash_2"):
        case drum_named("ride_2"):
            return {&kCymbalKind};
        case drum_named("low_floor_tom"):
        case drum_named("high_floor_tom"):
            return {&kSkinKind, 0.5};
        case drum_named("high_bongo"):
        case drum_named("mute_conga"):
        case drum_named("high_timbale"):
            return {&kSkinKind, 1.5};
        case drum_named("side_stick"):
        case drum_named("claves"):
        case drum_named("high_wood_block"):
        case drum_named("low_wood_block"):
            return {&kWoodKind};
        case drum_named("cowbell"):
        case drum_named("high_agogo"):
        case drum_named("low_agogo"):
        case drum_named("mute_triangle"):
        case drum_named("open_triangle"):
            return {&kBellKind};
        case drum_named("tambourine"):
        case drum_named("cabasa"):
        case drum_named("maracas"):
        case drum_named("shaker"):
        case drum_named("short_guiro"):
        case drum_named("long_guiro"):
            return {&kShakerKind};
        default:
            return {&kSkinKind};
    }
}

/// A drawn level; 0 for a part that the kind does not have (a logarithm of 0 cannot be drawn).
double level_of(const LogRange& range, Dice& dice) {
    return range.high > 0.0 ? range.draw(dice) : 0.0;
}

/// Cabasa to guiro are shaken or scraped, so their noise has no hard attack.
bool swells(int key) { return key >= drum_named("cabasa") && key <= drum_named("long_guiro"); }

/// Envelope of the noise at `t` seconds: bursts that each decay, the last one for longest.
double noise_at(const DrawnDrum& drum, double t) {
    double gain = 0.0;
    for (int burst = 0; burst < drum.bursts; ++burst) {
        const double since = t - burst * drum.burst_gap;
        const bool is_last = burst + 1 == drum.bursts;
        if (since >= 0.0) {
            const double t60 = is_last ? drum.noise_t60 : 2.0 * drum.burst_gap;
            gain = std::max(gain,
                            std::min(1.0, since / drum.noise_rise) * std::exp(-6.9 * since / t60));
        }
    }
    return gain;
}

}  // namespace

DrawnDrum draw_drum(int key, Dice& dice) {
    const Sound sound = sound_of(key);
    const Kind& kind = *sound.kind;
    DrawnDrum drum;
    drum.body = level_of(kind.body, dice);
    drum.hertz = sound.pitch * kind.hertz.draw(dice);
    drum.fall = dice.chance(0.7) ? dice.uniform(0.0, kind.most_fall) : 0.0;
    drum.fall_time = dice.log_uniform(0.005, 0.08);
    drum.body_t60 = kind.body_t60.draw(dice);
    for (std::size_t mode = 0; mode < drum.modes.size(); ++mode) {
        const bool sounds = static_cast<int>(mode) < kind.modes;
        drum.modes[mode] = sounds ? drum.body * dice.uniform(0.0, 0.6) : 0.0;
        // Near the ratios of a circular membrane, whose second mode is at 1.59.
        drum.ratios[mode] = (1.59 + 0.6 * static_cast<double>(mode)) * dice.uniform(0.9, 1.1);
    }
    drum.noise = level_of(kind.noise, dice);
    drum.noise_hertz = kind.noise_hertz.draw(dice);
    drum.noise_q = dice.log_uniform(0.4, 2.0);
    drum.noise_t60 = kind.noise_t60.draw(dice);
    drum.noise_rise = swells(key) ? dice.log_uniform(0.002, 0.04) : 0.0005;
    // A clap is several hands.
    drum.bursts = sound.kind == &kClapKind ? dice.whole(1, 4) : 1;
    drum.burst_gap = dice.uniform(0.006, 0.015);
    drum.metal = level_of(kind.metal, dice);
    drum.metal_hertz = kind.metal_hertz.draw(dice);
    drum.metal_t60 = kind.metal_t60.draw(dice);
    for (double& ratio : drum.partials) {
        // Inharmonic: sines at no whole ratios sound like metal.
        ratio = dice.uniform(1.0, 2.7);
    }
    drum.drive = dice.chance(0.3) ? dice.log_uniform(1.0, 8.0) : 1.0;
    drum.level = amplitude_of_decibels(dice.uniform(-10.0, 2.0));
    return drum;
}

std::vector<float> strike(const DrawnDrum& drum, int rate) {
    // A stroke ends when its longest part has lost 60 dB.
    const double longest = std::max({drum.body > 0.0 ? drum.body_t60 : 0.0,
                                     drum.noise_t60 + drum.bursts * drum.burst_gap,
                                     drum.metal > 0.0 ? drum.metal_t60 : 0.0});
    const double hertz = rate;
    std::vector<float> out(static_cast<std::size_t>(longest * hertz));
    // Seeded by the drum itself: the same drum has the same noise.
    const CounterRandom random(static_cast<std::uint64_t>(drum.noise_hertz), 3);
    StateVariableFilter band(drum.noise_hertz, drum.noise_q, hertz);
    StateVariableFilter above(0.8 * drum.metal_hertz, 0.7, hertz);
    std::vector<DampedSine> metal;
    std::vector<DampedSine> modes;
    for (const double ratio : drum.partials) {
        metal.emplace_back(ratio * drum.metal_hertz, drum.metal / 3.0, drum.metal_t60, hertz);
    }
    for (std::size_t mode = 0; mode < drum.modes.size(); ++mode) {
        // Higher modes die away faster than the lowest.
        modes.emplace_back(
            drum.ratios[mode] * drum.hertz, drum.modes[mode], 0.6 * drum.body_t60, hertz);
    }
    const double body_loss = decay_per_sample(drum.body_t60, hertz);
    double phase = 0.0;
    double body = drum.body;
    float peak = 1e-6F;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double t = static_cast<double>(i) / hertz;
        // The phase is summed up, since the frequency changes from sample to sample.
        phase += drum.hertz * (1.0 + drum.fall * std::exp(-t / drum.fall_time)) / hertz;
        double sum = body * std::sin(kTwoPi * phase);
        body *= body_loss;
        for (DampedSine& mode : modes) {
            sum += mode.next();
        }
        band.feed(2.0 * random.uniform(i) - 1.0);
        sum += 2.0 * drum.noise * noise_at(drum, t) * band.band();
        if (drum.metal > 0.0) {
            double ring = 0.0;
            for (DampedSine& partial : metal) {
                ring += partial.next();
            }
            above.feed(ring);
            sum += above.high();
        }
        out[i] = static_cast<float>(
            drum.drive > 1.0 ? drum.drive * sum / (1.0 + drum.drive * std::abs(sum)) : sum);
        peak = std::max(peak, std::abs(out[i]));
    }
    for (float& sample : out) {
        sample /= peak;
    }
    return out;
}

}  // namespace raks::audio
