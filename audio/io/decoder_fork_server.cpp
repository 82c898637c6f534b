#include "audio/io/decoder_fork_server.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "audio/io/decode_protocol.hpp"
#include "base/program_parts.hpp"
#include "base/time.hpp"

namespace raks::audio {
namespace {

constexpr int kFirstFree = 10;  // above the descriptor that the child gets
constexpr Nanos kLongestStart = std::chrono::seconds(30);
constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::milliseconds kTurn{2};  // between two looks whether the other is done

tl::unexpected<Error> cannot_start(int error_number) {
    return fail("raks-decode cannot be started: " + std::generic_category().message(error_number));
}

// Signals as a fresh program has them, and a process group of its own: what the terminal sends to
// raks (Ctrl+C) is for raks alone.
void set_attributes(posix_spawnattr_t& attributes) {
    sigset_t all;
    sigset_t none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
}

// Nothing but its socket; what libraries print is lost.
void set_descriptors(posix_spawn_file_actions_t& actions, int socket) {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
#ifndef RAKS_DECODES_UNCONFINED
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#endif
    posix_spawn_file_actions_adddup2(&actions, socket, kDecodeSocket);
    posix_spawn_file_actions_addclosefrom_np(&actions, kDecodeSocket + 1);
}

int spawn(std::string program, int socket, pid_t& pid) {
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t actions;
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
    set_attributes(attributes);
    set_descriptors(actions, socket);
    std::string unconfined = "--no-sandbox";
    std::array<char*, 3> arguments{program.data(), nullptr, nullptr};
#ifdef RAKS_DECODES_UNCONFINED
    arguments[1] = unconfined.data();
#endif
    const int error =
        posix_spawn(&pid, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return error;
}

}  // namespace

std::string end_child(pid_t pid) {
    int status = 0;
    pid_t ended = 0;
    ::kill(pid, SIGKILL);  // one that is dead stays as it died
    do {
        ended = ::waitpid(pid, &status, 0);
    } while (ended < 0 && errno == EINTR);
    if (ended > 0 && WIFSIGNALED(status)) {
        const char* const name = ::sigabbrev_np(WTERMSIG(status));
        return name == nullptr ? "killed by a signal" : std::string("killed by SIG") + name;
    }
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

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
    // Under a number that the child's own do not overwrite.
    const int child_end = ::fcntl(ends[1], F_DUPFD_CLOEXEC, kFirstFree);
    int error = child_end < 0 ? errno : 0;
    if (error == 0) {
        error = spawn(program_.string(), child_end, pid_);
        ::close(child_end);
    }
    ::close(ends[1]);
    if (error != 0) {
        pid_ = -1;
        ::close(ends[0]);
        return cannot_start(error);
    }
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
            return fail("its decoder hung and was ended before its first sound");
        default:
            break;
    }
    if (!is_new) {  // it died in the meantime
        lock.unlock();
        return start_decoder(descriptors, is_stop_requested);
    }
    return fail("its decoder broke off (" + how + ") before its first sound");
}

}  // namespace raks::audio
