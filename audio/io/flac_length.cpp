#include "audio/io/flac_length.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "audio/io/head_bytes.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kInfoAt = 8;  // of STREAMINFO's body, behind "fLaC" and its own head
constexpr std::size_t kInfoEnd = 8 + 34;
constexpr std::size_t kLeastFrameHead = 6;    // of a frame: four bytes, its number, a check sum
constexpr std::size_t kTailBytes = 1 << 18U;  // in which a last frame is looked for
constexpr std::size_t kMostFlacs = 4096;

// What STREAMINFO says of all frames.
struct StreamInfo {
    std::uint64_t min_block = 0;  // audio frames of a FLAC frame, except the last
    std::uint64_t max_block = 0;
    std::uint64_t rate = 0;
    std::uint64_t channels = 0;
    std::uint64_t total = 0;
};

std::optional<StreamInfo> read_stream_info(std::string_view head) {
    // The first block of metadata is STREAMINFO, of 34 bytes.
    if (head.size() < kInfoEnd || !head.starts_with("fLaC") ||
        (number_at(head, 4, 4, ByteOrder::big) & 0x7FFF'FFFFU) != 34) {
        return std::nullopt;
    }
    // 20 bits of rate, 3 of channels - 1, 5 of bits - 1, 36 of the total.
    const std::uint64_t packed = number_at(head, kInfoAt + 10, 8, ByteOrder::big);
    StreamInfo info;
    info.min_block = number_at(head, kInfoAt, 2, ByteOrder::big);
    info.max_block = number_at(head, kInfoAt + 2, 2, ByteOrder::big);
    info.rate = packed >> 44U;
    info.channels = (packed >> 41U & 7U) + 1;
    info.total = packed & 0xF'FFFF'FFFFU;
    return info;
}

// CRC-8 of a frame's head: polynomial 0x07, from 0.
std::uint8_t head_sum_of(std::string_view bytes) {
    unsigned sum = 0;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum << 1U ^ ((sum & 0x80U) != 0 ? 0x07U : 0U)) & 0xFFU;
        }
    }
    return static_cast<std::uint8_t>(sum);
}

// The number in a frame's head, coded as UTF-8 codes characters, up to 7 bytes. `length`: of it.
std::optional<std::uint64_t> coded_number(std::string_view bytes, std::size_t& length) {
    if (bytes.empty()) {
        return std::nullopt;
    }
    const auto first = static_cast<unsigned char>(bytes.front());
    length = 1;
    if (first < 0x80) {
        return first;
    }
    while (length < 8 && (first << length & 0x80U) != 0) {
        ++length;
    }
    if (length < 2 || length > 7 || length > bytes.size()) {
        return std::nullopt;
    }
    std::uint64_t value = length >= 7 ? 0 : first & (0x7FU >> length);
    for (const char byte : bytes.substr(1, length - 1)) {
        if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80U) {
            return std::nullopt;
        }
        value = value << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
    }
    return value;
}

// Audio frames of a FLAC frame by the code in its head; 0: given by `extra` bytes behind the
// number.
std::uint64_t block_size_of(unsigned code) {
    constexpr std::array<std::uint64_t, 6> kFirst{0, 192, 576, 1152, 2304, 4608};
    return code < 6 ? kFirst[code] : (code >= 8 ? std::uint64_t{1} << code : 0);
}

bool is_rate(unsigned code, std::uint64_t extra, std::uint64_t rate) {
    constexpr std::array<std::uint64_t, 12> kRates{
        0, 88'200, 176'400, 192'000, 8'000, 16'000, 22'050, 24'000, 32'000, 44'100, 48'000, 96'000};
    constexpr std::array<std::uint64_t, 3> kUnits{1'000, 1, 10};
    return code == 0 ||
           (code < 12 ? kRates[code] == rate : code < 15 && extra * kUnits[code - 12] == rate);
}

// The end, in audio frames, of the FLAC frame whose head stands at the start of `bytes`; none where
// there is no head, or one of another stream.
std::optional<std::uint64_t> end_of_frame(std::string_view bytes, const StreamInfo& info) {
    if (bytes.size() < kLeastFrameHead) {
        return std::nullopt;
    }
    const std::uint64_t head = number_at(bytes, 0, 4, ByteOrder::big);
    const auto block_code = static_cast<unsigned>(head >> 12U & 15U);
    const auto rate_code = static_cast<unsigned>(head >> 8U & 15U);
    const auto channel_code = static_cast<unsigned>(head >> 4U & 15U);
    const bool is_variable = (head >> 16U & 1U) != 0;
    if (head >> 18U != 0x3FFE || (head >> 17U & 1U) != 0 || block_code == 0 || rate_code == 15 ||
        (head & 1U) != 0 || (channel_code < 8 ? channel_code + 1U : 2U) != info.channels) {
        return std::nullopt;
    }
    std::size_t length = 0;
    const auto number = coded_number(bytes.substr(4), length);
    if (!number) {
        return std::nullopt;
    }
    std::size_t at = 4 + length;
    std::uint64_t block = block_size_of(block_code);
    if (block == 0) {
        const std::size_t width = block_code == 6 ? 1 : 2;
        block = number_at(bytes, at, width, ByteOrder::big) + 1;
        at += width;
    }
    const std::size_t rate_width = rate_code == 12 ? 1 : (rate_code > 12 ? 2 : 0);
    const std::uint64_t rate =
        rate_width > 0 ? number_at(bytes, at, rate_width, ByteOrder::big) : 0;
    at += rate_width;
    if (at >= bytes.size() || block > info.max_block || !is_rate(rate_code, rate, info.rate) ||
        head_sum_of(bytes.substr(0, at)) != static_cast<unsigned char>(bytes[at])) {
        return std::nullopt;
    }
    return (is_variable ? *number : *number * info.max_block) + block;
}

// The end of the last frame in the file's last bytes; 0: none.
std::int64_t last_end(const FileWindow& file, const StreamInfo& info) {
    const std::int64_t from =
        std::max<std::int64_t>(file.size() - static_cast<std::int64_t>(kTailBytes), 0);
    const std::string tail = file.bytes(from, kTailBytes);
    for (std::size_t at = tail.rfind('\xff'); at != std::string::npos && at != 0;
         at = tail.rfind('\xff', at - 1)) {
        if (const auto end = end_of_frame(std::string_view(tail).substr(at), info)) {
            return static_cast<std::int64_t>(*end);
        }
    }
    return 0;
}

// Starts of further FLAC files: "fLaC" and a STREAMINFO of 34 bytes.
void find_starts(const FileWindow& file, std::vector<std::int64_t>& starts) {
    constexpr std::size_t kPiece = 1 << 20U;
    for (std::int64_t at = 1; at < file.size(); at += static_cast<std::int64_t>(kPiece)) {
        const std::string piece = file.bytes(at, kPiece + kInfoEnd);
        for (std::size_t found = piece.find("fLaC"); found < kPiece;
             found = piece.find("fLaC", found + 1)) {
            const auto info = read_stream_info(std::string_view(piece).substr(found));
            if (info && info->rate > 0 && starts.size() < kMostFlacs) {
                starts.push_back(at + static_cast<std::int64_t>(found));
            }
        }
    }
}

// The head with this total.
FileWindow with_total(const FileWindow& file, std::int64_t total) {
    std::string head = file.bytes(0, kInfoEnd);
    head.resize(kInfoEnd);  // another program may have cut the file
    const std::uint64_t packed = number_at(head, kInfoAt + 10, 8, ByteOrder::big);
    const std::uint64_t others = packed & ~std::uint64_t{0xF'FFFF'FFFF};
    head.replace(
        kInfoAt + 10, 8, bytes_of(others | static_cast<std::uint64_t>(total), 8, ByteOrder::big));
    return file.with_head(std::move(head), static_cast<std::int64_t>(kInfoEnd));
}

}  // namespace

FlacLength read_flac_length(const FileWindow& file) {
    FlacLength length{.window = file};
    const auto info = read_stream_info(file.bytes(0, kInfoEnd));
    if (!info) {
        return length;
    }
    length.claimed = static_cast<std::int64_t>(info->total);
    length.found = last_end(file, *info);
    find_starts(file, length.starts);
    const bool is_one = length.starts.size() == 1;
    if (is_one && length.found > length.claimed && length.found < std::int64_t{1} << 36U) {
        length.window = with_total(file, length.found);
    }
    return length;
}

}  // namespace raks::audio
