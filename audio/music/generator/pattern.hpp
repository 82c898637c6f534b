#pragma once

#include <string_view>

#include "audio/music/generator/notes.hpp"

/// Helpers of those who write scores.
namespace raks::audio {

/// Adds one note for each letter of `pattern`, from beat `start` on, `step` beats apart: 'X' loud,
/// 'x' medium, 'o' soft, anything else a rest. `level`: factor of the velocities.
///
///     strike(score, Sound::clave, "x..x..x...x.x...", bar_start, 0.5);
inline void strike(Notes& score,
                   Sound sound,
                   std::string_view pattern,
                   double start,
                   double step,
                   double level = 1.0) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char mark = pattern[i];
        const double velocity =
            mark == 'X' ? 1.0 : (mark == 'x' ? 0.72 : (mark == 'o' ? 0.42 : 0.0));
        if (velocity > 0.0) {
            score.push_back({.beat = start + step * static_cast<double>(i),
                             .sound = sound,
                             .velocity = velocity * level});
        }
    }
}

/// Writes bar after bar by write_bar(score, bar), bars counted from 0, and drops notes beyond the
/// end.
template <typename WriteBar>
[[nodiscard]] Notes write_bars(double beats, int beats_per_bar, const WriteBar& write_bar) {
    Notes score;
    for (int bar = 0; bar * beats_per_bar < beats; ++bar) {
        write_bar(score, bar);
    }
    std::erase_if(score, [beats](const Note& note) { return note.beat >= beats; });
    return score;
}

}  // namespace raks::audio
