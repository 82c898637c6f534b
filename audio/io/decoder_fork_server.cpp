#include "audio/io/decoder_fork_server.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/decoder_part.hpp"

namespace raks::audio {
namespace {

constexpr std::chrono::seconds kLongestStart{30};
constexpr std::chrono::milliseconds kTurn{2};  // between two looks whether the other is done

}  // namespace

DecoderForkServer& DecoderForkServer::get() {
    static DecoderForkServer server;
    return server;
}

Talk DecoderForkServer::ask(const std::array<int, 3>& descriptors,
                            const std::function<bool()>& is_stop_requested,
                            std::int64_t& answer) const {
    DecodeMessage message;
    message.kind = DecodeKind::start;
    Talk talk = send_message(child_->socket(), message, descriptors);
    if (talk == Talk::good) {
        const TalkDeadline deadline = std::chrono::steady_clock::now() + kLongestStart;
        talk = await_message(child_->socket(), message, until(deadline, is_stop_requested));
    }
    answer = message.value;
    return talk == Talk::good && message.kind != DecodeKind::started ? Talk::nonsense : talk;
}

Expected<pid_t> DecoderForkServer::start_decoder(const std::array<int, 3>& descriptors,
                                                 const std::function<bool()>& is_stop_requested) {
    const auto program = find_talking_part(kDecoderPart);
    if (!program) {
        return fail(program.error());
    }
    std::unique_lock lock(mutex_, std::defer_lock);
    // Another thread that starts one takes some milliseconds, or must be stopped, too.
    while (!lock.try_lock()) {
        if (is_stop_requested()) {
            return fail("was stopped before its first sound");
        }
        std::this_thread::sleep_for(kTurn);
    }
    if (program_ != *program) {
        child_.reset();
        program_ = *program;
    }
    const bool is_new = !child_;
    if (is_new) {
        auto started =
            TalkingChild::start(kDecoderPart, {.kind = SOCK_SEQPACKET, .is_ended_alone = true});
        if (!started) {
            return fail(std::move(started.error()));
        }
        child_.emplace(std::move(*started));
    }
    std::int64_t answer = 0;
    const Talk talk = ask(descriptors, is_stop_requested, answer);
    if (talk == Talk::good) {
        return answer > 0 ? Expected<pid_t>(static_cast<pid_t>(answer))
                          : no_decoder(static_cast<int>(-answer));
    }
    // Its late answer would be taken for that to the next question.
    const std::string how = child_->end();
    child_.reset();
    if (!is_new && talk == Talk::broke) {  // it died in the meantime
        lock.unlock();
        return start_decoder(descriptors, is_stop_requested);
    }
    return fail(why_ended(talk, how) + " before its first sound");
}

}  // namespace raks::audio
