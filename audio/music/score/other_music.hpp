#pragma once

#include <string>
#include <vector>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Beats that a piece is written for; it is performed as far as its seconds reach.
inline constexpr int kWrittenBeats = 96;

/// A piece as written, before it is synthesized.
struct WrittenPiece {
    /// Of the kind of music: a rhythm's name, "piano", "people", ...
    std::string name;
    std::string dance;  ///< that it is music for; empty: none of them
    /// What is to be played; empty where there are `samples`.
    Performance performance;
    std::vector<float> samples;  ///< of what no soundfont plays; empty: it is performed
};

/// Music for none of the book's dances, or no music; more than half in rhythms of the book that are
/// for no dance, of which it must have at least one.
[[nodiscard]] WrittenPiece other_piece(const StyleBook& book, double seconds, Dice& dice);

/// What has no beat to dance to: people, applause, notes without a pulse, pads, one voice, an
/// orchestra in a free tempo, which plays a rhythm of the book that is for no dance.
[[nodiscard]] WrittenPiece undanceable_piece(const StyleBook& book, double seconds, Dice& dice);

/// Sound that nobody dances to, mono at `rate`, `seconds` long: applause, talk, or noise that
/// swells.
[[nodiscard]] std::vector<float> noise_of_people(int rate, double seconds, Dice& dice);

/// Notes of drums or of one instrument at random times, without a pulse; `beats` is empty.
[[nodiscard]] Performance notes_without_pulse(double seconds, Dice& dice);

}  // namespace raks::audio
