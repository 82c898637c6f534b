#include "audio/music/score/non_music.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "audio/music/score/score.hpp"

namespace raks::audio {
namespace {

/// Seconds to the next event of a Poisson process with `rate` events a second on average.
double wait(double rate, Dice& dice) { return -std::log(1.0 - dice.uniform()) / rate; }

/// Adds a burst of noise that decays to 1/e in `decay` samples.
void add_clap(
    std::size_t first, double level, double decay, std::vector<float>& samples, Dice& dice) {
    const std::size_t end = std::min(samples.size(), first + static_cast<std::size_t>(6.0 * decay));
    // A hollow hand: the noise rings a little.
    const double ring = dice.uniform(0.0, 0.8);
    double before = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        const double noise = dice.normal(1.0) + ring * before;
        before = noise;
        samples[i] +=
            static_cast<float>(level * noise * std::exp(-static_cast<double>(i - first) / decay));
    }
}

/// Claps of a crowd: independent, so that no pulse arises.
void add_applause(int rate, std::vector<float>& samples, Dice& dice) {
    const double seconds = static_cast<double>(samples.size()) / rate;
    const double claps = dice.log_uniform(8.0, 150.0);
    const double decay = dice.uniform(0.001, 0.006) * rate;
    for (double at = 0.0; at < seconds; at += wait(claps, dice)) {
        add_clap(
            static_cast<std::size_t>(at * rate), dice.uniform(0.01, 0.1), decay, samples, dice);
    }
}

/// One voice: syllables with three formants on a pitch that wanders, hisses, pauses.
void add_talk(int rate, std::vector<float>& samples, Dice& dice) {
    const double seconds = static_cast<double>(samples.size()) / rate;
    const double centre = dice.log_uniform(85.0, 260.0);
    const double haste = dice.uniform(0.7, 1.5);
    const double loudness = dice.uniform(0.05, 0.2);
    double pitch = centre;
    for (double at = dice.uniform(0.0, 1.0); at < seconds - 0.5;) {
        const double length = haste * dice.uniform(0.06, 0.28);
        const bool is_hiss = dice.chance(0.25);
        const double level = loudness * dice.uniform(0.3, 1.0);
        // The pitch wanders from syllable to syllable, within 0.7 to 1.5 times the voice's own.
        pitch = std::clamp(pitch * std::exp(dice.normal(0.08)), 0.7 * centre, 1.5 * centre);
        const std::array formants = {
            dice.uniform(280.0, 850.0), dice.uniform(850.0, 2400.0), dice.uniform(2400.0, 3400.0)};
        const double glide = dice.uniform(-0.3, 0.3);
        const auto first = static_cast<std::size_t>(at * rate);
        const auto count = static_cast<std::size_t>(length * rate);
        double phase = 0.0;
        for (std::size_t i = 0; i < count && first + i < samples.size(); ++i) {
            const double t = static_cast<double>(i) / rate;
            const double edge = std::min({1.0, t / 0.02, (length - t) / 0.05});
            phase += pitch * (1.0 + glide * t / length) / rate;
            // Each period of the voice starts every formant anew, as a glottal pulse does.
            const double in_period = phase - std::floor(phase);
            double tone = 0.0;
            for (std::size_t k = 0; k < formants.size(); ++k) {
                tone += std::sin(2.0 * std::numbers::pi * formants[k] * in_period / pitch) *
                        std::exp(-(6.0 + 3.0 * static_cast<double>(k)) * in_period) /
                        static_cast<double>(k + 1);
            }
            samples[first + i] +=
                static_cast<float>(level * edge * (is_hiss ? 0.3 * dice.normal(1.0) : tone));
        }
        at += length + haste * dice.uniform(0.0, 0.09);
        at += dice.chance(0.15) ? dice.uniform(0.15, 0.9) : 0.0;
    }
}

/// Wind, traffic, a murmuring crowd: coloured noise whose loudness wanders.
void add_swelling_noise(std::vector<float>& samples, Dice& dice) {
    const double colour = dice.uniform(0.0, 0.98);
    const double speed = dice.log_uniform(1e-5, 3e-4);
    const double level = dice.uniform(0.01, 0.1);
    double low = 0.0;
    double log_level = 0.0;
    for (float& sample : samples) {
        low = colour * low + (1.0 - colour) * dice.normal(1.0);
        // The log of the level is a mean-reverting random walk: it swells but does not run away.
        log_level += speed * -0.5 * log_level + std::sqrt(speed) * dice.normal(0.7);
        sample += static_cast<float>(level * std::exp(log_level) * low /
                                     std::sqrt((1.0 - colour) / (1.0 + colour)));
    }
}

}  // namespace

std::vector<float> noise_of_people(int rate, double seconds, Dice& dice) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    // Applause and talk in 40 % each, noise alone in 20 %; in some of the others noise behind them.
    const double kind = dice.uniform();
    if (kind < 0.4) {
        add_applause(rate, samples, dice);
    } else if (kind < 0.8) {
        const int voices = dice.pick({1, 1, 1, 2, 4});
        for (int voice = 0; voice < voices; ++voice) {
            add_talk(rate, samples, dice);
        }
    }
    if (kind >= 0.8 || dice.chance(0.3)) {
        add_swelling_noise(samples, dice);
    }
    return samples;
}

Performance notes_without_pulse(double seconds, Dice& dice) {
    Performance played;
    played.seconds = seconds;
    const bool are_drums = dice.chance(0.4);
    const double notes = dice.log_uniform(0.3, 9.0);  // a second
    const int program = dice.whole(0, 103);
    int key = dice.whole(45, 75);
    for (double at = wait(notes, dice); at < seconds - 0.5; at += wait(notes, dice)) {
        key = are_drums ? dice.whole(35, 81) : std::clamp(key + dice.whole(-7, 7), 36, 88);
        played.notes.push_back({at,
                                dice.log_uniform(0.1, 3.0),
                                are_drums ? kDrumChannel : 0,
                                key,
                                are_drums ? 0 : program,
                                dice.whole(40, 120)});
    }
    return played;
}

}  // namespace raks::audio
