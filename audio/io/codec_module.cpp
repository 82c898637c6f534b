// The door of the module raks-codec.so, which has FFmpeg's coders of sound: training and tests with
// damaged music load it, playing never does.
#include "audio/io/lossy_codec.hpp"

extern "C" __attribute__((visibility("default"))) void raks_pass_codec_1(
    raks::audio::LossyCodec codec,
    int rate,
    int bits_per_second,
    std::vector<float>& samples,
    raks::Expected<void>& result);

void raks_pass_codec_1(raks::audio::LossyCodec codec,
                       int rate,
                       int bits_per_second,
                       std::vector<float>& samples,
                       raks::Expected<void>& result) {
    result = raks::audio::pass_lossy_codec(codec, rate, bits_per_second, samples);
}
