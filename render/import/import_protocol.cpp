#include "render/import/import_protocol.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace raks::render {
namespace {

constexpr std::uint32_t kImportMagic = 0x52490001;  // of every part; other builds have another one

struct PartHead {
    std::uint32_t magic = kImportMagic;
    ImportKind kind = ImportKind::failed;
    std::uint64_t size = 0;
};

ImportTalk wait_for(int socket, short events, ImportDeadline deadline) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) {
        return ImportTalk::late;
    }
    pollfd look{socket, events, 0};
    constexpr std::int64_t kLongest = 1000;
    ::poll(&look, 1, static_cast<int>(std::min(left.count(), kLongest)));
    return ImportTalk::good;
}

// sendmsg and recvmsg are the calls that the cage of raks-import allows.
template <typename Call>
ImportTalk move_all(
    int socket, short events, char* bytes, std::size_t size, Call call, ImportDeadline deadline) {
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
            return ImportTalk::broke;
        } else if (const auto waited = wait_for(socket, events, deadline);
                   waited != ImportTalk::good) {
            return waited;
        }
    }
    return ImportTalk::good;
}

ImportTalk send_all(int socket, const void* bytes, std::size_t size, ImportDeadline deadline) {
    const auto call = [socket](msghdr& message) {
        return ::sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    };
    // An iovec does not say that what it points to is only read.
    return move_all(
        socket, POLLOUT, const_cast<char*>(static_cast<const char*>(bytes)), size, call, deadline);
}

ImportTalk receive_all(int socket, void* bytes, std::size_t size, ImportDeadline deadline) {
    const auto call = [socket](msghdr& message) {
        return ::recvmsg(socket, &message, MSG_DONTWAIT);
    };
    return move_all(socket, POLLIN, static_cast<char*>(bytes), size, call, deadline);
}

}  // namespace

ImportTalk send_part(int socket, ImportKind kind, std::string_view bytes, ImportDeadline deadline) {
    const PartHead head{.kind = kind, .size = bytes.size()};
    const ImportTalk sent = send_all(socket, &head, sizeof head, deadline);
    return sent == ImportTalk::good ? send_all(socket, bytes.data(), bytes.size(), deadline) : sent;
}

ImportTalk receive_part(int socket, ImportPart& part, ImportDeadline deadline) {
    PartHead head;
    if (const auto got = receive_all(socket, &head, sizeof head, deadline);
        got != ImportTalk::good) {
        return got;
    }
    if (head.magic != kImportMagic || head.kind > ImportKind::done ||
        head.size > kMostImportBytes) {
        return ImportTalk::nonsense;
    }
    part.kind = head.kind;
    part.bytes.clear();
    // It grows with what comes, not with what is claimed.
    constexpr std::size_t kPiece = std::size_t{4} << 20U;
    while (part.bytes.size() < head.size) {
        const std::size_t done = part.bytes.size();
        const std::size_t piece = std::min(kPiece, static_cast<std::size_t>(head.size) - done);
        part.bytes.resize(done + piece);
        if (const auto got = receive_all(socket, part.bytes.data() + done, piece, deadline);
            got != ImportTalk::good) {
            return got;
        }
    }
    return ImportTalk::good;
}

}  // namespace raks::render
