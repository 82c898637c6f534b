// Parts of the readers of BMP and TGA.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/expected.hpp"
#include "render/model/image.hpp"

namespace raks::render {

/// A pixel: red, green, blue, opacity.
using PlainPixel = std::array<std::uint8_t, 4>;

/// A number of `count` bytes, the lowest first; what is beyond the end is 0.
[[nodiscard]] inline std::uint32_t plain_number(std::span<const std::byte> bytes,
                                                std::size_t at,
                                                std::size_t count) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count && i < bytes.size() && at < bytes.size() - i; ++i) {
        number |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8U * i);
    }
    return number;
}

/// Five bits of a colour as eight.
[[nodiscard]] constexpr std::uint8_t from_five_bits(std::uint32_t value) {
    const std::uint32_t five = value & 31U;
    return static_cast<std::uint8_t>(five << 3U | five >> 2U);
}

/// Puts a pixel where it stands, counted from the upper left.
inline void set_pixel(Image& image, int x, int y, const PlainPixel& pixel) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
             static_cast<std::size_t>(x));
    for (std::size_t i = 0; i < pixel.size(); ++i) {
        image.pixels[at + i] = pixel[i];
    }
}

/// A picture of that size, black and clear. Errors: the size.
[[nodiscard]] Expected<Image> blank_picture(std::int64_t width, std::int64_t height);

/// Errors: as read_plain_picture.
[[nodiscard]] Expected<Image> read_bmp(std::span<const std::byte> bytes);
[[nodiscard]] Expected<Image> read_tga(std::span<const std::byte> bytes);

}  // namespace raks::render
