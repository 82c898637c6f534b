// Take music: the song that a take was danced to, known from all of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "training/cells/grid_music.hpp"
#include "training/figures/label_counts.hpp"

namespace raks::apps {

/// Values of TakeMusic::onsets a second.
inline constexpr double kOnsetRate = 100.0;

/// A song's beats and onsets.
struct TakeMusic {
    motion::DancedMusic music;   ///< its name is the file's; offset 0
    std::vector<double> onsets;  ///< onset strength by kOnsetRate; 1: as the strongest
};

/// Analyzes a whole song, as `raks play` does before it plays it. Errors: as engine::plan_song; a
/// song of more than an hour. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TakeMusic> read_take_music(const std::filesystem::path& file);

/// What a person is told of an offset that was found by the motion.
[[nodiscard]] std::string offset_line(const std::string& song, const motion::MusicOffset& found);

}  // namespace raks::apps
