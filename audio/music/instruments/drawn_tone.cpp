#include "audio/music/instruments/drawn_tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "audio/music/generator/dsp.hpp"
#include "base/decibels.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

/// How the instruments of one family of General MIDI (eight programs each) start and end.
struct Family {
    bool is_held;
    LogRange attack;  // s
    LogRange decay;   // s
};

constexpr std::array<Family, 16> kFamilies = {{
    {false, {0.001, 0.006}, {0.2, 1.5}},   // piano
    {false, {0.001, 0.003}, {0.1, 1.0}},   // chromatic percussion
    {true, {0.002, 0.03}, {0.1, 1.0}},     // organ
    {false, {0.001, 0.006}, {0.1, 1.0}},   // guitar
    {false, {0.001, 0.015}, {0.1, 1.0}},   // bass
    {true, {0.02, 0.15}, {0.2, 2.0}},      // strings
    {true, {0.03, 0.3}, {0.2, 2.0}},       // ensemble
    {true, {0.01, 0.06}, {0.1, 0.6}},      // brass
    {true, {0.01, 0.06}, {0.1, 0.6}},      // reed
    {true, {0.01, 0.08}, {0.1, 0.6}},      // pipe
    {true, {0.001, 0.03}, {0.1, 1.0}},     // lead
    {true, {0.05, 0.6}, {0.3, 3.0}},       // pad
    {true, {0.01, 0.4}, {0.2, 2.0}},       // effects
    {false, {0.001, 0.006}, {0.06, 0.6}},  // of other continents
    {false, {0.001, 0.003}, {0.05, 0.5}},  // percussive
    {true, {0.01, 0.3}, {0.1, 1.0}},       // sound effects
}};

constexpr double kLongestRelease = 5.0;  // release times after which a note is cut
constexpr int kControlSamples = 32;      // samples between updates of the filter

/// The oscillators of one note.
class Oscillators {
 public:
    Oscillators(const DrawnTone& tone, double rate, const CounterRandom& random)
        : tone_(tone), rate_(rate) {
        for (int voice = 0; voice < tone.voices; ++voice) {
            // Voices start at phases of their own, or they would sum to a click at the attack.
            const double start = random.uniform(static_cast<std::uint64_t>(voice));
            // -1 to 1: voices are detuned evenly to both sides.
            const double place = tone.voices > 1 ? 2.0 * voice / (tone.voices - 1.0) - 1.0 : 0.0;
            voices_.push_back({Saw(start),
                               Saw(std::fmod(start + tone.pulse_width, 1.0)),
                               start,
                               1.0 + place * tone.detune});
        }
    }

    /// The next sample at this frequency; `brightness` in [0, 1] scales the modulation index.
    double next(double hertz, double brightness) {
        double sum = 0.0;
        for (Voice& voice : voices_) {
            const double f = hertz * voice.ratio;
            switch (tone_.oscillator) {
                case DrawnTone::Oscillator::saw:
                    sum += voice.saw.next(f, rate_);
                    break;
                case DrawnTone::Oscillator::pulse:
                    // The difference of two saws is a pulse, as wide as they are apart.
                    sum += voice.saw.next(f, rate_) - voice.second.next(f, rate_);
                    break;
                case DrawnTone::Oscillator::modulated:
                    voice.phase += f / rate_;
                    sum += std::sin(kTwoPi * voice.phase +
                                    tone_.index * brightness *
                                        std::sin(kTwoPi * tone_.ratio * voice.phase));
                    break;
            }
        }
        // Detuned voices are uncorrelated: their power adds, not their amplitude.
        return sum / std::sqrt(static_cast<double>(voices_.size()));
    }

 private:
    struct Voice {
        Saw saw;
        Saw second;
        double phase;
        double ratio;
    };
    DrawnTone tone_;
    double rate_;
    std::vector<Voice> voices_;
};

/// Loudness over a note's time: a straight rise, a fall towards `sustain`, a fall after the end.
double envelope(const DrawnTone& tone, double t, double length) {
    // After the end the level stays what it was there, and the release takes it down.
    const double inside = std::min(t, length);
    const double rise = std::min(1.0, inside / tone.attack);
    const double held =
        tone.sustain +
        (1.0 - tone.sustain) * std::exp(-std::max(0.0, inside - tone.attack) / tone.decay);
    return rise * held * (t > length ? std::exp(-(t - length) / tone.release) : 1.0);
}

}  // namespace

DrawnTone draw_tone(int program, Dice& dice) {
    const Family& family = kFamilies[static_cast<std::size_t>(program / 8)];
    DrawnTone tone;
    tone.oscillator = dice.pick({DrawnTone::Oscillator::saw,
                                 DrawnTone::Oscillator::pulse,
                                 DrawnTone::Oscillator::modulated});
    const bool is_modulated = tone.oscillator == DrawnTone::Oscillator::modulated;
    // A modulated sine has sidebands enough without detuned copies.
    tone.voices = is_modulated ? 1 : dice.pick({1, 1, 2, 3});
    tone.detune = dice.log_uniform(0.001, 0.015);
    tone.pulse_width = dice.uniform(0.15, 0.5);
    // Whole ratios give harmonic sounds, the others bells.
    tone.ratio = dice.pick({0.5, 1.0, 1.0, 2.0, 3.0, 3.5, 5.0, 7.0, 1.41, 11.0});
    tone.index = dice.log_uniform(0.2, 6.0);
    tone.breath = dice.chance(0.25) ? dice.log_uniform(0.02, 0.4) : 0.0;
    tone.attack = family.attack.draw(dice);
    tone.decay = family.decay.draw(dice);
    tone.sustain = family.is_held ? dice.uniform(0.3, 1.0) : dice.uniform(0.0, 0.15);
    tone.release = dice.log_uniform(0.02, family.is_held ? 0.5 : 0.2);
    tone.cutoff = dice.log_uniform(1.5, 20.0);
    tone.opening = dice.chance(0.6) ? dice.log_uniform(1.0, 20.0) : 0.0;
    tone.resonance = dice.log_uniform(0.6, 4.0);
    tone.vibrato = family.is_held && dice.chance(0.4) ? dice.uniform(0.001, 0.008) : 0.0;
    tone.drive = dice.chance(0.3) ? dice.log_uniform(1.0, 12.0) : 1.0;
    tone.level = amplitude_of_decibels(dice.uniform(-8.0, 4.0));
    return tone;
}

void add_note(const DrawnTone& tone, const ToneNote& note, int rate, std::span<float> samples) {
    const auto begin = static_cast<std::size_t>(std::max(0.0, note.time) * rate);
    if (begin >= samples.size()) {
        return;
    }
    const double hops = rate;
    const std::size_t count =
        std::min(samples.size() - begin,
                 static_cast<std::size_t>((note.length + kLongestRelease * tone.release) * hops));
    // Seeded by place and pitch: the same note is the same samples.
    const CounterRandom random(begin, static_cast<std::uint64_t>(note.hertz));
    Oscillators oscillators(tone, hops, random);
    StateVariableFilter filter(1'000.0, tone.resonance, hops);
    double brightness = 0.0;
    double hertz = note.hertz;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / hops;
        // Brightness decays like the note: a struck string loses its overtones first.
        if (i % kControlSamples == 0) {
            brightness = std::exp(-t / tone.decay);
            hertz = note.hertz * (1.0 + tone.vibrato * std::sin(kTwoPi * 5.5 * t));
            // Soft notes are darker. The cut-off is in harmonics, so that high notes keep theirs.
            const double harmonics =
                (tone.cutoff + tone.opening * brightness) * (0.5 + 0.5 * note.strength);
            filter.set(std::clamp(harmonics * hertz, 60.0, 18'000.0), tone.resonance, hops);
        }
        const double noise = tone.breath * (2.0 * random.uniform(100 + i) - 1.0);
        filter.feed(oscillators.next(hertz, brightness) + noise);
        const double driven = tone.drive * filter.low();
        const double limited = tone.drive > 1.0 ? driven / (1.0 + std::abs(driven)) : driven;
        samples[begin + i] += static_cast<float>(tone.level * note.strength *
                                                 envelope(tone, t, note.length) * limited);
    }
}

}  // namespace raks::audio
