// Chroma: the colour of a pixel without its brightness, in the two forms that markers are told by.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec2.hpp>

namespace raks::capture {

/// A picture that somebody else holds.
struct PictureView {
    int width = 0;                      ///< pixels, >= 1
    int height = 0;                     ///< likewise
    std::span<const std::uint8_t> rgb;  ///< width x height x 3, top row first, full range

    /// Red, green and blue of a pixel, which must lie in the picture.
    [[nodiscard]] const std::uint8_t* at(int x, int y) const noexcept {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x));
    }
};

/// How a colour is measured. Under less light Y, Cr - 128 and Cb - 128 shrink alike.
enum class ChromaForm : std::uint8_t {
    /// 100 (Cr - 128) / (Y + 8), 100 (Cb - 128) / (Y + 8): the same in light and shade; 8 tames
    /// dark pixels. None where Y < 16, or a channel is burnt out (>= 250).
    normalised,
    /// Cr and Cb as they are (Ofli et al. 2008): a colour is a ray, whose Gaussian takes an eighth
    /// of a usual background with it.
    crcb,
};

/// Luma and chroma of BT.601 at full range (JPEG's), [0, 255].
struct LumaChroma {
    double y = 0.0;   ///< luma
    double cr = 0.0;  ///< red minus luma, 128: grey
    double cb = 0.0;  ///< blue minus luma, 128: grey

    /// Of a pixel.
    [[nodiscard]] static LumaChroma of(const std::uint8_t* rgb) noexcept {
        const double y = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
        return {y, 128.0 + 0.713267 * (rgb[0] - y), 128.0 + 0.564334 * (rgb[2] - y)};
    }
};

/// Chroma of this form, of any pixel.
[[nodiscard]] inline glm::dvec2 plain_chroma(const LumaChroma& pixel, ChromaForm form) noexcept {
    if (form == ChromaForm::crcb) {
        return {pixel.cr, pixel.cb};
    }
    const double scale = 100.0 / (pixel.y + 8.0);
    return {(pixel.cr - 128.0) * scale, (pixel.cb - 128.0) * scale};
}

/// What chroma_of() does not take.
inline constexpr double kDarkestLuma = 16.0;
inline constexpr std::uint8_t kBurntOut = 250;

/// Is a channel at its end, so that the colour is not what it was?
[[nodiscard]] inline bool is_burnt_out(const std::uint8_t* rgb) noexcept {
    return rgb[0] >= kBurntOut || rgb[1] >= kBurntOut || rgb[2] >= kBurntOut;
}

/// Chroma of a pixel; none where it tells no colour. Threads: any.
[[nodiscard]] inline std::optional<glm::dvec2> chroma_of(const std::uint8_t* rgb,
                                                         ChromaForm form) noexcept {
    const LumaChroma pixel = LumaChroma::of(rgb);
    if (form == ChromaForm::normalised && (pixel.y < kDarkestLuma || is_burnt_out(rgb))) {
        return std::nullopt;
    }
    return plain_chroma(pixel, form);
}

}  // namespace raks::capture
