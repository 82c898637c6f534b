#include "render/gl/mipmaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace raks::render::gl {
namespace {

constexpr std::size_t kPixel = 4;  // bytes

// Four pixels around a corner of the larger picture.
struct Corner {
    const std::uint8_t* pixels[4];
};

std::uint32_t word_at(const std::uint8_t* pixel) noexcept {
    std::uint32_t word = 0;
    std::memcpy(&word, pixel, sizeof(word));
    return word;
}

// Means of all four bytes at once: sums of bytes that are 16 bits apart do not meet.
void mean_of_bytes(const Corner& corner, std::uint8_t* out) noexcept {
    constexpr std::uint32_t kEven = 0x00FF00FFU;
    constexpr std::uint32_t kHalves = 0x00020002U;
    std::uint32_t low = kHalves;
    std::uint32_t high = kHalves;
    for (const std::uint8_t* pixel : corner.pixels) {
        const std::uint32_t word = word_at(pixel);
        low += word & kEven;
        high += word >> 8U & kEven;
    }
    const std::uint32_t mean = (low >> 2U & kEven) | (high >> 2U & kEven) << 8U;
    std::memcpy(out, &mean, sizeof(mean));
}

// sRGB to light in 4095 steps and back, by tables.
struct LightTables {
    static constexpr std::size_t kSteps = 4096;
    std::array<std::uint16_t, 256> light{};
    std::array<std::uint8_t, kSteps> shown{};

    LightTables() {
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double c = static_cast<double>(i) / 255.0;
            const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
            light[i] = static_cast<std::uint16_t>(std::lround(linear * (kSteps - 1)));
        }
        for (std::size_t i = 0; i < kSteps; ++i) {
            const double linear = static_cast<double>(i) / (kSteps - 1);
            const double c =
                linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
            shown[i] = static_cast<std::uint8_t>(std::lround(255.0 * c));
        }
    }
};

void mean_of_light(const LightTables& tables, const Corner& corner, std::uint8_t* out) noexcept {
    mean_of_bytes(corner, out);  // opacity, and all of it where the four are the same
    const std::uint32_t first = word_at(corner.pixels[0]);
    if (first == word_at(corner.pixels[1]) && first == word_at(corner.pixels[2]) &&
        first == word_at(corner.pixels[3])) {
        return;
    }
    for (std::size_t c = 0; c + 1 < kPixel; ++c) {
        std::size_t sum = 2;
        for (const std::uint8_t* pixel : corner.pixels) {
            sum += tables.light[pixel[c]];
        }
        out[c] = tables.shown[sum / 4];
    }
}

// A picture half as large.
template <typename Mean>
MipLevel halved(int width, int height, std::span<const std::uint8_t> rgba, const Mean& mean) {
    MipLevel half{std::max(width / 2, 1), std::max(height / 2, 1), {}};
    const auto row = static_cast<std::size_t>(width) * kPixel;
    half.rgba.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height) *
                     kPixel);
    // A side of one pixel has no second.
    const std::size_t right = width > 1 ? kPixel : 0;
    const std::size_t below = height > 1 ? row : 0;
    std::uint8_t* out = half.rgba.data();
    for (int y = 0; y < half.height; ++y) {
        const std::uint8_t* in = rgba.data() + static_cast<std::size_t>(2 * y) * below;
        for (int x = 0; x < half.width; ++x) {
            mean(Corner{{in, in + right, in + below, in + below + right}}, out);
            in += 2 * right;
            out += kPixel;
        }
    }
    return half;
}

}  // namespace

std::vector<MipLevel> mipmaps(int width,
                              int height,
                              std::span<const std::uint8_t> rgba,
                              MipColours colours) {
    static const LightTables kTables;
    std::vector<MipLevel> levels;
    while (width > 1 || height > 1) {
        levels.push_back(colours == MipColours::linear
                             ? halved(width,
                                      height,
                                      rgba,
                                      [](const Corner& corner, std::uint8_t* out) {
                                          mean_of_light(kTables, corner, out);
                                      })
                             : halved(width, height, rgba, mean_of_bytes));
        width = levels.back().width;
        height = levels.back().height;
        rgba = levels.back().rgba;
    }
    return levels;
}

}  // namespace raks::render::gl
