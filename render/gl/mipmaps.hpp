#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace raks::render::gl {

/// A smaller copy of a picture.
struct MipLevel {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4 bytes
};

/// How the bytes of a picture are averaged.
enum class MipColours {
    as_they_are,  ///< of numbers: linear colours, normals, masks
    linear,       ///< of shown (sRGB) colours: their light is averaged, opacity as it is
};

/// All smaller copies of a picture, each half as wide and high (rounded down, at least 1) as the
/// one before, by the mean of two by two pixels. On the processor: a software driver takes ten
/// times as long for its own. `rgba`: width * height * 4 bytes. Threads: any. Real-time: no.
[[nodiscard]] std::vector<MipLevel> mipmaps(int width,
                                            int height,
                                            std::span<const std::uint8_t> rgba,
                                            MipColours colours);

}  // namespace raks::render::gl
