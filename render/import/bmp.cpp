#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "render/import/plain_bytes.hpp"

namespace raks::render {
namespace {

/// The heads of a BMP. All but the oldest have the same first 40 bytes after the file's own 14.
struct BmpHead {
    std::uint32_t pixels_at = 0;
    std::uint32_t head_bytes = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;
    bool is_from_top = false;
    std::uint32_t bits = 0;
    std::uint32_t packing = 0;
    std::uint32_t colours = 0;
};

constexpr std::size_t kFileHead = 14;
constexpr std::uint32_t kOldHead = 12;
constexpr std::uint32_t kUsualHead = 40;
constexpr std::uint32_t kHeadWithMasks = 56;
constexpr std::uint32_t kPlain = 0;
constexpr std::uint32_t kByMasks = 3;

BmpHead bmp_head_of(std::span<const std::byte> bytes) {
    BmpHead head{.pixels_at = plain_number(bytes, 10, 4),
                 .head_bytes = plain_number(bytes, kFileHead, 4)};
    if (head.head_bytes == kOldHead) {
        head.width = plain_number(bytes, 18, 2);
        head.height = plain_number(bytes, 20, 2);
        head.bits = plain_number(bytes, 24, 2);
        return head;
    }
    head.width = static_cast<std::int32_t>(plain_number(bytes, 18, 4));
    const std::int64_t height = static_cast<std::int32_t>(plain_number(bytes, 22, 4));
    head.is_from_top = height < 0;
    head.height = height < 0 ? -height : height;
    head.bits = plain_number(bytes, 28, 2);
    head.packing = plain_number(bytes, 30, 4);
    head.colours = plain_number(bytes, 46, 4);
    return head;
}

/// Which bits of a pixel are a colour.
class Mask {
 public:
    Mask() = default;
    explicit Mask(std::uint32_t mask)
        : mask_(mask), shift_(mask == 0 ? 0 : std::countr_zero(mask)), most_(mask >> shift_) {}

    /// The colour in eight bits; `otherwise`: where the mask has no bits.
    [[nodiscard]] std::uint8_t of(std::uint32_t pixel, std::uint8_t otherwise) const {
        if (most_ == 0) {
            return otherwise;
        }
        const std::uint64_t value = (pixel & mask_) >> shift_;
        return static_cast<std::uint8_t>((value * 255 + most_ / 2) / most_);
    }

 private:
    std::uint32_t mask_ = 0;
    int shift_ = 0;
    std::uint32_t most_ = 0;
};

/// Red, green, blue, opacity.
std::array<Mask, 4> masks_of(std::span<const std::byte> bytes, const BmpHead& head) {
    constexpr std::size_t kMasksAt = kFileHead + kUsualHead;
    if (head.packing == kByMasks) {
        return {Mask(plain_number(bytes, kMasksAt, 4)),
                Mask(plain_number(bytes, kMasksAt + 4, 4)),
                Mask(plain_number(bytes, kMasksAt + 8, 4)),
                head.head_bytes >= kHeadWithMasks ? Mask(plain_number(bytes, kMasksAt + 12, 4))
                                                  : Mask()};
    }
    if (head.bits == 16) {
        return {Mask(31U << 10U), Mask(31U << 5U), Mask(31U), Mask()};
    }
    return {
        Mask(0xFF0000U), Mask(0xFF00U), Mask(0xFFU), head.bits == 32 ? Mask(0xFF000000U) : Mask()};
}

std::vector<PlainPixel> palette_of(std::span<const std::byte> bytes, const BmpHead& head) {
    const std::size_t most = std::size_t{1} << head.bits;
    const std::size_t count = head.colours == 0 || head.colours > most ? most : head.colours;
    const std::size_t step = head.head_bytes == kOldHead ? 3 : 4;
    std::vector<PlainPixel> palette(most, {0, 0, 0, 0xFF});
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t colour = plain_number(bytes, kFileHead + head.head_bytes + step * i, 3);
        palette[i] = {static_cast<std::uint8_t>(colour >> 16U),
                      static_cast<std::uint8_t>(colour >> 8U),
                      static_cast<std::uint8_t>(colour),
                      0xFF};
    }
    return palette;
}

/// Row after row, each a multiple of four bytes long.
void read_rows(std::span<const std::byte> rows,
               std::size_t row_bytes,
               std::span<const std::byte> file,
               const BmpHead& head,
               Image& image) {
    const bool has_palette = head.bits <= 8;
    const auto palette = has_palette ? palette_of(file, head) : std::vector<PlainPixel>();
    const auto masks = masks_of(file, head);
    for (int y = 0; y < image.height; ++y) {
        const auto row = rows.subspan(row_bytes * static_cast<std::size_t>(y), row_bytes);
        const int to = head.is_from_top ? y : image.height - 1 - y;
        for (int x = 0; x < image.width; ++x) {
            const std::size_t bit = static_cast<std::size_t>(x) * head.bits;
            const std::size_t bytes_each = (head.bits + 7) / 8;
            std::uint32_t value = plain_number(row, bit / 8, bytes_each);
            if (has_palette) {
                value = value >> (8 - head.bits - bit % 8) & ((1U << head.bits) - 1U);
                set_pixel(image, x, to, palette[value]);
            } else {
                set_pixel(image,
                          x,
                          to,
                          {masks[0].of(value, 0),
                           masks[1].of(value, 0),
                           masks[2].of(value, 0),
                           masks[3].of(value, 0xFF)});
            }
        }
    }
}

}  // namespace

Expected<Image> read_bmp(std::span<const std::byte> bytes) {
    const BmpHead head = bmp_head_of(bytes);
    if (head.head_bytes != kOldHead && head.head_bytes < kUsualHead) {
        return fail("is a BMP without a header");
    }
    const bool is_known = head.bits == 1 || head.bits == 4 || head.bits == 8 || head.bits == 16 ||
                          head.bits == 24 || head.bits == 32;
    const bool can_have_masks = head.bits == 16 || head.bits == 32;
    if (!is_known || (head.packing != kPlain && !(head.packing == kByMasks && can_have_masks))) {
        return fail(fmt::format(
            "is a BMP of {} bits, packed in way {}; save it unpacked", head.bits, head.packing));
    }
    auto image = blank_picture(head.width, head.height);
    if (!image) {
        return image;
    }
    const std::size_t row_bytes = (static_cast<std::size_t>(head.width) * head.bits + 31) / 32 * 4;
    const std::size_t all = row_bytes * static_cast<std::size_t>(head.height);
    if (head.pixels_at > bytes.size() || all > bytes.size() - head.pixels_at) {
        return fail("is a BMP that is cut off");
    }
    read_rows(bytes.subspan(head.pixels_at, all), row_bytes, bytes, head, *image);
    return image;
}

}  // namespace raks::render
