#include "render/import/import_protocol.hpp"

#include <algorithm>
#include <span>

namespace raks::render {
namespace {

constexpr std::uint32_t kImportMagic = 0x52490001;  // of every part; other builds have another one

struct PartHead {
    std::uint32_t magic = kImportMagic;
    ImportKind kind = ImportKind::failed;
    std::uint64_t size = 0;
};

template <typename T>
std::span<std::byte> bytes_of(T& value) {
    return std::as_writable_bytes(std::span(&value, 1));
}

}  // namespace

Talk send_part(int socket, ImportKind kind, std::string_view bytes, TalkDeadline deadline) {
    PartHead head{.kind = kind, .size = bytes.size()};
    const Talk sent = send_all(socket, bytes_of(head), deadline);
    return sent == Talk::good ? send_all(socket, std::as_bytes(std::span(bytes)), deadline) : sent;
}

Talk receive_part(int socket, ImportPart& part, TalkDeadline deadline) {
    PartHead head;
    if (const auto got = receive_all(socket, bytes_of(head), deadline); got != Talk::good) {
        return got;
    }
    if (head.magic != kImportMagic || head.kind > ImportKind::done ||
        head.size > kMostImportBytes) {
        return Talk::nonsense;
    }
    part.kind = head.kind;
    part.bytes.clear();
    // It grows with what comes, not with what is claimed.
    constexpr std::size_t kPiece = std::size_t{4} << 20U;
    while (part.bytes.size() < head.size) {
        const std::size_t done = part.bytes.size();
        const std::size_t piece = std::min(kPiece, static_cast<std::size_t>(head.size) - done);
        part.bytes.resize(done + piece);
        if (const auto got = receive_all(
                socket, std::as_writable_bytes(std::span(part.bytes).subspan(done)), deadline);
            got != Talk::good) {
            return got;
        }
    }
    return Talk::good;
}

}  // namespace raks::render
