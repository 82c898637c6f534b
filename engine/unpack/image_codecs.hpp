#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace raks::engine {

/// What a library said, kept where a jump out of it may pass.
struct CodecFault {
    std::array<char, 200> text{};  ///< what libjpeg says at most
};

/// Where the pixels of a picture go: red, green, blue and opacity, a byte each, line after line.
struct PictureRoom {
    int width = 0;  ///< pixels, as its head says; at least 1
    int height = 0;
    std::span<std::byte> pixels;  ///< width x height x 4
};

/// Unpack into `room`. False: broken, or of another size, and `fault` says how; the pixels are then
/// of no use. Threads: any. Real-time: no.
bool unpack_png(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault);
bool unpack_jpeg(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault);
bool unpack_webp(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault);

}  // namespace raks::engine
