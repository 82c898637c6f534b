#include "audio/music/score/keyboard_scores.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raks::audio {
namespace {

constexpr int kRightHand = 0;
constexpr int kLeftHand = 1;

enum class Texture : char {
    figuration,  ///< one hand runs through, the other has slow notes (prelude, etude)
    two_voices,  ///< both hands have rhythms of their own (invention, fugue)
    alberti,     ///< low, high, middle, high under a melody (sonata)
    broken,      ///< chords up and down over two octaves under a melody (nocturne)
    bass_chord,  ///< a low note, then chords on the other beats (waltz, mazurka, march)
    chords       ///< four voices together (chorale)
};

/// What the piece is made of, drawn once.
struct KeyboardPiece {
    int beats_per_bar = 4;
    int parts = 4;  ///< of a beat that the runs have: 2, 3, 4 or 6
    Texture texture = Texture::alberti;
    int key = 0;
    std::array<int, 7> scale{};
    std::array<int, 4> degrees{};  ///< of the chords, one a bar
    double right_level = 80.0;
    double left_level = 65.0;
    double accent = 8.0;  ///< on beat 1, half of it on the others
    int program = 0;
};

/// Writes the notes of one piece bar by bar.
class Keyboard {
 public:
    Keyboard(const KeyboardPiece& piece, Score& score, Dice& dice)
        : piece_(piece), score_(score), dice_(dice) {}

    /// Bar by bar: the texture, and every two bars a line of the melody.
    void play() {
        // Two rhythms of two bars each: repetition gives the piece phrases.
        const std::vector<double> theme = draw_rhythm(2 * piece_.beats_per_bar);
        const std::vector<double> answer = draw_rhythm(2 * piece_.beats_per_bar);
        const int beats = static_cast<int>(score_.bar_position.size());
        const bool runs_above = dice_.chance(0.6);
        for (int bar = 0; bar * piece_.beats_per_bar < beats; ++bar) {
            const int at = bar * piece_.beats_per_bar;
            switch (piece_.texture) {
                case Texture::figuration:
                    play_run(at, runs_above ? kRightHand : kLeftHand);
                    play_slow(at, runs_above ? kLeftHand : kRightHand);
                    break;
                case Texture::chords:
                    play_chorale(at);
                    break;
                default:
                    play_accompaniment(at);
                    break;
            }
            const bool has_melody =
                piece_.texture != Texture::figuration && piece_.texture != Texture::chords;
            if (has_melody && bar % 2 == 0) {
                // Three times the theme, then the answer.
                play_melody(at, bar / 2 % 4 == 3 ? answer : theme, kRightHand);
                if (piece_.texture == Texture::two_voices) {
                    play_melody(at, bar / 2 % 2 == 0 ? answer : theme, kLeftHand);
                }
            }
        }
    }

 private:
    /// One note with the level of its hand, an accent on beats, and a little chance.
    void add(double beat, double length, int hand, int key, double softer = 0.0) {
        const double nearest = std::round(beat);
        double accent = 0.0;
        if (std::abs(beat - nearest) < 0.01) {
            const auto index = static_cast<int>(nearest);
            accent = index % piece_.beats_per_bar == 0 ? piece_.accent : 0.5 * piece_.accent;
        }
        const double level = hand == kRightHand ? piece_.right_level : piece_.left_level;
        score_.notes.push_back({beat,
                                length,
                                hand,
                                std::clamp(key, 24, 100),
                                piece_.program,
                                level + accent - softer + dice_.normal(5.0)});
    }
    /// Scale degree on which the chord of this bar stands.
    [[nodiscard]] int chord_degree(int beat) const {
        const int bar = beat / piece_.beats_per_bar;
        return piece_.degrees[static_cast<std::size_t>(bar % 4)];
    }
    /// The key of a degree of the scale, counted from the tonic, over `base`.
    [[nodiscard]] int key_of(int degree, int base) const {
        // Floor, not truncation: degrees below the tonic are negative.
        const int octave = static_cast<int>(std::floor(degree / 7.0));
        return base + piece_.key + piece_.scale[static_cast<std::size_t>(degree - 7 * octave)] +
               12 * octave;
    }

    /// Lengths that fill `beats`: now and then a held note, else beats halved and parted.
    std::vector<double> draw_rhythm(int beats) {
        std::vector<double> lengths;
        // How often beats are divided; slow pieces have more held and whole notes.
        const double speed = dice_.uniform(0.2, 0.9);
        for (double left = beats; left > 1e-6;) {
            if (left >= 2.0 && dice_.chance(0.25 * (1.0 - speed))) {
                lengths.push_back(2.0);
                left -= 2.0;
            } else if (left >= 2.0 && dice_.chance(0.2)) {  // dotted
                lengths.insert(lengths.end(), {1.5, 0.5});
                left -= 2.0;
            } else if (dice_.chance(speed)) {
                const int parts = dice_.chance(0.5) ? 2 : piece_.parts;
                const double each =
                    piece_.parts == 3 || piece_.parts == 6 ? 1.0 / 3.0 : 1.0 / parts;
                for (double sum = 0.0; sum < 1.0 - 1e-6; sum += each) {
                    lengths.push_back(each);
                }
                left -= 1.0;
            } else {
                lengths.push_back(1.0);
                left -= 1.0;
            }
        }
        return lengths;
    }

    /// A random walk over the scale in the given rhythm, from beat `first` on.
    void play_melody(int first, const std::vector<double>& rhythm, int hand) {
        double beat = first;
        const int base = hand == kRightHand ? 72 : 48;
        for (const double length : rhythm) {
            if (beat >= static_cast<double>(score_.bar_position.size())) {
                return;
            }
            if (dice_.chance(0.93)) {
                melody_ = std::clamp(melody_ + dice_.pick({-2, -1, -1, 0, 1, 1, 2, 4, -4}), -7, 9);
                add(beat, 0.95 * length, hand, key_of(melody_, base));
                if (length >= 1.0 && dice_.chance(0.15)) {  // a third or a sixth below
                    add(beat, 0.95 * length, hand, key_of(melody_ - dice_.pick({2, 5}), base), 8.0);
                }
            }
            beat += length;
        }
    }

    /// Steady fast notes over a bar: a scale that turns at random, or a broken chord.
    void play_run(int bar, int hand) {
        const int base = hand == kRightHand ? 66 : 48;
        const bool is_scale = dice_.chance(0.4);
        const int chord = chord_degree(bar);
        constexpr std::array kBroken = {0, 2, 4, 7, 9, 7, 4, 2};
        const int steps = piece_.beats_per_bar * piece_.parts;
        for (int step = 0; step < steps; ++step) {
            const double at = bar + static_cast<double>(step) / piece_.parts;
            run_ = std::clamp(run_ + dice_.pick({-1, 1, 1, -1, 2, -2}), -5, 9);
            const int degree =
                is_scale ? run_ : chord + kBroken[static_cast<std::size_t>(step % 8)];
            add(at, 1.0 / piece_.parts, hand, key_of(degree, base));
        }
    }

    /// Long notes against the run, on the chord's root or fifth.
    void play_slow(int bar, int hand) {
        const int base = hand == kRightHand ? 66 : 42;
        const double length =
            dice_.pick({1.0, 1.0, 2.0, static_cast<double>(piece_.beats_per_bar)});
        for (double at = 0.0; at < piece_.beats_per_bar; at += length) {
            add(bar + at,
                0.9 * length,
                hand,
                key_of(chord_degree(bar) + dice_.pick({0, 0, 4}), base));
        }
    }

    /// Four voices on every beat; in some beats two of them pass through an eighth.
    void play_chorale(int bar) {
        for (int beat = 0; beat < piece_.beats_per_bar; ++beat) {
            const int degree = chord_degree(bar) + dice_.pick({0, 0, 3, 4});
            const bool is_parted = dice_.chance(0.3);
            for (const int voice : {0, 2, 4, 7}) {
                const bool moves = is_parted && (voice == 2 || voice == 7);
                add(bar + beat,
                    moves ? 0.5 : 0.95,
                    voice < 3 ? kLeftHand : kRightHand,
                    key_of(degree + voice, 54));
                if (moves) {
                    add(bar + beat + 0.5,
                        0.45,
                        voice < 3 ? kLeftHand : kRightHand,
                        key_of(degree + voice + dice_.pick({-1, 1}), 54));
                }
            }
        }
    }

    /// A bass note on the strong beats, chords on the others.
    void play_bass_and_chords(int bar) {
        const int chord = chord_degree(bar);
        for (int beat = 0; beat < piece_.beats_per_bar; ++beat) {
            const bool is_bass = beat == 0 || (piece_.beats_per_bar == 4 && beat == 2);
            if (is_bass) {
                add(bar + beat, 0.9, kLeftHand, key_of(chord - 7 + (beat == 2 ? 4 : 0), 54));
                continue;
            }
            for (const int voice : {0, 2, 4}) {
                add(bar + beat, 0.6, kLeftHand, key_of(chord + voice, 54), 6.0);
            }
        }
    }

    /// The left hand under a melody.
    void play_accompaniment(int bar) {
        constexpr std::array kAlberti = {0, 4, 2, 4};
        constexpr std::array kBroken = {-7, 0, 2, 4, 7, 4, 2, 0};
        if (piece_.texture == Texture::bass_chord) {
            play_bass_and_chords(bar);
            return;
        }
        if (piece_.texture == Texture::two_voices) {
            return;  // the left hand has a melody of its own
        }
        const bool is_alberti = piece_.texture == Texture::alberti;
        // Accompaniments are not faster than four notes a beat, broken chords not faster than
        // three.
        const int parts = std::min(piece_.parts, is_alberti && piece_.parts != 3 ? 4 : 3);
        for (int step = 0; step < piece_.beats_per_bar * parts; ++step) {
            const int degree = is_alberti ? kAlberti[static_cast<std::size_t>(step % 4)]
                                          : kBroken[static_cast<std::size_t>(step % 8)];
            add(bar + static_cast<double>(step) / parts,
                0.95 / parts,
                kLeftHand,
                key_of(chord_degree(bar) + degree, 54));
        }
    }

    const KeyboardPiece& piece_;
    Score& score_;
    Dice& dice_;
    int melody_ = 2;
    int run_ = 0;
};

}  // namespace

Score keyboard_score(int beats, Dice& dice) {
    constexpr std::array<std::array<int, 7>, 2> kScales = {
        {{0, 2, 4, 5, 7, 9, 11}, {0, 2, 3, 5, 7, 8, 11}}};
    constexpr std::array<std::array<int, 4>, 5> kDegrees = {
        {{0, 3, 4, 0}, {0, 4, 5, 3}, {0, 5, 1, 4}, {0, 0, 4, 4}, {5, 1, 4, 0}}};
    KeyboardPiece piece;
    piece.beats_per_bar = dice.pick({4, 4, 4, 3, 3, 3, 2});
    piece.parts = dice.pick({2, 2, 4, 4, 4, 3, 6});
    piece.texture = dice.pick({Texture::figuration,
                               Texture::figuration,
                               Texture::two_voices,
                               Texture::two_voices,
                               Texture::alberti,
                               Texture::broken,
                               Texture::bass_chord,
                               Texture::chords});
    piece.key = dice.whole(-5, 6);
    piece.scale = kScales[static_cast<std::size_t>(dice.whole(0, 1))];
    piece.degrees = kDegrees[static_cast<std::size_t>(dice.whole(0, 4))];
    piece.right_level = dice.uniform(60.0, 95.0);
    piece.left_level = piece.right_level - dice.uniform(-3.0, 22.0);
    piece.accent = dice.uniform(0.0, 14.0);
    piece.program = dice.pick({0, 0, 0, 0, 0, 0, 1, 6});
    Score score;
    for (int beat = 0; beat < beats; ++beat) {
        score.bar_position.push_back(beat % piece.beats_per_bar + 1);
    }
    // Beats that hold many notes are slow, beats that hold few may be fast.
    score.lowest_bpm = piece.parts >= 4 ? 52.0 : 80.0;
    score.highest_bpm = piece.parts == 6 ? 80.0 : piece.parts == 4 ? 112.0 : 200.0;
    score.has_drums = false;
    score.is_expressive = true;
    Keyboard(piece, score, dice).play();
    return score;
}

}  // namespace raks::audio
