#include "audio/music/score/other_music.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/keyboard_scores.hpp"
#include "audio/music/score/non_music.hpp"
#include "audio/music/score/performance.hpp"

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

}  // namespace raks::audio
