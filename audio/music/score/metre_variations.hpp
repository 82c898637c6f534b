#pragma once

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

/// Music whose metre is easily misheard, made from scores that are played straight: so that no
/// timbre and no rhythm tells the metre by itself.
namespace raks::audio {

/// The compound twin of a score: each beat has three parts instead of two or four, the notes go to
/// the parts that are next to their places, and mostly one voice plays all three. (6/8, 12/8,
/// shuffle)
void make_compound(Score& score, Dice& dice);

/// Hi-hats in triplets instead of what the cymbals played, now and then or always; the rest stays
/// straight. (trap, half-time shuffle over a straight backbeat)
void add_triplet_hats(Score& score, Dice& dice);

/// The second and fourth sixteenth of each beat come late, up to a triplet's place.
void swing_sixteenths(Score& score, Dice& dice);

/// What lies half way between beats becomes louder than the beats, and the bass drum soft. (ska,
/// reggae)
void press_off_beats(Score& score, Dice& dice);

/// A tempo of 42 to 75 beats a minute. (ballads, soul)
void slow_down(Score& score, Dice& dice);

/// The drums leave, and bowed strings, choirs or organs play the rest.
void give_to_strings(Score& score, Dice& dice);

/// An audience claps along, on every beat or on every second one, each pair of hands at its own
/// time; sometimes it is all that is heard.
void add_claps(Score& score, Dice& dice);

/// A piece in an additive metre of 5 to 11 eighths: its beats are groups of two and of three
/// eighths. (7/8, 9/8, 10/8)
[[nodiscard]] Score additive_score(int eighths, Dice& dice);

/// Into how many parts the notes divide the beats: 3 where more lie at thirds of a beat than at its
/// half and its quarters, else 2.
[[nodiscard]] int parts_of(const Score& score);

}  // namespace raks::audio
