#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raks::audio {

/// One plucked note.
struct OudNote {
    double time = 0.0;      ///< s, >= 0
    double length = 0.2;    ///< s until it is damped
    double hertz = 220.0;   ///< any pitch, quarter tones included
    double strength = 1.0;  ///< (0, 1]
};

/// Notes plucked by the generator's oud (two strings a course, any pitch), an instrument that the
/// soundfonts lack. Mono at `rate`, peak 1, `samples` long. Notes that begin behind the end are
/// left out.
[[nodiscard]] std::vector<float> play_oud(std::span<const OudNote> notes,
                                          int rate,
                                          std::size_t samples);

}  // namespace raks::audio
