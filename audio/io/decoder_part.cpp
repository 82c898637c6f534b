#include "audio/io/decoder_part.hpp"

#include <system_error>

namespace raks::audio {

std::string why_ended(Talk why, const std::string& how) {
    switch (why) {
        case Talk::late:
            return "its decoder did not answer in time and was ended";
        case Talk::stopped:
            return "was stopped";
        case Talk::broke:
            return "its decoder ended too soon (" + how + ")";
        case Talk::good:
        case Talk::nonsense:
            break;
    }
    return "its decoder sent a broken answer and was ended";
}

tl::unexpected<Error> no_decoder(int error_number) {
    return fail("raks-decode cannot be started: " + std::generic_category().message(error_number));
}

}  // namespace raks::audio
