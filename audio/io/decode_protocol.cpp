#include "audio/io/decode_protocol.hpp"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace raks::audio {
namespace {

constexpr std::size_t kFixedBytes = offsetof(DecodeMessage, text);

// Room for the descriptors beside a message.
union Beside {
    cmsghdr align;
    std::array<char, CMSG_SPACE(sizeof(int) * kMostDescriptors)> bytes;
};

// Puts those that came where there is a place for them, and closes the others.
void take_descriptors(msghdr& header, std::span<int> places) {
    std::fill(places.begin(), places.end(), -1);
    std::size_t taken = 0;
    for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr;
         part = CMSG_NXTHDR(&header, part)) {
        if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) {
            continue;
        }
        const std::size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (std::size_t i = 0; i < count; ++i) {
            int came = -1;
            std::memcpy(&came, CMSG_DATA(part) + i * sizeof came, sizeof came);
            if (taken < places.size()) {
                places[taken++] = came;
            } else {
                ::close(came);
            }
        }
    }
}

}  // namespace

void DecodeMessage::set_text(std::string_view words) noexcept {
    text_bytes = static_cast<std::uint32_t>(std::min(words.size(), text.size()));
    std::copy_n(words.begin(), text_bytes, text.begin());
}

std::string_view DecodeMessage::words() const noexcept {
    return {text.data(), std::min<std::size_t>(text_bytes, text.size())};
}

Talk send_message(int socket, const DecodeMessage& message, std::span<const int> descriptors) {
    iovec body{const_cast<DecodeMessage*>(&message), kFixedBytes + message.words().size()};
    msghdr header{};
    header.msg_iov = &body;
    header.msg_iovlen = 1;
    Beside beside{};
    if (!descriptors.empty()) {
        header.msg_control = beside.bytes.data();
        header.msg_controllen = CMSG_SPACE(descriptors.size_bytes());
        cmsghdr* const part = CMSG_FIRSTHDR(&header);
        part->cmsg_level = SOL_SOCKET;
        part->cmsg_type = SCM_RIGHTS;
        part->cmsg_len = CMSG_LEN(descriptors.size_bytes());
        std::memcpy(CMSG_DATA(part), descriptors.data(), descriptors.size_bytes());
    }
    ssize_t sent = -1;
    do {
        sent = ::sendmsg(socket, &header, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    return sent < 0 ? Talk::broke : Talk::good;
}

Talk receive_message(int socket, DecodeMessage& message, std::span<int> descriptors) {
    iovec body{&message, sizeof message};
    Beside beside{};
    msghdr header{};
    header.msg_iov = &body;
    header.msg_iovlen = 1;
    header.msg_control = beside.bytes.data();
    header.msg_controllen = beside.bytes.size();
    ssize_t got = -1;
    do {
        got = ::recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
    } while (got < 0 && errno == EINTR);
    if (got <= 0) {
        return Talk::broke;
    }
    take_descriptors(header, descriptors);
    const auto bytes = static_cast<std::size_t>(got);
    const bool is_whole = bytes >= kFixedBytes && message.magic == kDecodeMagic &&
                          message.text_bytes == bytes - kFixedBytes;
    return is_whole ? Talk::good : Talk::nonsense;
}

Talk await_message(int socket, DecodeMessage& message, const Patience& patience) {
    const Talk waited = wait_to_receive(socket, patience);
    return waited == Talk::good ? receive_message(socket, message) : waited;
}

}  // namespace raks::audio
