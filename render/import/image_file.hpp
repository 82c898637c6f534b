#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "render/import/model_unpacker.hpp"
#include "render/model/image.hpp"

/// Pictures of unknown origin: PNG, JPEG, WebP. What a head claims is checked before anything is
/// unpacked, in a process of its own. Threads: any. Real-time: no.
namespace raks::render {

inline constexpr int kLargestImageSide = 8192;  ///< pixels

enum class ImageFormat : std::uint8_t { png, jpeg, webp };

struct ImageHead {
    ImageFormat format = ImageFormat::png;
    int width = 0;  ///< pixels, 1 .. kLargestImageSide
    int height = 0;
};

/// Looks at the head, and whether a PNG is whole. Errors: none of the formats, cut, a side of 0 or
/// above kLargestImageSide, moving pictures.
[[nodiscard]] Expected<ImageHead> look_at_image(std::span<const std::byte> packed);

/// Unpacks, by `unpacker`. `halvings`: so many times each side is halved, by the mean of four
/// pixels (never below 1). Errors: as look_at_image and ModelUnpacker::unpack.
[[nodiscard]] Expected<Image> decode_image(ModelUnpacker& unpacker,
                                           std::span<const std::byte> packed,
                                           int halvings = 0);

}  // namespace raks::render
