// Drum tracks out of the styles' rows.
#include <array>
#include <string>

#include "audio/music/score/drum_scores.hpp"

namespace raks::audio {
namespace {

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

}  // namespace raks::audio
