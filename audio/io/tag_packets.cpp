#include "audio/io/tag_packets.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace raks::audio {
namespace {

constexpr std::size_t kId3Head = 10;

bool begins_with(std::span<const std::uint8_t> packet, std::string_view text) noexcept {
    return packet.size() >= text.size() &&
           std::memcmp(packet.data(), text.data(), text.size()) == 0;
}

// Bytes of an ID3v2 tag with its head: the length is written in seven bits a byte.
std::size_t id3_bytes(std::span<const std::uint8_t> head) noexcept {
    std::size_t bytes = 0;
    for (const std::uint8_t byte : head.subspan(6, 4)) {
        bytes = bytes << 7U | (byte & 0x7FU);
    }
    return bytes + kId3Head;
}

}  // namespace

bool TagPackets::is_tag(std::span<const std::uint8_t> packet) noexcept {
    if (tag_left_ > 0) {
        tag_left_ -= std::min(tag_left_, packet.size());
        return true;
    }
    if (begins_with(packet, "ID3") && packet.size() >= kId3Head) {
        const std::size_t bytes = id3_bytes(packet);
        tag_left_ = bytes - std::min(bytes, packet.size());
        return true;
    }
    constexpr std::array<std::string_view, 3> kOthers = {"TAG", "APETAGEX", "LYRICSBEGIN"};
    return std::any_of(kOthers.begin(),
                       kOthers.end(),
                       [&](std::string_view tag) { return begins_with(packet, tag); }) ||
           std::all_of(packet.begin(), packet.end(), [](std::uint8_t byte) { return byte == 0; });
}

}  // namespace raks::audio
