#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/import/image.hpp"

namespace raks::render {

/// What a library said, kept where a jump out of it may pass.
struct CodecFault {
    std::array<char, 200> text{};  ///< what libjpeg says at most
};

/// Unpack into `image`, which has the size of the head and room for its pixels. False: broken, and
/// `fault` says how; the pixels are then of no use. Threads: any. Real-time: no.
bool unpack_png(std::span<const std::byte> packed, Image& image, CodecFault& fault);
bool unpack_jpeg(std::span<const std::byte> packed, Image& image, CodecFault& fault);
bool unpack_webp(std::span<const std::byte> packed, Image& image, CodecFault& fault);

/// Packs a picture as PNG, fast rather than small. Errors: what libpng says. Threads: any.
/// Real-time: no.
[[nodiscard]] Expected<std::vector<std::byte>> pack_png(const Image& image);

/// The head of a WebP file.
[[nodiscard]] Expected<ImageHead> look_at_webp(std::span<const std::byte> packed);

}  // namespace raks::render
