#include "base/talking_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/program_parts.hpp"

namespace raks {
namespace {

std::atomic<bool> g_is_any_uncaged{false};  // relaxed: it orders nothing

// Whether something can be done within a moment.
bool is_soon(int socket, short events) {
    constexpr int kMilliseconds = 50;
    pollfd look{socket, events, 0};
    return ::poll(&look, 1, kMilliseconds) > 0;
}

// sendmsg and recvmsg are the calls that the cages of children allow.
template <typename Call>
Talk move_all(int socket,
              short events,
              std::byte* bytes,
              std::size_t size,
              Call call,
              const Patience& patience) {
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
        } else if (const Talk talk = patience(); talk != Talk::good) {
            return talk;
        } else {
            static_cast<void>(is_soon(socket, events));
        }
    }
    return Talk::good;
}

}  // namespace

Patience until(TalkDeadline deadline, std::function<bool()> is_stop_requested) {
    return [deadline, is_stop_requested = std::move(is_stop_requested)] {
        if (is_stop_requested && is_stop_requested()) {
            return Talk::stopped;
        }
        return std::chrono::steady_clock::now() < deadline ? Talk::good : Talk::late;
    };
}

Talk wait_to_receive(int socket, const Patience& patience) {
    Talk talk = Talk::good;
    while (talk == Talk::good && !is_soon(socket, POLLIN)) {
        talk = patience();
    }
    return talk;
}

Talk send_all(int socket, std::span<const std::byte> bytes, TalkDeadline deadline) {
    const auto call = [socket](msghdr& message) {
        return ::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    };
    // An iovec does not say that what it points to is only read.
    return move_all(
        socket, POLLOUT, const_cast<std::byte*>(bytes.data()), bytes.size(), call, until(deadline));
}

Talk receive_all(int socket, std::span<std::byte> bytes, const Patience& patience) {
    const auto call = [socket](msghdr& message) {
        return ::recvmsg(socket, &message, MSG_DONTWAIT);
    };
    return move_all(socket, POLLIN, bytes.data(), bytes.size(), call, patience);
}

Talk receive_all(int socket, std::span<std::byte> bytes, TalkDeadline deadline) {
    return receive_all(socket, bytes, until(deadline));
}

bool TalkEnds::make_sockets(int kind) {
    std::array<int, 2> pair{-1, -1};
    const bool is_made = ::socketpair(AF_UNIX, kind | SOCK_CLOEXEC, 0, pair.data()) == 0;
    ours.number = pair[0];
    childs.number = pair[1];
    return is_made;
}

bool TalkEnds::make_lifeline() {
    std::array<int, 2> pair{-1, -1};
    const bool is_made = ::pipe2(pair.data(), O_CLOEXEC) == 0;
    childs.number = pair[0];
    ours.number = pair[1];
    return is_made;
}

Expected<std::filesystem::path> find_talking_part(const TalkingPart& part) {
    return find_program_part(part.name, "libexec/raks", part.variable);
}

Expected<TalkingChild> TalkingChild::start(const TalkingPart& part, TalkingStart how) {
    const auto program = find_talking_part(part);
    if (!program) {
        return fail(program.error());
    }
    TalkEnds ends;
    if (!ends.make_sockets(how.kind)) {
        return fail(fmt::format(
            "{} cannot be started: {}", part.name, std::generic_category().message(errno)));
    }
    how.more_descriptors.insert(how.more_descriptors.begin(), ends.childs.number);
    ChildStart start{.program = *program,
                     .arguments = std::move(how.arguments),
                     .descriptors = how.more_descriptors};
#ifdef RAKS_CHILDREN_UNCONFINED
    start.arguments.emplace_back("--no-sandbox");
    start.is_heard = true;
#endif
    const auto pid = spawn_child(start);
    if (!pid) {
        return fail(pid.error());
    }
    return TalkingChild(*pid, ends.ours, how.is_ended_alone);
}

TalkingChild TalkingChild::adopt(pid_t pid, Descriptor& socket) {
    return TalkingChild(pid, socket, true);
}

TalkingChild::TalkingChild(TalkingChild&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      is_ended_alone_(other.is_ended_alone_),
      socket_(other.socket_.release()) {}

TalkingChild::~TalkingChild() { end(); }

std::string TalkingChild::end() {
    const pid_t pid = std::exchange(pid_, -1);
    return pid < 0 ? "" : is_ended_alone_ ? end_child(pid) : end_child_group(pid);
}

std::string TalkingChild::end(Talk why, std::chrono::milliseconds longest) {
    const std::string how = end();
    switch (why) {
        case Talk::late:
            return fmt::format("its reader took more than {} s and was ended",
                               std::chrono::duration<double>(longest).count());
        case Talk::broke:
            return fmt::format("its reader ended too soon ({}): it is damaged, or too large", how);
        case Talk::good:
        case Talk::stopped:
        case Talk::nonsense:
            break;
    }
    return "its reader sent a broken answer and was ended";
}

void note_uncaged_child() noexcept { g_is_any_uncaged.store(true, std::memory_order_relaxed); }

bool is_any_child_uncaged() noexcept { return g_is_any_uncaged.load(std::memory_order_relaxed); }

}  // namespace raks
