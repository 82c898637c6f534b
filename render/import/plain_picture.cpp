#include "render/import/plain_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "render/import/characters.hpp"
#include "render/import/image_file.hpp"
#include "render/import/plain_bytes.hpp"
#include "render/import/png_packer.hpp"

namespace raks::render {
namespace {

constexpr std::string_view kBmpStart = "BM";
constexpr std::string_view kTgaEnd{"TRUEVISION-XFILE.\0", 18};

bool is_bmp(std::span<const std::byte> bytes) {
    return characters_of(bytes).substr(0, kBmpStart.size()) == kBmpStart;
}

bool ends_like_tga(std::string_view name) {
    constexpr std::string_view kEnding = ".tga";
    const std::string_view end = name.substr(name.size() - std::min(name.size(), kEnding.size()));
    return std::equal(
        end.begin(), end.end(), kEnding.begin(), kEnding.end(), [](unsigned char a, char b) {
            return std::tolower(a) == b;
        });
}

/// A picture that is nowhere opaque was meant to be opaque.
void mend_opacity(Image& image) {
    bool is_clear = true;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
        is_clear = is_clear && image.pixels[i] == 0;
    }
    for (std::size_t i = 3; is_clear && i < image.pixels.size(); i += 4) {
        image.pixels[i] = 0xFF;
    }
}

}  // namespace

Expected<Image> blank_picture(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t kMostPlainPixels = 1 << 24;
    if (width < 1 || height < 1 || width > kLargestImageSide || height > kLargestImageSide ||
        width * height > kMostPlainPixels) {
        return fail(fmt::format("has {} x {} pixels; sides of 1 to {} and up to {} pixels are read",
                                width,
                                height,
                                kLargestImageSide,
                                kMostPlainPixels));
    }
    Image image{.width = static_cast<int>(width), .height = static_cast<int>(height), .pixels = {}};
    image.pixels.resize(static_cast<std::size_t>(width * height) * 4);
    return image;
}

bool is_plain_picture(std::span<const std::byte> bytes, std::string_view name) {
    const std::string_view text = characters_of(bytes);
    const bool has_tga_end =
        text.size() > kTgaEnd.size() && text.substr(text.size() - kTgaEnd.size()) == kTgaEnd;
    return is_bmp(bytes) || has_tga_end || ends_like_tga(name);
}

Expected<Image> read_plain_picture(std::span<const std::byte> bytes) {
    auto image = is_bmp(bytes) ? read_bmp(bytes) : read_tga(bytes);
    if (image) {
        mend_opacity(*image);
    }
    return image;
}

Expected<std::vector<std::byte>> png_of_plain_picture(std::span<const std::byte> bytes) {
    const auto image = read_plain_picture(bytes);
    return image ? pack_png(*image) : fail(image.error());
}

}  // namespace raks::render
