#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "audio/song/song_repeats.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// The bars of a piece as it was made.
struct TrueBars {
    std::vector<StreamTime> times;  ///< their first beats, ascending
    std::vector<char> begins_part;  ///< by bar: whether the music does another thing than before
    BarDistance distance;           ///< at most 1 between bars that are alike
};

/// The bars of a generated piece.
[[nodiscard]] TrueBars true_bars(const MusicTruth& music);

/// How well the bars of parts that come again were found.
struct RepeatScore {
    std::size_t wanted = 0;  ///< bars that repeat earlier ones, by find_repeats() over the truth
    std::size_t found = 0;   ///< of these, those that were told to repeat a bar that is alike
    std::size_t told = 0;    ///< bars that were told to repeat a bar
    std::size_t right = 0;   ///< of these, those whose bar is alike

    [[nodiscard]] double recall() const noexcept;     ///< found of wanted; 1 where none is
    [[nodiscard]] double precision() const noexcept;  ///< right of told; 1 where none is
    RepeatScore& operator+=(const RepeatScore& other) noexcept;  ///< of more pieces
};

/// Scores the repeats that the states of a song tell (Foresight::bar, repeats). A bar that was told
/// stands for the true one in which its middle lies. Threads: any. Real-time: no.
[[nodiscard]] RepeatScore score_repeats(const TrueBars& truth, std::span<const MusicState> states);

}  // namespace raks::audio
