#include "audio/music/score/arrangement.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "audio/music/score/band.hpp"

namespace raks::audio {
namespace {

// Drum tracks out of the styles' rows.

/// MIDI velocity of a step's letter; 0 plays nothing.
double velocity_of(char step) {
    switch (step) {
        case 'X':
            return 112.0;
        case 'x':
            return 86.0;
        case 'o':
            return 52.0;
        default:
            return 0.0;
    }
}

/// One of the variants of a pattern, which are parted by '|'.
std::string draw_variant(std::string_view pattern, Dice& dice) {
    std::vector<std::string> variants;
    while (true) {
        const std::size_t bar = pattern.find('|');
        variants.emplace_back(pattern.substr(0, bar));
        if (bar == std::string_view::npos) {
            return dice.pick<std::string>(variants);
        }
        pattern.remove_prefix(bar + 1);
    }
}

/// Changes about one step in twelve, so that training pieces are not exact copies of a pattern.
void vary(std::string& row, Dice& dice) {
    for (char& step : row) {
        if (dice.chance(0.08)) {
            step = step == '.' ? 'o' : dice.pick({'.', 'x', step});
        }
    }
}

// What one drum plays over the cell: a letter a step.
struct Row {
    int key = 36;
    double level = 1.0;
    std::string steps;
};

/// The drums of a piece. Drawn again until at least two play, where the style has two.
std::vector<Row> draw_rows(const RhythmStyle& style, Dice& dice) {
    const bool is_varied = dice.chance(0.35);
    std::vector<Row> rows;
    while (rows.size() < 2 && rows.size() < style.lanes.size()) {
        rows.clear();
        for (const DrumLane& lane : style.lanes) {
            // Any drum may be missing, also one whose chance is 1: a model must not rely on one of
            // them.
            if (!dice.chance(lane.chance) || dice.chance(0.08)) {
                continue;
            }
            rows.push_back({lane.key, dice.uniform(0.6, 1.15), draw_variant(lane.pattern, dice)});
            if (is_varied) {
                vary(rows.back().steps, dice);
            }
        }
    }
    return rows;
}

/// Four sixteenths of one drum on the last beat of a phrase, and perhaps a crash after them.
void add_fill(int from_beat, Score& score, Dice& dice) {
    const int key = dice.pick({38, 45, 43, 47, 63, 65});
    for (int step = 0; step < 4; ++step) {
        if (dice.chance(0.75)) {
            const double beat = from_beat + 0.25 * step;
            score.notes.push_back({beat, 0.2, kDrumChannel, key, 0, dice.uniform(70.0, 110.0)});
        }
    }
    if (dice.chance(0.5)) {
        score.notes.push_back({from_beat + 1.0, 1.0, kDrumChannel, 49, 0, 90.0});
    }
}

/// Fills before some of the phrases of four bars; how often is drawn for the piece.
void add_fills(int beats, int beats_per_bar, Score& score, Dice& dice) {
    const int phrase = 4 * beats_per_bar;
    const double chance = dice.uniform(0.0, 0.7);
    for (int beat = phrase; beat < beats; beat += phrase) {
        if (dice.chance(chance)) {
            add_fill(beat - 1, score, dice);
        }
    }
}

/// A score without notes whose beats are numbered from a downbeat on.
Score empty_score(int beats, int beats_per_bar) {
    Score score;
    for (int beat = 0; beat < beats; ++beat) {
        score.bar_position.push_back(beat % beats_per_bar + 1);
    }
    return score;
}

/// Repeats every row over the whole score.
void play_rows(
    const std::vector<Row>& rows, int steps_per_beat, int beats, Score& score, Dice& dice) {
    // Swing in some pieces: every second sixteenth comes late, by up to 0.12 beats.
    const double swing = dice.chance(0.2) && steps_per_beat == 4 ? dice.uniform(0.0, 0.12) : 0.0;
    const int kit = dice.pick({0, 0, 0, 8, 16, 24, 25, 32, 40});
    for (const Row& row : rows) {
        const auto length = static_cast<int>(row.steps.size());
        for (int step = 0; step < beats * steps_per_beat; ++step) {
            const double velocity =
                velocity_of(row.steps[static_cast<std::size_t>(step % length)]) * row.level;
            if (velocity > 0.0) {
                const double late = step % 2 == 1 ? swing : 0.0;
                score.notes.push_back({static_cast<double>(step) / steps_per_beat + late,
                                       0.2,
                                       kDrumChannel,
                                       row.key,
                                       kit,
                                       velocity});
            }
        }
    }
}

}  // namespace

Score drum_score(const RhythmStyle& style, int beats, Dice& dice) {
    Score score = empty_score(beats, style.beats_per_bar);
    score.lowest_bpm = style.lowest_bpm;
    score.highest_bpm = style.highest_bpm;
    play_rows(draw_rows(style, dice), style.steps_per_beat, beats, score, dice);
    // Fills are in sixteenths and would clash with triplets.
    if (style.steps_per_beat != 3) {
        add_fills(beats, style.beats_per_bar, score, dice);
    }
    return score;
}

Score free_drum_score(int beats, Dice& dice) {
    const int beats_per_bar = dice.pick({4, 4, 4, 3, 2});
    const int steps_per_beat = dice.pick({4, 4, 2, 3});
    Score score = empty_score(beats, beats_per_bar);
    score.lowest_bpm = 58.0;
    // Eighths alone can go faster than sixteenths.
    score.highest_bpm = steps_per_beat == 2 ? 215.0 : 170.0;
    constexpr std::array kKeys = {36, 36, 38, 37, 39, 42, 46, 51, 45, 43, 41, 56, 60,
                                  61, 62, 63, 64, 65, 67, 69, 70, 75, 76, 82, 54};
    const int instruments = dice.whole(2, 6);
    std::vector<Row> rows;
    for (int i = 0; i < instruments; ++i) {
        const double density = dice.uniform(0.1, 0.5);
        const double metre = dice.uniform(0.3, 1.0);  // how much the beat counts
        Row row{dice.pick<int>(kKeys), dice.uniform(0.6, 1.1), {}};
        for (int step = 0; step < beats_per_bar * steps_per_beat; ++step) {
            // Downbeat, beat and what is between them: a metre is felt, though mildly.
            const double weight = step == 0 ? 1.9 : step % steps_per_beat == 0 ? 1.4 : 0.75;
            const double chance = density * (1.0 - metre + metre * weight);
            row.steps.push_back(dice.chance(chance) ? dice.pick({'X', 'x', 'x', 'o'}) : '.');
        }
        rows.push_back(std::move(row));
    }
    play_rows(rows, steps_per_beat, beats, score, dice);
    return score;
}

namespace {

// Chance that the music of a dance is complete: no missing player and no break.
constexpr double kComplete = 0.8;
constexpr int kBandLead = 2;  // the channel that add_band writes its melody on
constexpr int kMelody = kMelodyChannel;
// Channels that follow the band's three: the voice after the melody, then drone or guitar.
constexpr int kSecond = 4;
constexpr int kDrone = 5;

/// Degrees of an octave, quarter tones above the tonic.
using Scale = std::array<int, 7>;
constexpr int kOctave = 24;
constexpr std::array<Scale, 5> kMaqamat = {{
    {0, 2, 8, 10, 14, 16, 20},  // hijaz
    {0, 2, 8, 10, 14, 16, 22},  // hijazkar
    {0, 4, 6, 10, 14, 16, 22},  // nahawand
    {0, 2, 6, 10, 14, 16, 20},  // kurd
    {0, 4, 6, 12, 14, 18, 20},  // nikriz
}};
constexpr std::array<Scale, 5> kQuarterToneMaqamat = {{
    {0, 4, 7, 10, 14, 18, 21},  // rast
    {0, 3, 6, 10, 14, 16, 20},  // bayati
    {0, 3, 7, 11, 14, 17, 21},  // sikah
    {0, 3, 6, 8, 14, 16, 20},   // saba
    {0, 3, 7, 9, 15, 17, 21},   // huzam
}};
// Major, natural minor and dorian, in quarter tones like the others.
constexpr std::array<Scale, 3> kWesternScales = {{
    {0, 4, 8, 10, 14, 18, 22},
    {0, 4, 6, 10, 14, 16, 20},
    {0, 4, 6, 10, 14, 18, 20},
}};

/// How a melody moves.
struct Manner {
    std::vector<double> lengths;  ///< of notes, beats; one is drawn each
    double early = 0.0;           ///< beats that phrases come ahead of the beat
    int leap = 2;                 ///< scale steps at most
    double rest = 0.2;            ///< chance of a rest in a note's place
    double grace = 0.0;           ///< chance of a quick neighbour before a note
    int voices = 1;               ///< together, a third apart
    double phrase = 8.0;          ///< beats, then a rest
};

/// The manner behind a palette's word; parts of it are drawn anew for each piece.
Manner manner_of(Melody melody, Dice& dice) {
    switch (melody) {
        case Melody::riffs_ahead:
            return {.lengths = {0.5, 0.5, 1.0, 1.5},
                    .early = dice.pick({0.0, 0.5, 0.5}),
                    .leap = 3,
                    .rest = 0.4,
                    .voices = dice.whole(1, 3),
                    .phrase = dice.pick({4.0, 8.0})};
        case Melody::maqam:
            return {.lengths = dice.chance(0.5) ? std::vector{0.5, 0.5, 0.25, 1.0}
                                                : std::vector{0.5, 1.0, 2.0, 3.0, 0.25},
                    .leap = 1 + dice.whole(0, 1),
                    .rest = 0.08,
                    .grace = dice.uniform(0.1, 0.5),
                    .phrase = dice.pick({8.0, 16.0})};
        case Melody::sixteenth_riffs:
            return {.lengths = {0.25, 0.25, 0.5, 0.75}, .leap = 4, .rest = 0.35, .phrase = 16.0};
        case Melody::fifths:
            return {.lengths = {0.5, 0.5, 1.0, 2.0}, .leap = 2, .rest = 0.2, .voices = 1};
        case Melody::long_notes:
            return {.lengths = {1.0, 1.0, 2.0, 3.0, 0.5}, .leap = 2, .rest = 0.08, .phrase = 12.0};
        case Melody::any:
            break;
    }
    return {.lengths = {0.25, 0.5, 0.5, 1.0, 2.0}, .leap = 3, .rest = 0.3};
}

/// Writes the notes of one voice over the whole score.
class MelodyWriter {
 public:
    MelodyWriter(Score& score, const Scale& scale, int tonic, Dice& dice)
        : score_(score), scale_(scale), tonic_(tonic), dice_(dice) {}

    /// A random walk over the degrees of the scale, with rests, grace notes and a second voice.
    void write(const Manner& manner, const BandPalette& palette) {
        program_ = dice_.pick<int>(palette.leads);
        second_program_ = dice_.pick<int>(palette.leads);
        const double last = static_cast<double>(score_.bar_position.size()) - 1.0;
        const double level = dice_.uniform(70.0, 112.0);
        const double late = dice_.uniform(0.0, 0.06);  // of the second voice, beats
        const bool is_followed = dice_.chance(0.45);
        // The tonic in the middle of two octaves.
        int degree = 7;
        for (double at = 0.0; at < last;) {
            const double length = dice_.pick<double>(manner.lengths);
            // Two of three phrases play; the third mostly rests.
            const bool is_pause =
                static_cast<int>(at / manner.phrase) % 3 == 2 && dice_.chance(0.7);
            if (!is_pause && !dice_.chance(manner.rest)) {
                degree = std::clamp(degree + dice_.whole(-manner.leap, manner.leap), 1, 13);
                const double begin = std::max(0.0, at - manner.early);
                // A grace note is the step above, just before the note.
                if (dice_.chance(manner.grace)) {
                    add(kMelody,
                        program_,
                        std::max(0.0, begin - 0.12),
                        0.1,
                        degree + 1,
                        0.8 * level);
                }
                for (int voice = 0; voice < manner.voices; ++voice) {
                    add(kMelody, program_, begin, 0.9 * length, degree - 2 * voice, level);
                }
                // Heterophony: another instrument plays the same melody a little later.
                if (is_followed) {
                    add(kSecond, second_program_, begin + late, 0.8 * length, degree, 0.8 * level);
                }
            }
            at += length;
        }
    }

    /// A drone: the tonic and its fifth, held below everything.
    void drone(const BandPalette& palette) {
        const int program = dice_.pick<int>(palette.chords);
        // Beats that the tonic is held before it is struck again.
        const double bar = dice_.pick({4.0, 8.0, 16.0});
        for (double at = 0.0; at < static_cast<double>(score_.bar_position.size()); at += bar) {
            note(kDrone, program, at, bar, 36 + tonic_, 70.0);
            note(kDrone, program, at, bar, 43 + tonic_, 60.0);
        }
    }

    /// Root and fifth of a bar's chord in eighths: what a rock guitar plays.
    void fifths(const BandPalette& palette) {
        const int program = dice_.pick<int>(palette.chords);
        const double step = dice_.pick({0.5, 0.5, 1.0, 4.0});
        int root = 0;
        for (double at = 0.0; at < static_cast<double>(score_.bar_position.size()); at += step) {
            // The root changes on downbeats only, and not on all of them.
            if (score_.bar_position[static_cast<std::size_t>(at)] == 1 && dice_.chance(0.5)) {
                root = scale_[static_cast<std::size_t>(dice_.whole(0, 6))] / 2;
            }
            note(kDrone, program, at, 0.9 * step, 40 + (tonic_ + root) % 12, 95.0);
            note(kDrone, program, at, 0.9 * step, 47 + (tonic_ + root) % 12, 90.0);
        }
    }

 private:
    void add(int channel, int program, double at, double length, int degree, double velocity) {
        // Voices below the melody may fall under the scale's first degree: they stay on it.
        const int inside = std::max(degree, 0);
        const int quarters = scale_[static_cast<std::size_t>(inside % 7)] + kOctave * (inside / 7);
        note(channel, program, at, length, 55 + tonic_ + quarters / 2, velocity);
        // MIDI keys are semitones; an odd number of quarter tones is the key below, 50 cents up.
        score_.notes.back().cents = 50.0 * (quarters % 2);
    }
    void note(int channel, int program, double at, double length, int key, double velocity) {
        score_.notes.push_back({at, length, channel, key, program, velocity, 0.0});
    }

    Score& score_;
    Scale scale_;
    int tonic_;
    Dice& dice_;
    int program_ = 0;
    int second_program_ = 0;
};

/// Replaces the instruments of drums and band by some drawn from the palette.
void reinstrument(const BandPalette& palette, Score& score, Dice& dice) {
    const std::array<int, 3> programs = {dice.pick<int>(palette.bass),
                                         dice.pick<int>(palette.chords),
                                         dice.pick<int>(palette.leads)};
    const int kit = dice.pick<int>(palette.kits);
    for (ScoreNote& note : score.notes) {
        if (note.channel == kDrumChannel) {
            note.program = kit;
        } else if (note.channel <= kBandLead) {
            note.program = programs[static_cast<std::size_t>(note.channel)];
        }
    }
}

/// Takes out all notes of one channel.
void remove_channel(int channel, Score& score) {
    std::erase_if(score.notes,
                  [channel](const ScoreNote& note) { return note.channel == channel; });
}

}  // namespace

Score arrange(
    const StyleBook& book, const RhythmStyle& style, int beats, Dice& dice, OrientalScales scales) {
    Score score = drum_score(style, beats, dice);
    const std::string_view dance = style.label ? std::string_view(style.label->dance) : "";
    // Mostly no player of a dance's music is missing or pauses: what a break leaves could be music
    // for any other dance as well.
    score.is_complete = !dance.empty() && dice.chance(kComplete);
    const BandPalette& palette = book.palette_of(dance);
    if (dice.chance(palette.band_chance)) {
        add_band(style.bass, style.comping, score, dice, palette.players);
    }
    reinstrument(palette, score, dice);
    // Drawn for each piece, whatever key the band plays in.
    const int tonic = dice.whole(0, 11);
    const bool is_maqam = palette.melody == Melody::maqam;
    const bool has_quarters =
        is_maqam && scales == OrientalScales::quarter_tones && dice.chance(0.6);
    const Scale& scale = has_quarters ? dice.pick<Scale>(kQuarterToneMaqamat)
                         : is_maqam   ? dice.pick<Scale>(kMaqamat)
                                      : dice.pick<Scale>(kWesternScales);
    MelodyWriter melody(score, scale, tonic, dice);
    if (dice.chance(palette.lead_chance)) {
        // The palette's melody replaces the band's own.
        remove_channel(kBandLead, score);
        melody.write(manner_of(palette.melody, dice), palette);
    }
    // Chords have semitones only, so they give way to the drone where the scale has quarter tones.
    if (is_maqam && (dice.chance(0.5) || has_quarters)) {
        remove_channel(1, score);  // no chords: the drone is all harmony there is
        melody.drone(palette);
    }
    if (palette.melody == Melody::fifths && dice.chance(0.85)) {
        melody.fifths(palette);
    }
    if (palette.drumless_chance > 0.0 && dice.chance(palette.drumless_chance)) {
        remove_channel(kDrumChannel, score);
    }
    return score;
}

}  // namespace raks::audio
