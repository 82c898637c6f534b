#include <algorithm>
#include <array>
#include <cmath>

#include "audio/music/generator/dsp.hpp"
#include "audio/music/generator/notes.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

// A plucked or struck string as a sum of decaying partials.
struct String {
    int partials = 8;
    double slope = 1.2;          ///< gain of partial n: n^-slope
    double t60 = 2.0;            ///< of the first partial at 220 Hz, seconds
    double damping = 0.35;       ///< how much faster the higher partials die
    double inharmonicity = 0.0;  ///< B of a stiff string: f_n = n f sqrt(1 + B n^2)
    double pluck_at = 0.0;       ///< place of the pluck, a part of the string; 0: none
    double release = 0.05;       ///< of the damper, seconds
    double thump = 0.0;          ///< noise of hammer or finger
    double detune = 0.0;         ///< second string, as a part of the frequency; 0: one string
};

constexpr String kPiano{16, 0.85, 2.6, 0.30, 0.00045, 0.125, 0.06, 0.18, 0.0008};
constexpr String kBass{9, 1.10, 1.5, 0.55, 0.0001, 0.23, 0.04, 0.12, 0.0};
constexpr String kOud{20, 0.75, 1.1, 0.35, 0.0001, 0.17, 0.05, 0.25, 0.0015};

// Higher notes die faster (t60 by the root of the frequency), and so do higher partials.
std::vector<float> pluck(const String& string, const SoundRequest& request) {
    const double length = request.seconds + string.release;
    std::vector<double> sum(static_cast<std::size_t>(length * request.rate), 0.0);
    const double t60 = string.t60 * std::sqrt(220.0 / request.hertz);
    const int strings = string.detune > 0.0 ? 2 : 1;
    for (int n = 1; n <= string.partials; ++n) {
        const double order = n;
        const double hertz =
            request.hertz * order * std::sqrt(1.0 + string.inharmonicity * order * order);
        if (hertz > 0.42 * request.rate || hertz > 12'000.0) {
            break;
        }
        // Softer notes have weaker upper partials.
        double gain = std::pow(order, -string.slope - 0.6 * (1.0 - request.brightness));
        if (string.pluck_at > 0.0) {
            gain *= std::abs(std::sin(0.5 * kTwoPi * order * string.pluck_at)) + 0.12;
        }
        const double decay = t60 / (1.0 + string.damping * (order - 1.0));
        // Two strings slightly out of tune beat against each other, as in a piano or an oud.
        for (int s = 0; s < strings; ++s) {
            const double offset = (s == 0 ? -0.5 : 0.5) * string.detune;
            DampedSine sine(hertz * (1.0 + offset), gain / strings, decay, request.rate);
            for (double& sample : sum) {
                sample += sine.next();
            }
        }
    }
    // Noise of the hammer or finger at the attack, gone after some 10 ms.
    const CounterRandom random(static_cast<std::uint64_t>(request.sound), 7);
    StateVariableFilter thump(std::min(6.0 * request.hertz, 2400.0), 0.7, request.rate);
    std::vector<float> out(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double t = static_cast<double>(i) / request.rate;
        thump.feed(2.0 * random.uniform(i) - 1.0);
        const double noise = string.thump * thump.low() * std::exp(-t / 0.008);
        out[i] =
            static_cast<float>((0.6 * sum[i] + noise) * edges(t, length, 0.001, string.release));
    }
    return out;
}

// Saw waves through a low-pass that opens and closes: brass, chord stabs, pad, guitar, synthesizer
// bass.
struct Voice {
    int saws = 2;
    double detune = 0.004;     ///< spread of the saws, as a part of the frequency
    double rise = 0.02;        ///< seconds
    double release = 0.06;     ///< seconds
    double cutoff_low = 2.0;   ///< of the filter, in harmonics
    double cutoff_high = 9.0;  ///< at full brightness
    double opening = 0.04;     ///< time in which the filter opens, seconds
    double closing = 0.5;      ///< time constant in which it closes again, seconds
    double hold = 0.6;         ///< how far open it stays, [0, 1]
    double vibrato = 0.0;      ///< depth, as a part of the frequency, after 0.25 s
    double q = 0.8;
    double sub = 0.0;  ///< a sine at the fundamental
};

constexpr Voice kBrass{3, 0.0035, 0.016, 0.07, 1.6, 8.5, 0.035, 0.35, 0.62, 0.004, 0.8, 0.0};
constexpr Voice kStab{4, 0.008, 0.004, 0.09, 1.2, 9.0, 0.004, 0.11, 0.15, 0.0, 1.2, 0.0};
constexpr Voice kPad{4, 0.010, 0.25, 0.5, 1.5, 4.0, 0.4, 2.0, 0.7, 0.0, 0.7, 0.0};
constexpr Voice kGuitar{4, 0.006, 0.003, 0.05, 3.0, 14.0, 0.006, 0.8, 0.6, 0.0, 0.8, 0.0};
constexpr Voice kSynthBass{2, 0.003, 0.004, 0.05, 1.2, 7.0, 0.004, 0.12, 0.2, 0.0, 1.4, 0.9};

// How far the low-pass is open at `t`, [0, 1]: opens linearly, then falls to what it holds.
double openness(const Voice& voice, double t) {
    const double open = std::min(t / voice.opening, 1.0);
    const double fall = std::exp(-std::max(t - voice.opening, 0.0) / voice.closing);
    return open * (voice.hold + (1.0 - voice.hold) * fall);
}

std::vector<float> blow(const Voice& voice, const SoundRequest& request) {
    const double length = request.seconds + voice.release;
    // Fixed, unequal start phases: all saws in phase would click.
    std::array<Saw, 4> saws{Saw(0.03), Saw(0.31), Saw(0.62), Saw(0.84)};
    const auto count = static_cast<std::size_t>(voice.saws);
    StateVariableFilter filter(request.hertz, voice.q, request.rate);
    std::vector<float> out(static_cast<std::size_t>(length * request.rate));
    double phase = 0.0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double t = static_cast<double>(i) / request.rate;
        // The filter's coefficients change slowly: every 16 samples is enough.
        if (i % 16 == 0) {
            const double range = voice.cutoff_high * request.brightness - voice.cutoff_low;
            const double harmonic = voice.cutoff_low + std::max(range, 0.5) * openness(voice, t);
            filter.set(std::min(request.hertz * harmonic, 9000.0), voice.q, request.rate);
        }
        // Vibrato comes late, as wind players do it.
        const double swell = std::clamp((t - 0.25) / 0.3, 0.0, 1.0);
        const double bend = 1.0 + voice.vibrato * swell * std::sin(kTwoPi * 5.6 * t);
        double sum = 0.0;
        for (std::size_t s = 0; s < count; ++s) {
            const double spread = static_cast<double>(s) / static_cast<double>(count - 1) - 0.5;
            sum += saws[s].next(request.hertz * bend * (1.0 + voice.detune * spread), request.rate);
        }
        filter.feed(sum / static_cast<double>(count));
        phase += kTwoPi * request.hertz / request.rate;
        const double sample = 0.7 * filter.low() + voice.sub * std::sin(phase);
        out[i] = static_cast<float>(sample * edges(t, length, voice.rise, voice.release));
    }
    return out;
}

}  // namespace

std::vector<float> synthesize_tone(const SoundRequest& request) {
    switch (request.sound) {
        case Sound::piano:
            return pluck(kPiano, request);
        case Sound::oud:
            return pluck(kOud, request);
        case Sound::brass:
            return blow(kBrass, request);
        case Sound::stab:
            return blow(kStab, request);
        case Sound::guitar:
            return blow(kGuitar, request);
        case Sound::pad:
            return blow(kPad, request);
        case Sound::synth_bass:
            return blow(kSynthBass, request);
        default:
            return pluck(kBass, request);
    }
}

}  // namespace raks::audio
