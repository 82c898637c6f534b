#pragma once

#include <string>
#include <vector>

#include "audio/music/score/performance.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dice.hpp"

namespace raks::audio {

inline constexpr int kWrittenBeats = 96;

/// A piece before it sounds.
struct WrittenPiece {
    std::string name;
    std::string dance;  ///< that it is music for; empty: none of them
    Performance performance;
    std::vector<float> samples;  ///< of what no soundfont plays; empty: it is performed
};

/// Music for none of the book's dances, and what is no music: half of it in rhythms of the book
/// that are for none; it has one at least.
[[nodiscard]] WrittenPiece other_piece(const StyleBook& book, double seconds, Dice& dice);

/// What has no beat to dance to: people, applause, notes without a pulse, pads, one voice, an
/// orchestra in a free tempo, which plays a rhythm of the book that is for no dance.
[[nodiscard]] WrittenPiece undanceable_piece(const StyleBook& book, double seconds, Dice& dice);

}  // namespace raks::audio
