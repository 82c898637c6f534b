#pragma once

#include <string>
#include <vector>

#include "audio/music/score/performance.hpp"
#include "base/dice.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

inline constexpr int kWrittenBeats = 96;

/// A piece before it sounds.
struct WrittenPiece {
    std::string name;
    Genre genre = Genre::unknown;
    Performance performance;
    std::vector<float> samples;  ///< of what no soundfont plays; empty: it is performed
};

/// Music to no dance of ours, and what is no music: half of it in rhythms of other dances.
[[nodiscard]] WrittenPiece other_piece(double seconds, Dice& dice);

/// What has no beat to dance to: people, applause, notes without a pulse, pads, one voice, an
/// orchestra in a free tempo.
[[nodiscard]] WrittenPiece undanceable_piece(double seconds, Dice& dice);

}  // namespace raks::audio
