// Pictures of old formats, which glTF does not have: BMP and TGA, by readers of our own.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/model/image.hpp"

namespace raks::render {

/// Whether a picture says that it is BMP, or TGA: by its last bytes, or, as most have none, by the
/// ending of its name.
[[nodiscard]] bool is_plain_picture(std::span<const std::byte> bytes, std::string_view name);

/// The pixels. BMP: 1, 4, 8, 16, 24 and 32 bits, also by masks, not packed. TGA: colours, grey and
/// palettes of 8 to 32 bits, packed or not. A picture that is clear everywhere is taken as not
/// clear at all: programs leave that byte 0. Errors: cut, another kind, a side of 0 or above
/// kLargestImageSide, more than 16.7 megapixels. Threads: any. Real-time: no.
[[nodiscard]] Expected<Image> read_plain_picture(std::span<const std::byte> bytes);

/// The same picture as PNG, for whatever reads models. Errors: those of read_plain_picture.
[[nodiscard]] Expected<std::vector<std::byte>> png_of_plain_picture(
    std::span<const std::byte> bytes);

}  // namespace raks::render
