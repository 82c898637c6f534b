#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raks::audio {

/// `count` samples of `sound` from place `first` on, every `step` of its samples, between them by
/// cubic curves (Catmull, Rom 1974); 0 outside. For steps near 1: there is no filter.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<float> read_between(std::span<const float> sound,
                                              double first,
                                              double step,
                                              std::size_t count);

}  // namespace raks::audio
