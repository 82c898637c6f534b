#pragma once

#include <vector>

#include "audio/music/styles/rhythm_styles.hpp"

namespace raks::audio {

// The rows of each family; rhythm_styles() has them all.
[[nodiscard]] std::vector<RhythmStyle> caribbean_styles();
[[nodiscard]] std::vector<RhythmStyle> african_styles();
[[nodiscard]] std::vector<RhythmStyle> south_american_styles();
[[nodiscard]] std::vector<RhythmStyle> belly_styles();
[[nodiscard]] std::vector<RhythmStyle> pop_styles();
[[nodiscard]] std::vector<RhythmStyle> electronic_styles();
[[nodiscard]] std::vector<RhythmStyle> ballroom_styles();

}  // namespace raks::audio
