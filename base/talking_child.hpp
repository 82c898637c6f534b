#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/descriptor.hpp"
#include "base/expected.hpp"

/// Programs of ours that read what others wrote, in a process of their own, and speak with us over
/// a stream socket. What they say is not to be trusted.
namespace raks {

/// What came of sending or receiving.
enum class Talk : std::uint8_t {
    good,
    broke,     ///< the other end is gone
    late,      ///< the deadline has passed
    nonsense,  ///< what came is no part of such a talk
};

/// When waiting ends.
using TalkDeadline = std::chrono::steady_clock::time_point;
/// For children: we, who wait, know when it is too late.
inline constexpr TalkDeadline kNever = TalkDeadline::max();

/// The descriptor of a child that is its end of the socket.
inline constexpr int kTalkSocket = 3;

/// Sends all bytes. Calls sendmsg alone, which cages allow. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk send_all(int socket, std::span<const std::byte> bytes, TalkDeadline deadline);
/// Receives until `bytes` is full. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_all(int socket, std::span<std::byte> bytes, TalkDeadline deadline);

/// A part of ours (see find_program_part) that is to be started.
struct TalkingPart {
    const char* name;      ///< "raks-import"
    const char* variable;  ///< of the environment, that names another one
};

/// A child that runs, with its end of a socket as descriptor kFirstGiven. Killed, with all that it
/// started, when this ends. Threads: one. Real-time: no.
class TalkingChild {
 public:
    /// Errors: it is not there; the system's.
    [[nodiscard]] static Expected<TalkingChild> start(const TalkingPart& part,
                                                      std::vector<std::string> arguments);
    TalkingChild(const TalkingChild&) = delete;             ///< one owner
    TalkingChild& operator=(const TalkingChild&) = delete;  ///< likewise
    TalkingChild(TalkingChild&& other) noexcept;            ///< `other` is ended
    TalkingChild& operator=(TalkingChild&&) = delete;
    ~TalkingChild();

    /// Our end of the socket.
    [[nodiscard]] int socket() const noexcept { return socket_.number; }
    /// Ends it after a talk that was not good, and says why in words: "its reader ended too soon
    /// (killed by SIGSEGV): it is damaged, or too large". `longest`: how long it had.
    [[nodiscard]] std::string end(Talk why, std::chrono::milliseconds longest);

 private:
    TalkingChild(pid_t pid, Descriptor& socket) : pid_(pid), socket_(socket.release()) {}

    pid_t pid_ = -1;
    Descriptor socket_;
};

/// A child has said that it reads without a filter of system calls (seccomp), which this kernel
/// refuses. Threads: any. Real-time: yes.
void note_uncaged_child() noexcept;
/// Has any child of this process? Threads: any. Real-time: yes.
[[nodiscard]] bool is_any_child_uncaged() noexcept;

}  // namespace raks
