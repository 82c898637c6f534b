#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/child_process.hpp"
#include "base/descriptor.hpp"
#include "base/expected.hpp"

/// Programs of ours that read what others wrote, in a process of their own, and speak with us over
/// a socket. What they say is not to be trusted.
namespace raks {

/// What came of sending or receiving.
enum class Talk : std::uint8_t {
    good,
    broke,     ///< the other end is gone
    late,      ///< the deadline has passed
    stopped,   ///< who waited no longer wants it
    nonsense,  ///< what came is no part of such a talk
};

/// When waiting ends.
using TalkDeadline = std::chrono::steady_clock::time_point;
/// For children: we, who wait, know when it is too late.
inline constexpr TalkDeadline kNever = TalkDeadline::max();

/// The descriptor of a child that is its end of the socket.
inline constexpr int kTalkSocket = kFirstGiven;

/// Asked every 50 ms or more often while something is waited for; what is not good ends the wait.
using Patience = std::function<Talk()>;
/// That of one who waits until then, unless it is to stop.
[[nodiscard]] Patience until(TalkDeadline deadline,
                             std::function<bool()> is_stop_requested = nullptr);
/// Waits until something can be received, or the other end is gone. Threads: any. Real-time: no.
[[nodiscard]] Talk wait_to_receive(int socket, const Patience& patience);

/// Sends all bytes. Calls sendmsg alone, which cages allow. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk send_all(int socket, std::span<const std::byte> bytes, TalkDeadline deadline);
/// Receives until `bytes` is full. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_all(int socket, std::span<std::byte> bytes, const Patience& patience);
/// The same.
[[nodiscard]] Talk receive_all(int socket, std::span<std::byte> bytes, TalkDeadline deadline);

/// Two ends of a socket or pipe.
struct TalkEnds {
    Descriptor ours;
    Descriptor childs;

    /// A pair of sockets: SOCK_STREAM, or SOCK_SEQPACKET, which keeps the bounds of messages.
    /// False: errno says why. So the next one.
    [[nodiscard]] bool make_sockets(int kind);
    /// A pipe, by whose end a child is told that we have ended.
    [[nodiscard]] bool make_lifeline();
};

/// A part of ours (see find_program_part) that is to be started.
struct TalkingPart {
    const char* name;      ///< "raks-import"
    const char* variable;  ///< of the environment, that names another one
};

/// Where it lies. Errors: it is not there.
[[nodiscard]] Expected<std::filesystem::path> find_talking_part(const TalkingPart& part);

/// How it is started.
struct TalkingStart {
    std::vector<std::string> arguments{};
    int kind = SOCK_STREAM;               ///< of the socket, see TalkEnds
    std::vector<int> more_descriptors{};  ///< for it, behind the socket; they stay the caller's
    bool is_ended_alone = false;          ///< what it started goes on when it is ended
};

/// A child that runs, with its end of a socket as descriptor kTalkSocket. Killed, with all that it
/// started, when this ends. Threads: one. Real-time: no.
class TalkingChild {
 public:
    /// Errors: it is not there; the system's.
    [[nodiscard]] static Expected<TalkingChild> start(const TalkingPart& part, TalkingStart how);
    /// A child of ours that is started in another way, with our end of its socket; it is ended
    /// alone. `pid` < 0: somebody else runs it, for tests of what a child may say.
    [[nodiscard]] static TalkingChild adopt(pid_t pid, Descriptor& socket);
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
    /// Ends it, if it runs, and says how it ended: "killed by SIGSEGV" or "exit code 1".
    std::string end();

 private:
    TalkingChild(pid_t pid, Descriptor& socket, bool is_ended_alone)
        : pid_(pid), is_ended_alone_(is_ended_alone), socket_(socket.release()) {}

    pid_t pid_ = -1;
    bool is_ended_alone_ = false;
    Descriptor socket_;
};

/// A child has said that it reads without a filter of system calls (seccomp), which this kernel
/// refuses. Threads: any. Real-time: yes.
void note_uncaged_child() noexcept;
/// Has any child of this process? Threads: any. Real-time: yes.
[[nodiscard]] bool is_any_child_uncaged() noexcept;

}  // namespace raks
