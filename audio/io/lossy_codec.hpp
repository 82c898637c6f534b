#pragma once

#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// The codecs.
enum class LossyCodec : unsigned char { mp3, opus };
/// Their names, in the order of LossyCodec.
inline constexpr std::string_view kLossyCodecNames[] = {"MP3", "Opus"};

/// Replaces mono samples by what remains after a lossy codec has coded and decoded them, in memory:
/// as many samples at the same rate, the codec's delay removed. For training with damaged music.
/// `bits_per_second`: 8,000 to 320,000; MP3 below 48 kbit/s is coded at 22.05 kHz, as its encoders
/// do. Samples beyond -1 to 1 are clipped. The same input gives the same samples.
/// Errors: FFmpeg here lacks the encoder; a rate or bit rate that the codec refuses.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<void> pass_lossy_codec(LossyCodec codec,
                                              int rate,
                                              int bits_per_second,
                                              std::vector<float>& samples);

}  // namespace raks::audio
