#pragma once

#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// Interleaved audio of any number of channels as stereo. One channel goes to both sides. Three to
/// eight channels, in the order of WAV and FFmpeg (left, right, centre, low, back left, back right,
/// side left, side right), are mixed with ITU-R BS.775 weights (centre and surrounds -3 dB, low
/// left out), scaled so that equal full-scale channels stay within [-1, 1]. Above eight channels,
/// the even ones go left and the odd ones right.
/// Threads: any. Real-time: yes.
void downmix_to_stereo(std::span<const float> interleaved,
                       std::size_t channels,
                       std::span<float> stereo) noexcept;

/// The same as mono: the average of the two sides. `mono`: one sample a frame. Threads: any.
/// Real-time: yes.
void downmix_to_mono(std::span<const float> interleaved,
                     std::size_t channels,
                     std::span<float> mono) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
