#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raks::audio {

struct OudNote {
    double time = 0.0;    ///< s, >= 0
    double length = 0.2;  ///< s until it is damped
    double hertz = 220.0;
    double strength = 1.0;  ///< (0, 1]
};

/// Notes as our own oud plucks them (two strings a course, any pitch), which no soundfont has.
/// Mono, peak 1, `samples` long. Notes that begin behind the end are left out.
[[nodiscard]] std::vector<float> play_oud(std::span<const OudNote> notes,
                                          int rate,
                                          std::size_t samples);

}  // namespace raks::audio
