#pragma once

#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

enum class LossyCodec : unsigned char { mp3, opus };
inline constexpr std::string_view kLossyCodecNames[] = {"MP3", "Opus"};

/// What is left of mono samples once a lossy codec has coded and decoded them, in memory: as many
/// samples at the same rate, the codec's delay taken off.
/// `bits_per_second`: 8,000 to 320,000; MP3 below 48 kbit/s is coded at 22.05 kHz, as its encoders
/// do. Samples beyond -1 to 1 are clipped. The same input gives the same samples.
/// Errors: FFmpeg here lacks the encoder; a rate or bit rate that the codec refuses.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<void> pass_lossy_codec(LossyCodec codec,
                                              int rate,
                                              int bits_per_second,
                                              std::vector<float>& samples);

}  // namespace raks::audio
