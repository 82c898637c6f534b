#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Numbers in the heads of files, in either byte order. Beyond the end of `bytes` they read as 0.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// Which byte of a number comes first.
enum class ByteOrder : std::uint8_t { little, big };

/// The number of `width` bytes (1 to 8) at `at`.
[[nodiscard]] inline std::uint64_t number_at(std::string_view bytes,
                                             std::size_t at,
                                             std::size_t width,
                                             ByteOrder order) noexcept {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t place = at + (order == ByteOrder::big ? i : width - 1 - i);
        const auto byte =
            place < bytes.size() ? static_cast<unsigned char>(bytes[place]) : std::uint8_t{0};
        value = value << 8U | byte;
    }
    return value;
}

/// The number as `width` bytes.
[[nodiscard]] inline std::string bytes_of(std::uint64_t value, std::size_t width, ByteOrder order) {
    std::string bytes(width, '\0');
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t place = order == ByteOrder::big ? width - 1 - i : i;
        bytes[place] = static_cast<char>(value >> 8U * i & 0xFFU);
    }
    return bytes;
}

}  // namespace raks::audio
