#include "render/import/image_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace raks::render {
namespace {

std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value = (value << 8U) | std::to_integer<std::uint32_t>(bytes[at + i]);
    }
    return value;
}

bool begins_with(std::span<const std::byte> bytes, std::string_view start) {
    return bytes.size() >= start.size() &&
           std::equal(start.begin(), start.end(), bytes.begin(), [](char c, std::byte b) {
               return static_cast<std::byte>(c) == b;
           });
}

/// The head of a JPEG: frame after frame to the one with the size. Nothing: cut, or none.
Expected<ImageHead> look_at_jpeg(std::span<const std::byte> bytes) {
    std::size_t at = 2;
    while (at + 9 <= bytes.size() && big_endian(bytes, at, 1) == 0xFF) {
        const std::uint32_t marker = big_endian(bytes, at + 1, 1);
        if (marker == 0xFF) {
            ++at;
            continue;
        }
        const bool has_size =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (has_size) {
            return ImageHead{.format = ImageFormat::jpeg,
                             .width = static_cast<int>(big_endian(bytes, at + 7, 2)),
                             .height = static_cast<int>(big_endian(bytes, at + 5, 2))};
        }
        at += 2 + big_endian(bytes, at + 2, 2);
    }
    return fail("is a JPEG that is cut off");
}

/// A number of `count` bytes, the lowest first.
std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i > 0; --i) {
        value = (value << 8U) | std::to_integer<std::uint32_t>(bytes[at + i - 1]);
    }
    return value;
}

/// The head of a WebP: of its canvas, or of its one picture, lossy or not.
Expected<ImageHead> look_at_webp(std::span<const std::byte> bytes) {
    constexpr std::size_t kHead = 30;
    constexpr std::uint32_t kStart = 0x2A019D;   // of a lossy picture
    constexpr std::uint32_t kPlainStart = 0x2F;  // of another
    constexpr std::uint32_t kSide = 0x3FFF;
    constexpr std::uint32_t kMoves = 2;
    const auto head = [](std::uint32_t width, std::uint32_t height) {
        return ImageHead{.format = ImageFormat::webp,
                         .width = static_cast<int>(width),
                         .height = static_cast<int>(height)};
    };
    const auto chunk = bytes.subspan(std::min<std::size_t>(bytes.size(), 12));
    if (begins_with(chunk, "VP8X") && bytes.size() >= kHead) {
        if ((little_endian(bytes, 20, 1) & kMoves) != 0) {
            return fail("is a moving WebP, which is not read");
        }
        return head(little_endian(bytes, 24, 3) + 1, little_endian(bytes, 27, 3) + 1);
    }
    if (begins_with(chunk, "VP8L") && bytes.size() >= 25 &&
        little_endian(bytes, 20, 1) == kPlainStart) {
        const std::uint32_t sides = little_endian(bytes, 21, 4);
        return head((sides & kSide) + 1, ((sides >> 14U) & kSide) + 1);
    }
    if (begins_with(chunk, "VP8 ") && bytes.size() >= kHead &&
        little_endian(bytes, 23, 3) == kStart) {
        return head(little_endian(bytes, 26, 2) & kSide, little_endian(bytes, 28, 2) & kSide);
    }
    return fail("is a WebP that is cut off or damaged");
}

/// Whether all chunks of a PNG are there, up to its end.
bool is_whole_png(std::span<const std::byte> bytes) {
    constexpr std::uint32_t kEnd = 0x49454E44;  // "IEND"
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t length = big_endian(bytes, at, 4);
        if (length > bytes.size() - at - 12) {
            return false;
        }
        if (big_endian(bytes, at + 4, 4) == kEnd) {
            return true;
        }
        at += length + 12;
    }
    return false;
}

Expected<ImageHead> look_by_format(std::span<const std::byte> bytes) {
    using namespace std::string_view_literals;
    constexpr std::size_t kPngHead = 33;
    if (begins_with(bytes, "\x89PNG\r\n\x1a\n"sv)) {
        if (bytes.size() < kPngHead || !is_whole_png(bytes)) {
            return fail("is a PNG that is cut off");
        }
        constexpr std::uint32_t kNoInt = 0x80000000U;
        const std::uint32_t width = big_endian(bytes, 16, 4);
        const std::uint32_t height = big_endian(bytes, 20, 4);
        if (width >= kNoInt || height >= kNoInt) {
            return fail("is a PNG of an impossible size");
        }
        return ImageHead{.format = ImageFormat::png,
                         .width = static_cast<int>(width),
                         .height = static_cast<int>(height)};
    }
    if (begins_with(bytes, "\xFF\xD8\xFF"sv)) {
        return look_at_jpeg(bytes);
    }
    if (begins_with(bytes, "RIFF"sv) && bytes.size() > 12 &&
        begins_with(bytes.subspan(8), "WEBP"sv)) {
        return look_at_webp(bytes);
    }
    return fail("is neither PNG nor JPEG nor WebP");
}

/// Half as wide and high; of an odd side the last pixel stands for two.
Image halved(const Image& image) {
    Image half{.width = std::max(1, image.width / 2),
               .height = std::max(1, image.height / 2),
               .pixels = {}};
    half.pixels.resize(static_cast<std::size_t>(half.width) *
                       static_cast<std::size_t>(half.height) * 4);
    const auto at = [&](int x, int y, std::size_t channel) -> unsigned {
        const auto column = static_cast<std::size_t>(std::min(x, image.width - 1));
        const auto row = static_cast<std::size_t>(std::min(y, image.height - 1));
        return image.pixels[(row * static_cast<std::size_t>(image.width) + column) * 4 + channel];
    };
    std::uint8_t* out = half.pixels.data();
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            for (std::size_t c = 0; c < 4; ++c) {
                const unsigned sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) +
                                     at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
                *out++ = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return half;
}

}  // namespace

Expected<ImageHead> look_at_image(std::span<const std::byte> packed) {
    auto head = look_by_format(packed);
    if (!head) {
        return head;
    }
    if (head->width < 1 || head->height < 1 || head->width > kLargestImageSide ||
        head->height > kLargestImageSide) {
        return fail(fmt::format("has {} x {} pixels; sides of 1 to {} are read",
                                head->width,
                                head->height,
                                kLargestImageSide));
    }
    return head;
}

Expected<Image> decode_image(ModelUnpacker& unpacker,
                             std::span<const std::byte> packed,
                             int halvings) {
    const auto head = look_at_image(packed);
    if (!head) {
        return fail(head.error());
    }
    Image image{.width = head->width, .height = head->height, .pixels = {}};
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height) * 4);
    constexpr std::array<PackedKind, 3> kKinds = {
        PackedKind::png, PackedKind::jpeg, PackedKind::webp};
    const UnpackRequest what{.kind = kKinds[static_cast<std::size_t>(head->format)],
                             .row_bytes = static_cast<std::uint32_t>(image.width) * 4,
                             .rows = static_cast<std::uint64_t>(image.height)};
    if (const auto done =
            unpacker.unpack(what, packed, std::as_writable_bytes(std::span(image.pixels)));
        !done) {
        return fail(fmt::format("cannot be unpacked: {}", done.error().message));
    }
    for (int i = 0; i < halvings && (image.width > 1 || image.height > 1); ++i) {
        image = halved(image);
    }
    return image;
}

}  // namespace raks::render
