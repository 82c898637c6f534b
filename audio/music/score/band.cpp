#include "audio/music/score/band.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace raks::audio {
namespace {

constexpr int kBassChannel = 0;
constexpr int kChordChannel = 1;
constexpr int kLeadChannel = 2;

// A triad or seventh chord without fifth, as semitones over its root.
struct Chord {
    int root = 0;  // semitones over the key
    std::array<int, 3> tones{};
};

constexpr Chord major(int root) { return {root, {0, 4, 7}}; }
constexpr Chord minor(int root) { return {root, {0, 3, 7}}; }
constexpr Chord dominant(int root) { return {root, {0, 4, 10}}; }

// Common progressions of four chords, in semitones over the key.
constexpr std::array<std::array<Chord, 4>, 12> kLoops = {{
    {major(0), major(7), minor(9), major(5)},
    {minor(0), major(8), major(3), major(10)},
    {major(0), minor(9), major(5), major(7)},
    {major(0), major(5), major(7), major(5)},
    {minor(0), minor(5), dominant(7), minor(0)},
    {major(0), major(0), major(5), major(7)},
    {minor(0), major(10), major(8), dominant(7)},
    {minor(2), dominant(7), major(0), major(0)},
    {major(0), major(1), major(0), minor(10)},
    {minor(0), minor(0), minor(0), minor(0)},
    {dominant(0), dominant(5), dominant(0), dominant(7)},
    {major(0), major(10), major(5), major(0)},
}};

/// What all players share: key, chords, bars, instruments and levels. Its methods write notes.
class Band {
 public:
    Band(Score& score, Dice& dice)
        : score_(score),
          dice_(dice),
          key_(dice.whole(0, 11)),
          loop_(dice.pick<std::array<Chord, 4>>(kLoops)),
          bars_per_chord_(dice.pick({1, 1, 1, 2, 4})) {
        // Counting downbeats numbers the bars; beats before the first one belong to bar 0.
        int bar = -1;
        for (const int position : score.bar_position) {
            bar += position == 1 ? 1 : 0;
            bar_of_beat_.push_back(std::max(bar, 0));
        }
    }

    [[nodiscard]] int beats() const { return static_cast<int>(score_.bar_position.size()); }
    [[nodiscard]] int position(int beat) const {
        return score_.bar_position[static_cast<std::size_t>(beat)];
    }
    /// The chord at a beat; beats past the end have the last bar's, for lines that play ahead.
    [[nodiscard]] const Chord& chord(int beat) const {
        const int bar = bar_of_beat_[static_cast<std::size_t>(std::clamp(beat, 0, beats() - 1))];
        return loop_[static_cast<std::size_t>(bar / bars_per_chord_ % 4)];
    }
    /// Beats of the bar that begins at `beat`: the last position before the next downbeat.
    [[nodiscard]] int beats_in_bar(int beat) const {
        int last = position(beat);
        for (int next = beat + 1; next < beats() && position(next) > 1; ++next) {
            last = position(next);
        }
        return last;
    }
    void play_bass(int beat, double at, double length, double velocity = 95.0, int interval = 0) {
        // Roots above G are taken an octave down, into a bass's range.
        const int root = 36 + (key_ + chord(beat).root) % 12;
        add(kBassChannel,
            bass_program_,
            at,
            length,
            root + interval - (root > 43 ? 12 : 0),
            velocity);
    }
    void play_chord(int beat, double at, double length, double velocity = 75.0) {
        for (const int tone : chord(beat).tones) {
            add(kChordChannel,
                chord_program_,
                at,
                length,
                60 + (key_ + chord(beat).root) % 12 - 5 + tone,
                velocity);
        }
    }
    /// One tone of the chord; tones 3 to 5 are the same an octave higher.
    void play_tone(int beat, double at, double length, int tone, double velocity = 75.0) {
        const Chord& now = chord(beat);
        const int octave = tone / 3 * 12;
        add(kChordChannel,
            chord_program_,
            at,
            length,
            60 + (key_ + now.root) % 12 - 5 + now.tones[static_cast<std::size_t>(tone % 3)] +
                octave,
            velocity);
    }
    void play_lead(double at, double length, int key, double velocity) {
        add(kLeadChannel, lead_program_, at, length, key_ % 12 + key, velocity);
    }
    Dice& dice() { return dice_; }

 private:
    void add(int channel, int program, double at, double length, int key, double velocity) {
        if (at >= 0.0) {
            score_.notes.push_back(
                {at, length, channel, key, program, velocity * level(channel), 0.0});
        }
    }
    [[nodiscard]] double level(int channel) const {
        return levels_[static_cast<std::size_t>(channel)];
    }

    Score& score_;
    Dice& dice_;
    int key_;
    std::array<Chord, 4> loop_;
    int bars_per_chord_;
    std::vector<int> bar_of_beat_;
    int bass_program_ = dice_.pick({32, 33, 34, 35, 36, 38, 39, 43});
    int chord_program_ = dice_.pick({0,  1,  2,  4,  5,  6,  7,  11, 16, 17, 18, 21, 24, 25, 26, 27,
                                     28, 29, 30, 46, 48, 50, 61, 62, 63, 80, 81, 88, 89, 90, 94});
    int lead_program_ =
        dice_.pick({0,  4,  11, 21, 22, 25, 26, 27, 29, 30, 40, 41, 42, 52, 53, 56,
                    57, 59, 60, 64, 65, 66, 67, 68, 71, 73, 74, 75, 80, 81, 82, 84});
    std::array<double, 3> levels_ = {
        dice_.uniform(0.7, 1.1), dice_.uniform(0.5, 1.05), dice_.uniform(0.6, 1.1)};
};

/// A cell of one bar in sixteenths that is played again and again.
std::vector<bool> random_cell(int beats_per_bar, bool has_beat_1, Dice& dice) {
    std::vector<bool> cell(static_cast<std::size_t>(4 * beats_per_bar));
    for (std::size_t step = 0; step < cell.size(); ++step) {
        // Beats are likelier than eighths between them, and these than sixteenths.
        const double weight = step % 4 == 0 ? 0.45 : step % 2 == 0 ? 0.35 : 0.12;
        cell[step] = dice.chance(weight) || (step == 0 && has_beat_1);
    }
    return cell;
}

/// Calls play(beats after the bar's begin) on each sixteenth of the cell that sounds.
template <class Play>
void play_cell(const std::vector<bool>& cell, int bar_beats, const Play& play) {
    const std::size_t steps = std::min(cell.size(), 4 * static_cast<std::size_t>(bar_beats));
    for (std::size_t step = 0; step < steps; ++step) {
        if (cell[step]) {
            play(0.25 * static_cast<double>(step));
        }
    }
}

/// A tone on every beat: root, third, fifth or a neighbour of them, drawn.
void play_walking_bass(int beat, int bar_beats, Band& band) {
    for (int i = 0; i < bar_beats; ++i) {
        band.play_bass(beat, beat + i, 0.9, 92.0, band.dice().pick({0, 4, 7, 9, 5, 2}));
    }
}

/// Root and fifth in turn on every other beat; in bars of three the root alone.
void play_root_fifth(int beat, int bar_beats, Band& band) {
    for (int i = 0; i < bar_beats; i += bar_beats == 3 ? 3 : 2) {
        band.play_bass(beat, beat + i, 0.9, 95.0, i % 4 == 0 ? 0 : 7);
    }
}

/// Samba's surdo: soft root on odd beats, loud fifth on even ones, each with a sixteenth ahead of
/// the next beat.
void play_surdo(int beat, int bar_beats, Band& band) {
    for (int i = 0; i < bar_beats; ++i) {
        const int interval = i % 2 == 0 ? 0 : 7;
        band.play_bass(beat, beat + i, 0.6, i % 2 == 0 ? 80.0 : 105.0, interval);
        band.play_bass(beat, beat + i + 0.75, 0.2, 75.0, interval);
    }
}

/// Dotted eighth, sixteenth, two eighths in every two beats.
void play_habanera(int beat, int bar_beats, Band& band) {
    for (const double at : {0.0, 0.75, 1.0, 1.5}) {
        for (int half = 0; half + 1 < bar_beats; half += 2) {
            band.play_bass(beat, beat + half + at, 0.4);
        }
    }
}

/// One bar of a bass line from `beat` on; `cell` is the rhythm of a random line.
void play_bass_bar(
    BassLine line, const std::vector<bool>& cell, int beat, int bar_beats, Band& band) {
    const auto each = [&](double from, double step, double length, bool is_octave = false) {
        for (double at = from; at < bar_beats; at += step) {
            // Octaves alternate: root on the beat, an octave higher off it.
            const bool is_up = is_octave && std::lround(at / step) % 2 == 1;
            band.play_bass(beat, beat + at, length, 95.0, is_up ? 12 : 0);
        }
    };
    switch (line) {
        case BassLine::none:
            break;
        case BassLine::eighths:
            each(0.0, 0.5, 0.45);
            break;
        case BassLine::quarters:
            each(0.0, 1.0, 0.8);
            break;
        case BassLine::octaves:
            each(0.0, 0.5, 0.4, true);
            break;
        case BassLine::off_beat:
            each(0.5, 1.0, 0.4);
            break;
        case BassLine::gallop:
            each(0.25, 1.0, 0.2);
            each(0.5, 1.0, 0.2);
            each(0.75, 1.0, 0.2);
            break;
        case BassLine::random_cell:
            play_cell(cell, bar_beats, [&](double at) { band.play_bass(beat, beat + at, 0.4); });
            break;
        case BassLine::whole_bar:
            band.play_bass(beat, beat, 0.9 * bar_beats);
            break;
        case BassLine::walking:
            play_walking_bass(beat, bar_beats, band);
            break;
        case BassLine::root_fifth:
            play_root_fifth(beat, bar_beats, band);
            break;
        case BassLine::surdo:
            play_surdo(beat, bar_beats, band);
            break;
        case BassLine::tumbao:
            band.play_bass(beat, beat + 1.5, 1.4, 95.0, 7);
            // The next bar's chord comes on the 4.
            band.play_bass(beat + bar_beats, beat + 3.0, 2.3, 105.0);
            break;
        case BassLine::habanera:
            play_habanera(beat, bar_beats, band);
            break;
    }
}

/// One bar of a piano montuno: chord tones in octaves, mostly off the beat.
void play_montuno_bar(int beat, int bar_beats, Band& band) {
    // Octaves off the beat, and on beat 1 of six bars in ten.
    constexpr std::array kSteps = {0.0, 0.5, 1.5, 2.5, 3.5};
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
        if (kSteps[i] < bar_beats && (i > 0 || band.dice().chance(0.6))) {
            const int tone = static_cast<int>(i) % 3;
            // From beat 4 on the next bar's chord, like the tumbao.
            const int at_chord = kSteps[i] >= 3.0 ? beat + bar_beats : beat;
            band.play_tone(at_chord, beat + kSteps[i], 0.4, tone, 85.0);
            band.play_tone(at_chord, beat + kSteps[i], 0.4, tone + 3, 85.0);
        }
    }
}

/// One bar of accompaniment from `beat` on; `cell` is the rhythm of a random one.
void play_comping_bar(
    Comping comping, const std::vector<bool>& cell, int beat, int bar_beats, Band& band) {
    const auto each = [&](double from, double step, double length) {
        for (double at = from; at < bar_beats; at += step) {
            band.play_chord(beat, beat + at, length);
        }
    };
    const auto arpeggio = [&](double step) {
        int tone = 0;
        for (double at = 0.0; at < bar_beats; at += step) {
            constexpr std::array kTones = {0, 1, 2, 3, 2, 1, 4, 2};
            band.play_tone(beat, beat + at, step, kTones[static_cast<std::size_t>(tone++ % 8)]);
        }
    };
    switch (comping) {
        case Comping::none:
            break;
        case Comping::held:
            band.play_chord(beat, beat, bar_beats);
            break;
        case Comping::quarters:
            each(0.0, 1.0, 0.7);
            break;
        case Comping::eighths:
            each(0.0, 0.5, 0.4);
            break;
        case Comping::after_beats:
            // Waltz: chords on beats 2 and 3; else on the eighths between the beats.
            if (bar_beats == 3) {
                each(1.0, 1.0, 0.6);
            } else {
                each(0.5, 1.0, 0.3);
            }
            break;
        case Comping::arpeggio16:
            arpeggio(0.25);
            break;
        case Comping::arpeggio8:
            arpeggio(0.5);
            break;
        case Comping::random_cell:
            play_cell(cell, bar_beats, [&](double at) { band.play_chord(beat, beat + at, 0.3); });
            break;
        case Comping::montuno:
            play_montuno_bar(beat, bar_beats, band);
            break;
    }
}

/// A random walk over a major, minor or phrygian dominant scale.
void play_lead(Band& band) {
    constexpr std::array<std::array<int, 7>, 3> kScales = {
        {{0, 2, 4, 5, 7, 9, 11}, {0, 2, 3, 5, 7, 8, 10}, {0, 1, 4, 5, 7, 8, 10}}};
    Dice& dice = band.dice();
    const auto& scale = kScales[static_cast<std::size_t>(dice.whole(0, 2))];
    const double unit = dice.pick({0.25, 0.5, 0.5, 1.0, 1.0 / 3.0});
    int degree = 7;
    for (double at = 0.0; at < band.beats();) {
        // Every third stretch of 16 beats is silent.
        const bool is_silent = static_cast<int>(at / 16.0) % 3 == 2;
        const double length = unit * dice.pick({1, 1, 2, 2, 3, 4});
        if (!is_silent && dice.chance(0.8)) {
            degree = std::clamp(degree + dice.whole(-3, 3), 0, 13);
            const int key = 60 + scale[static_cast<std::size_t>(degree % 7)] + 12 * (degree / 7);
            band.play_lead(at, 0.9 * length, key, dice.uniform(70.0, 105.0));
        }
        at += length;
    }
}

}  // namespace

void add_band(std::span<const BassLine> bass,
              std::span<const Comping> comping,
              Score& score,
              Dice& dice,
              const BandChances& chances) {
    constexpr std::array kAnyBass = {BassLine::eighths,
                                     BassLine::quarters,
                                     BassLine::octaves,
                                     BassLine::off_beat,
                                     BassLine::random_cell,
                                     BassLine::whole_bar,
                                     BassLine::walking,
                                     BassLine::root_fifth};
    constexpr std::array kAnyComping = {Comping::held,
                                        Comping::quarters,
                                        Comping::eighths,
                                        Comping::after_beats,
                                        Comping::arpeggio16,
                                        Comping::arpeggio8,
                                        Comping::random_cell};
    const BassLine line = dice.pick<BassLine>(bass.empty() ? std::span(kAnyBass) : bass);
    const Comping chords = dice.pick<Comping>(comping.empty() ? std::span(kAnyComping) : comping);
    const bool has_bass = dice.chance(chances.bass);
    const bool has_chords = dice.chance(chances.chords);
    const bool has_lead = dice.chance(chances.lead);
    // The order of the draws is part of the result: the same dice give the same band.
    Band band(score, dice);
    const int bar_beats = band.beats() > 0 ? band.beats_in_bar(0) : 4;
    // A random cell is drawn once a piece: a rhythm that repeats is what makes it a style.
    const std::vector<bool> bass_cell = random_cell(bar_beats, true, dice);
    const std::vector<bool> chord_cell = random_cell(bar_beats, false, dice);
    for (int beat = 0; beat < band.beats(); ++beat) {
        if (band.position(beat) != 1) {
            continue;
        }
        const int in_bar = band.beats_in_bar(beat);
        if (has_bass) {
            play_bass_bar(line, bass_cell, beat, in_bar, band);
        }
        if (has_chords) {
            play_comping_bar(chords, chord_cell, beat, in_bar, band);
        }
    }
    if (has_lead) {
        play_lead(band);
    }
}

}  // namespace raks::audio
