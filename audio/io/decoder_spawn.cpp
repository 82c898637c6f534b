#include "audio/io/decoder_spawn.hpp"

#include "audio/io/decode_protocol.hpp"

namespace raks::audio {

Expected<pid_t> spawn_decoder(const DecoderStart& start) {
    static_assert(kDecodeSocket == kFirstGiven);
    ChildStart child{.program = start.program, .arguments = {}, .descriptors = start.descriptors};
    if (!start.mode.empty()) {
        child.arguments.push_back(start.mode);
    }
#ifdef RAKS_DECODES_UNCONFINED
    child.arguments.emplace_back("--no-sandbox");
    child.is_heard = true;
#endif
    return spawn_child(child);
}

std::string why_ended(Waited why, const std::string& how) {
    switch (why) {
        case Waited::hung:
            return "its decoder did not answer in time and was ended";
        case Waited::stopped:
            return "was stopped";
        case Waited::answer:
            return "its decoder sent a broken answer and was ended";
        case Waited::broke:
            break;
    }
    return "its decoder ended too soon (" + how + ")";
}

}  // namespace raks::audio
