#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "audio/music/generator/form_score.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music/generator/notes.hpp"
#include "audio/music/generator/tempo_curve.hpp"

namespace raks::audio {

/// The bars of a plan's piece that begin inside it. `score`: as the band plays it in the `form`
/// (arrange()).
[[nodiscard]] std::vector<PlayedBar> played_bars(const MusicPlan& plan,
                                                 const TempoCurve& curve,
                                                 const Notes& score,
                                                 std::span<const SectionSpan> form);

}  // namespace raks::audio
