#include "audio/io/decoder_fork_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/decoder_spawn.hpp"
#include "base/program_parts.hpp"
#include "base/time.hpp"

namespace raks::audio {
namespace {

constexpr Nanos kLongestStart = std::chrono::seconds(30);
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::milliseconds kTurn{2};  // between two looks whether the other is done

tl::unexpected<Error> cannot_start(int error_number) {
    return fail("raks-decode cannot be started: " + std::generic_category().message(error_number));
}

}  // namespace

DecoderForkServer& DecoderForkServer::get() {
    static DecoderForkServer server;
    return server;
}

std::string DecoderForkServer::end() {
    if (pid_ < 0) {
        return {};
    }
    ::close(std::exchange(socket_, -1));
    return end_child(std::exchange(pid_, -1));
}

Expected<void> DecoderForkServer::open() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        return cannot_start(errno);
    }
    const auto pid = spawn_decoder({.program = program_, .descriptors = std::span(&ends[1], 1)});
    ::close(ends[1]);
    if (!pid) {
        ::close(ends[0]);
        return fail(pid.error());
    }
    pid_ = *pid;
    socket_ = ends[0];
    return {};
}

DecoderForkServer::Answered DecoderForkServer::ask(const std::array<int, 3>& descriptors,
                                                   const std::function<bool()>& is_stop_requested,
                                                   std::int64_t& answer) const {
    DecodeMessage message;
    message.kind = DecodeKind::start;
    if (send_message(socket_, message, descriptors) != Passed::yes) {
        return Answered::broke;
    }
    const HostTime start = HostClock::now();
    pollfd look{socket_, POLLIN, 0};
    while (::poll(&look, 1, static_cast<int>(kPoll.count())) <= 0) {
        if (is_stop_requested()) {
            return Answered::stopped;
        }
        if (HostClock::now() - start > kLongestStart) {
            return Answered::hung;
        }
    }
    if (receive_message(socket_, message) != Passed::yes || message.kind != DecodeKind::started) {
        return Answered::broke;
    }
    answer = message.value;
    return Answered::yes;
}

Expected<pid_t> DecoderForkServer::start_decoder(const std::array<int, 3>& descriptors,
                                                 const std::function<bool()>& is_stop_requested) {
    const auto program = find_program_part("raks-decode", "libexec/raks", "RAKS_DECODER");
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
        end();
        program_ = *program;
    }
    const bool is_new = pid_ < 0;
    if (is_new) {
        if (auto opened = open(); !opened) {
            return fail(std::move(opened.error()));
        }
    }
    std::int64_t answer = 0;
    const Answered answered = ask(descriptors, is_stop_requested, answer);
    if (answered == Answered::yes) {
        return answer > 0 ? Expected<pid_t>(static_cast<pid_t>(answer))
                          : cannot_start(static_cast<int>(-answer));
    }
    // Its late answer would be taken for that to the next question.
    const std::string how = end();
    switch (answered) {
        case Answered::stopped:
            return fail("was stopped before its first sound");
        case Answered::hung:
            return fail("its decoder did not answer in time and was ended before its first sound");
        default:
            break;
    }
    if (!is_new) {  // it died in the meantime
        lock.unlock();
        return start_decoder(descriptors, is_stop_requested);
    }
    return fail("its decoder ended too soon (" + how + ") before its first sound");
}

}  // namespace raks::audio
