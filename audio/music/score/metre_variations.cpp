#include "audio/music/score/metre_variations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace raks::audio {
namespace {

constexpr double kThird = 1.0 / 3.0;

double part_of_beat(double beat) { return beat - std::floor(beat); }

// Of General MIDI's percussion: hi-hats, rides, shakers, tambourine.
bool is_cymbal(const ScoreNote& note) {
    constexpr std::array kKeys = {42, 44, 46, 51, 53, 54, 59, 69, 70, 82};
    return note.channel == kDrumChannel &&
           std::find(kKeys.begin(), kKeys.end(), note.key) != kKeys.end();
}

// A player is a drum, or all notes of another channel.
int player_of(const ScoreNote& note) {
    return note.channel == kDrumChannel ? 100 + note.key : note.channel;
}

// Where one player puts the quarters of a straight beat; negative: the note is left out.
using PartMap = std::array<double, 4>;

PartMap draw_part_map(Dice& dice) {
    constexpr double kOut = -1.0;
    return dice.pick<PartMap>(std::array<PartMap, 4>{{{0.0, kThird, 2 * kThird, kOut},
                                                      {0.0, kOut, 2 * kThird, kOut},
                                                      {0.0, kOut, kThird, 2 * kThird},
                                                      {0.0, kThird, kOut, 2 * kThird}}});
}

// One voice that plays all parts of all beats.
void add_running_voice(int parts, Score& score, Dice& dice) {
    const int beats = static_cast<int>(score.bar_position.size());
    const bool is_drum = score.has_drums || dice.chance(0.2);
    const int key = is_drum ? dice.pick({42, 42, 51, 70, 54, 69, 39}) : 0;
    const int program = dice.pick({0, 0, 4, 6, 11, 16, 24, 25, 26, 45, 46, 48, 73, 80});
    const double level = dice.uniform(45.0, 90.0);
    const double accent = dice.uniform(0.0, 25.0);
    constexpr std::array kTones = {0, 4, 7, 12, 7, 4};
    const int root = dice.whole(52, 64);
    for (int step = 0; step < beats * parts; ++step) {
        const double at = static_cast<double>(step) / parts;
        const double velocity = level + (step % parts == 0 ? accent : 0.0);
        const int tone = kTones[static_cast<std::size_t>(step) % kTones.size()];
        score.notes.push_back(is_drum
                                  ? ScoreNote{at, 0.2, kDrumChannel, key, 0, velocity}
                                  : ScoreNote{at, 0.9 / parts, 4, root + tone, program, velocity});
    }
}

}  // namespace

// Notes off the quarters keep a share of their distance: they are played freely.
void make_compound(Score& score, Dice& dice) {
    std::map<int, PartMap> maps;
    std::vector<ScoreNote> kept;
    for (ScoreNote note : score.notes) {
        const auto [found, is_new] = maps.try_emplace(player_of(note));
        if (is_new) {
            found->second = draw_part_map(dice);
        }
        const double beat = std::floor(note.beat + 0.125);
        const double quarters = 4.0 * (note.beat - beat);
        const auto nearest = static_cast<std::size_t>(std::clamp(std::lround(quarters), 0L, 3L));
        const double part = found->second[nearest];
        if (part >= 0.0) {
            note.beat =
                std::max(0.0, beat + part + 0.1 * (quarters - static_cast<double>(nearest)));
            kept.push_back(note);
        }
    }
    score.notes = std::move(kept);
    if (dice.chance(0.7)) {
        add_running_voice(3, score, dice);
    }
    score.lowest_bpm = std::max(40.0, 0.55 * score.lowest_bpm);
    score.highest_bpm = std::clamp(0.8 * score.highest_bpm, score.lowest_bpm + 10.0, 160.0);
}

void add_triplet_hats(Score& score, Dice& dice) {
    std::erase_if(score.notes, is_cymbal);
    const int beats = static_cast<int>(score.bar_position.size());
    const double share = dice.pick({1.0, 1.0, 0.6, 0.4});  // of the half bars
    const int parts = dice.pick({3, 3, 6});
    const int key = dice.pick({42, 42, 44, 70, 54});
    const double level = dice.uniform(50.0, 95.0);
    bool is_triplet = true;
    for (int beat = 0; beat < beats; ++beat) {
        is_triplet = beat % 2 == 0 ? dice.chance(share) : is_triplet;
        const int steps = is_triplet ? parts : 2;
        for (int step = 0; step < steps; ++step) {
            score.notes.push_back({beat + static_cast<double>(step) / steps,
                                   0.15,
                                   kDrumChannel,
                                   key,
                                   0,
                                   level * (step == 0 ? 1.1 : 0.9)});
        }
    }
    score.lowest_bpm = std::max(50.0, 0.7 * score.lowest_bpm);
    score.highest_bpm = std::clamp(score.highest_bpm, score.lowest_bpm + 10.0, 150.0);
    score.has_drums = true;
}

void swing_sixteenths(Score& score, Dice& dice) {
    const double late = dice.uniform(0.03, 1.0 / 12.0 + 0.01);
    for (ScoreNote& note : score.notes) {
        const double part = part_of_beat(note.beat);
        const bool is_swung = std::abs(part - 0.25) < 0.04 || std::abs(part - 0.75) < 0.04;
        note.beat += is_swung ? late : 0.0;
    }
    score.highest_bpm = std::clamp(score.highest_bpm, score.lowest_bpm + 5.0, 125.0);
}

void press_off_beats(Score& score, Dice& dice) {
    const double on = dice.uniform(0.35, 0.8);
    const double off = dice.uniform(1.1, 1.5);
    const double kick = dice.uniform(0.3, 0.9);
    for (ScoreNote& note : score.notes) {
        const double part = part_of_beat(note.beat + 0.05) - 0.05;
        const bool is_kick = note.channel == kDrumChannel && (note.key == 35 || note.key == 36);
        note.velocity *= is_kick                       ? kick
                         : std::abs(part) < 0.05       ? on
                         : std::abs(part - 0.5) < 0.05 ? off
                                                       : 1.0;
    }
}

void slow_down(Score& score, Dice& dice) {
    score.lowest_bpm = dice.uniform(42.0, 60.0);
    score.highest_bpm = score.lowest_bpm + 15.0;
}

void give_to_strings(Score& score, Dice& dice) {
    std::erase_if(score.notes, [](const ScoreNote& note) { return note.channel == kDrumChannel; });
    std::array<int, 16> programs{};
    for (int& program : programs) {
        program = dice.pick({40, 41, 42, 43, 44, 45, 48, 48, 49, 50, 52, 19, 60, 68, 71});
    }
    for (ScoreNote& note : score.notes) {
        note.program = programs[static_cast<std::size_t>(note.channel)];
        note.length = std::max(note.length, dice.uniform(0.4, 0.95));
    }
    score.has_drums = false;
}

void add_claps(Score& score, Dice& dice) {
    if (dice.chance(0.25)) {
        score.notes.clear();
    }
    const int beats = static_cast<int>(score.bar_position.size());
    const int hands = dice.pick({1, 2, 6, 12, 20});
    const double spread = hands == 1 ? 0.004 : dice.uniform(0.01, 0.045);  // beats
    const int every = score.notes.empty() ? 1 : dice.pick({1, 2, 2});
    const double level = dice.uniform(40.0, 100.0) / std::sqrt(hands);
    for (int beat = every - 1; beat < beats; beat += every) {
        for (int hand = 0; hand < hands; ++hand) {
            score.notes.push_back({std::max(0.0, beat + dice.normal(spread)),
                                   0.1,
                                   kDrumChannel,
                                   39,
                                   0,
                                   level * dice.uniform(0.8, 1.2)});
        }
    }
    score.has_drums = true;
    score.lowest_bpm = std::max(44.0, 0.8 * score.lowest_bpm);
    score.highest_bpm = std::clamp(score.highest_bpm, score.lowest_bpm + 10.0, 150.0);
}

namespace {

// Groups of two and three eighths, in an order that is usual.
std::vector<int> draw_groups(Dice& dice) {
    const std::array<std::vector<int>, 10> kMetres = {{{2, 3},
                                                       {3, 2},
                                                       {2, 2, 3},
                                                       {3, 2, 2},
                                                       {2, 3, 2},
                                                       {3, 3, 2},
                                                       {2, 2, 2, 3},
                                                       {3, 2, 2, 3},
                                                       {2, 2, 3, 2, 2},
                                                       {3, 3, 2, 3}}};
    return dice.pick<std::vector<int>>(kMetres);
}

// Which drum plays where in the bar: on the first group, on the others, and between.
struct AdditiveDrums {
    int first = 36;
    int group = 38;
    int between = 42;
    double between_level = 60.0;
};

// One eighth: a drum and a note of the tune. `drum`: the key; `is_start`: of a group.
void play_eighth(
    double at, bool is_start, int drum, double level, int root, Score& score, Dice& dice) {
    if (score.has_drums && (is_start || dice.chance(0.85))) {
        score.notes.push_back({at, 0.3, kDrumChannel, drum, 0, level});
    }
    if (dice.chance(is_start ? 0.9 : 0.55)) {
        constexpr std::array kTones = {12, 14, 15, 17, 19, 20, 22, 24};
        const int tone = root + 12 + dice.pick<int>(kTones);
        score.notes.push_back({at, 0.8, 2, tone, 0, dice.uniform(60.0, 95.0)});
    }
}

void play_additive_bar(int at,
                       const std::vector<int>& groups,
                       const AdditiveDrums& drums,
                       int root,
                       Score& score,
                       Dice& dice) {
    for (std::size_t group = 0; group < groups.size(); ++group) {
        const double begin = at;
        const int first = group == 0 ? drums.first : drums.group;
        play_eighth(at++, true, first, 95.0, root, score, dice);
        for (int step = 1; step < groups[group]; ++step) {
            play_eighth(at++, false, drums.between, drums.between_level, root, score, dice);
        }
        for (const int tone : {0, 12, 19}) {
            score.notes.push_back(
                {begin, 0.9 * groups[group], tone == 0 ? 0 : 1, root + tone, 0, 80.0});
        }
    }
}

}  // namespace

Score additive_score(int eighths, Dice& dice) {
    const std::vector<int> groups = draw_groups(dice);
    const AdditiveDrums drums{dice.pick({36, 64, 41}),
                              dice.pick({38, 36, 63, 37}),
                              dice.pick({42, 51, 62, 70, 56}),
                              dice.uniform(30.0, 75.0)};
    Score score;
    score.has_drums = dice.chance(0.75);
    score.lowest_bpm = 150.0;  // of eighths
    score.highest_bpm = 330.0;
    const int program = dice.pick({0, 6, 21, 24, 25, 27, 29, 46, 104});
    const int key = dice.whole(33, 43);
    while (static_cast<int>(score.bar_position.size()) < eighths) {
        const int at = static_cast<int>(score.bar_position.size());
        const int root = key + dice.pick({0, 0, 5, 7, -2});
        play_additive_bar(at, groups, drums, root, score, dice);
        for (std::size_t group = 0; group < groups.size(); ++group) {
            score.bar_position.push_back(static_cast<int>(group) + 1);
            score.beat_parts.push_back(groups[group]);
            for (int step = 1; step < groups[group]; ++step) {
                score.bar_position.push_back(Score::kNoBeat);
                score.beat_parts.push_back(groups[group]);
            }
        }
    }
    for (ScoreNote& note : score.notes) {
        note.program = note.channel == kDrumChannel ? 0 : program;
    }
    return score;
}

int parts_of(const Score& score) {
    constexpr double kNear = 0.045;
    int thirds = 0;
    int quarters = 0;
    for (const ScoreNote& note : score.notes) {
        const double part = part_of_beat(note.beat);
        const auto is_at = [part](double place) { return std::abs(part - place) < kNear; };
        thirds += is_at(kThird) || is_at(2 * kThird) ? 1 : 0;
        quarters += is_at(0.25) || is_at(0.5) || is_at(0.75) ? 1 : 0;
    }
    return thirds > quarters ? 3 : 2;
}

}  // namespace raks::audio
