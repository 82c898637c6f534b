#include "base/talking_child.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/child_process.hpp"
#include "base/program_parts.hpp"

namespace raks {
namespace {

std::atomic<bool> g_is_any_uncaged{false};  // relaxed: it orders nothing

Talk wait_for(int socket, short events, TalkDeadline deadline) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) {
        return Talk::late;
    }
    pollfd look{socket, events, 0};
    constexpr std::int64_t kLongest = 1000;
    ::poll(&look, 1, static_cast<int>(std::min(left.count(), kLongest)));
    return Talk::good;
}

// sendmsg and recvmsg are the calls that the cages of children allow.
template <typename Call>
Talk move_all(int socket,
              short events,
              std::byte* bytes,
              std::size_t size,
              Call call,
              TalkDeadline deadline) {
    while (size > 0) {
        iovec piece{bytes, size};
        msghdr message{};
        message.msg_iov = &piece;
        message.msg_iovlen = 1;
        const ssize_t moved = call(message);
        if (moved > 0) {
            bytes += moved;
            size -= static_cast<std::size_t>(moved);
        } else if (moved == 0 || (errno != EAGAIN && errno != EINTR)) {
            return Talk::broke;
        } else if (const auto waited = wait_for(socket, events, deadline); waited != Talk::good) {
            return waited;
        }
    }
    return Talk::good;
}

}  // namespace

Talk send_all(int socket, std::span<const std::byte> bytes, TalkDeadline deadline) {
    const auto call = [socket](msghdr& message) {
        return ::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    };
    // An iovec does not say that what it points to is only read.
    return move_all(
        socket, POLLOUT, const_cast<std::byte*>(bytes.data()), bytes.size(), call, deadline);
}

Talk receive_all(int socket, std::span<std::byte> bytes, TalkDeadline deadline) {
    const auto call = [socket](msghdr& message) {
        return ::recvmsg(socket, &message, MSG_DONTWAIT);
    };
    return move_all(socket, POLLIN, bytes.data(), bytes.size(), call, deadline);
}

Expected<TalkingChild> TalkingChild::start(const TalkingPart& part,
                                           std::vector<std::string> arguments) {
    const auto program = find_program_part(part.name, "libexec/raks", part.variable);
    if (!program) {
        return fail(program.error());
    }
    std::array<int, 2> pair{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) {
        return fail(fmt::format(
            "{} cannot be started: {}", part.name, std::generic_category().message(errno)));
    }
    Descriptor ours(pair[0]);
    const Descriptor childs(pair[1]);
    ChildStart start{.program = *program,
                     .arguments = std::move(arguments),
                     .descriptors = std::span(&childs.number, 1)};
#ifdef RAKS_CHILDREN_UNCONFINED
    start.arguments.emplace_back("--no-sandbox");
    start.is_heard = true;
#endif
    const auto pid = spawn_child(start);
    if (!pid) {
        return fail(pid.error());
    }
    return TalkingChild(*pid, ours);
}

TalkingChild::TalkingChild(TalkingChild&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), socket_(other.socket_.release()) {}

TalkingChild::~TalkingChild() {
    if (pid_ >= 0) {
        end_child_group(pid_);
    }
}

std::string TalkingChild::end(Talk why, std::chrono::milliseconds longest) {
    const std::string how = end_child_group(std::exchange(pid_, -1));
    switch (why) {
        case Talk::late:
            return fmt::format("its reader took more than {} s and was ended",
                               std::chrono::duration<double>(longest).count());
        case Talk::broke:
            return fmt::format("its reader ended too soon ({}): it is damaged, or too large", how);
        case Talk::good:
        case Talk::nonsense:
            break;
    }
    return "its reader sent a broken answer and was ended";
}

void note_uncaged_child() noexcept { g_is_any_uncaged.store(true, std::memory_order_relaxed); }

bool is_any_child_uncaged() noexcept { return g_is_any_uncaged.load(std::memory_order_relaxed); }

}  // namespace raks
