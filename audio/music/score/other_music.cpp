#include "audio/music/score/other_music.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/keyboard_scores.hpp"
#include "audio/music/score/score.hpp"

namespace raks::audio {
namespace {

/// Takes out the drums and gives the rest to strings, winds, choirs or soft synthesizers in a free
/// tempo.
void make_orchestral(Score& score, Dice& dice) {
    std::erase_if(score.notes, [](const ScoreNote& note) { return note.channel == kDrumChannel; });
    score.has_drums = false;
    score.is_expressive = true;
    std::array<int, 16> programs{};
    for (int& program : programs) {
        program =
            dice.pick({40, 42, 46, 48, 49, 52, 53, 60, 68, 71, 73, 88, 89, 91, 92, 95, 24, 0});
    }
    for (ScoreNote& note : score.notes) {
        note.program = programs[static_cast<std::size_t>(note.channel)];
    }
}

/// Whether bars have three beats: such a piano piece may be a waltz, hence music for a dance.
bool is_in_three(const Score& score) {
    return *std::max_element(score.bar_position.begin(), score.bar_position.end()) == 3;
}

/// A rhythm of the book that is for no dance.
const RhythmStyle& draw_other_style(const StyleBook& book, Dice& dice) {
    const std::vector<const RhythmStyle*> styles = book.rhythms_for("");
    return *dice.pick<const RhythmStyle*>(styles);
}

/// Applause, talk or noise: samples, not a performance.
WrittenPiece people(const StyleBook& /*book*/, double seconds, Dice& dice) {
    return {"people", "", {}, noise_of_people(kPerformanceRate, seconds, dice)};
}

/// A rhythm that is for no dance, without drums and in free tempo.
WrittenPiece orchestra(const StyleBook& book, double seconds, Dice& dice) {
    Score score = arrange(book, draw_other_style(book, dice), kWrittenBeats, dice);
    make_orchestral(score, dice);
    return {"orchestra", "", perform(score, seconds, dice), {}};
}

/// Chords that swell and stay, one over the other, and now and then some notes above them.
WrittenPiece pads(const StyleBook& /*book*/, double seconds, Dice& dice) {
    Performance played;
    played.seconds = seconds;
    const double stay = dice.log_uniform(1.5, 8.0);     // s a chord
    const double sparks = dice.log_uniform(0.05, 4.0);  // notes a second
    const std::array programs = {dice.whole(88, 95),
                                 dice.pick({48, 49, 50, 51, 52, 54, 89, 90, 91, 95}),
                                 dice.pick({4, 8, 9, 10, 11, 14, 46, 88, 96, 98, 99, 101, 103})};
    const int tonic = dice.whole(36, 48);
    // Natural minor without its second, over two octaves.
    constexpr std::array kDegrees = {0, 3, 5, 7, 8, 10, 12, 15, 17, 19, 24};
    const auto add = [&](int channel, double at, double length, int key, int velocity) {
        played.notes.push_back(
            {at, length, channel, key, programs[static_cast<std::size_t>(channel)], velocity, 0.0});
    };
    // Chords last longer than the time to the next one: they overlap.
    for (double at = 0.0; at < seconds; at += stay * dice.uniform(0.6, 1.4)) {
        const int voices = dice.whole(2, 5);
        for (int voice = 0; voice < voices; ++voice) {
            add(voice % 2, at, 1.5 * stay, tonic + dice.pick<int>(kDegrees), dice.whole(40, 100));
        }
    }
    for (double at = 0.0; at < seconds; at += dice.uniform(0.2, 1.8) / sparks) {
        add(2,
            at,
            dice.uniform(0.2, 2.0),
            tonic + 24 + dice.pick<int>(kDegrees),
            dice.whole(30, 100));
    }
    std::stable_sort(played.notes.begin(), played.notes.end(), [](const auto& a, const auto& b) {
        return a.time < b.time;
    });
    return {"pads", "", std::move(played), {}};
}

/// One voice or instrument that takes its time.
WrittenPiece solo(const StyleBook& /*book*/, double seconds, Dice& dice) {
    Performance played;
    played.seconds = seconds;
    const int program = dice.pick({0,  6,  11, 19, 22, 24, 25, 40, 41, 42, 52,  53,  53,  54,
                                   56, 60, 65, 68, 71, 73, 75, 77, 78, 79, 104, 107, 110, 111});
    constexpr std::array kScale = {0, 2, 3, 5, 7, 8, 10};
    const double haste = dice.log_uniform(0.12, 0.6);  // s of the shortest notes
    const int tonic = dice.whole(48, 62);
    int degree = dice.whole(0, 7);
    for (double at = 0.0; at < seconds - 0.3;) {
        const double length = haste * dice.pick({1.0, 1.0, 2.0, 3.0, 5.0}) * dice.uniform(0.8, 1.3);
        degree = std::clamp(degree + dice.whole(-2, 2), 0, 13);
        const int key = tonic + kScale[static_cast<std::size_t>(degree % 7)] + 12 * (degree / 7);
        played.notes.push_back(
            {at, length, 0, key, program, dice.whole(50, 115), dice.uniform(-30.0, 30.0)});
        at += length + (dice.chance(0.12) ? dice.uniform(0.3, 1.5) : 0.0);
    }
    return {"solo", "", std::move(played), {}};
}

/// Random notes without beats.
WrittenPiece without_pulse(const StyleBook& /*book*/, double seconds, Dice& dice) {
    return {"no pulse", "", notes_without_pulse(seconds, dice), {}};
}

/// Keyboard music that is no waltz.
WrittenPiece piano(const StyleBook& /*book*/, double seconds, Dice& dice) {
    Score score = keyboard_score(kWrittenBeats, dice);
    for (int tries = 0; is_in_three(score) && tries < 20; ++tries) {
        score = keyboard_score(kWrittenBeats, dice);
    }
    return {"piano", "", perform(score, seconds, dice), {}};
}

/// A whole arrangement in a rhythm that is for no dance.
WrittenPiece other_rhythm(const StyleBook& book, double seconds, Dice& dice) {
    const RhythmStyle& style = draw_other_style(book, dice);
    Score score = arrange(book, style, kWrittenBeats, dice);
    return {style.name, "", perform(score, seconds, dice), {}};
}

/// A kind of music; `until` is its upper bound in cumulative probability.
struct Kind {
    double until;
    WrittenPiece (*write)(const StyleBook& book, double seconds, Dice& dice);
};

/// Draws a kind by its share and writes a piece of it; the last kind takes the rest.
WrittenPiece draw_kind(std::span<const Kind> kinds,
                       const StyleBook& book,
                       double seconds,
                       Dice& dice) {
    const double drawn = dice.uniform();
    const auto chosen = std::find_if(
        kinds.begin(), kinds.end() - 1, [drawn](const Kind& kind) { return drawn < kind.until; });
    return chosen->write(book, seconds, dice);
}

}  // namespace

WrittenPiece other_piece(const StyleBook& book, double seconds, Dice& dice) {
    constexpr std::array kKinds = {Kind{0.12, people},
                                   Kind{0.22, without_pulse},
                                   Kind{0.34, piano},
                                   Kind{0.46, orchestra},
                                   Kind{1.0, other_rhythm}};
    return draw_kind(kKinds, book, seconds, dice);
}

WrittenPiece undanceable_piece(const StyleBook& book, double seconds, Dice& dice) {
    constexpr std::array kKinds = {Kind{0.35, people},
                                   Kind{0.5, without_pulse},
                                   Kind{0.7, pads},
                                   Kind{0.85, solo},
                                   Kind{1.0, orchestra}};
    return draw_kind(kKinds, book, seconds, dice);
}

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
