#pragma once

#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// logs[i] = ln(1 + factor x magnitudes[i]), within 2e-7 or 2e-7 of it: how the parts of the
/// analysis compress magnitudes. The same bits on every machine. `magnitudes`: >= 0, as many as
/// `logs`, which do not overlap them. Threads: any. Real-time: yes.
void log_magnitudes(std::span<const float> magnitudes,
                    float factor,
                    std::span<float> logs) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
