#include "audio/io/lossy_codec.hpp"
#include "base/program_parts.hpp"

namespace raks::audio {
namespace {

// As codec_module.cpp has it.
using PassCodec = void (*)(LossyCodec codec,
                           int rate,
                           int bits_per_second,
                           std::vector<float>& samples,
                           Expected<void>& result);

}  // namespace

Expected<void> pass_lossy_codec(LossyCodec codec,
                                int rate,
                                int bits_per_second,
                                std::vector<float>& samples) {
    static const Expected<void*> pass =
        load_program_part("raks-codec.so", "lib/raks", "RAKS_CODEC_MODULE", "raks_pass_codec_1");
    if (!pass) {
        return fail(pass.error());
    }
    Expected<void> result;
    reinterpret_cast<PassCodec> (*pass)(codec, rate, bits_per_second, samples, result);
    return result;
}

}  // namespace raks::audio
