#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "render/import/plain_bytes.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kTgaHead = 18;

/// The head of a TGA.
struct TgaHead {
    std::uint32_t id_bytes = 0;
    bool has_palette = false;
    std::uint32_t kind = 0;  ///< without kPackedBit
    bool is_packed = false;
    std::uint32_t palette_first = 0;
    std::uint32_t palette_count = 0;
    std::uint32_t palette_bits = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t bits = 0;
    bool is_from_right = false;
    bool is_from_top = false;
};

constexpr std::uint32_t kPalette = 1;
constexpr std::uint32_t kColours = 2;
constexpr std::uint32_t kGrey = 3;
constexpr std::uint32_t kPackedBit = 8;

TgaHead tga_head_of(std::span<const std::byte> bytes) {
    const std::uint32_t kind = plain_number(bytes, 2, 1);
    const std::uint32_t ways = plain_number(bytes, 17, 1);
    return {.id_bytes = plain_number(bytes, 0, 1),
            .has_palette = plain_number(bytes, 1, 1) == 1,
            .kind = kind & ~kPackedBit,
            .is_packed = (kind & kPackedBit) != 0,
            .palette_first = plain_number(bytes, 3, 2),
            .palette_count = plain_number(bytes, 5, 2),
            .palette_bits = plain_number(bytes, 7, 1),
            .width = plain_number(bytes, 12, 2),
            .height = plain_number(bytes, 14, 2),
            .bits = plain_number(bytes, 16, 1),
            .is_from_right = (ways & 16U) != 0,
            .is_from_top = (ways & 32U) != 0};
}

bool are_colour_bits(std::uint32_t bits) {
    return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

bool is_known(const TgaHead& head) {
    switch (head.kind) {
        case kPalette:
            return head.has_palette && head.bits == 8 && are_colour_bits(head.palette_bits);
        case kColours:
            return are_colour_bits(head.bits);
        case kGrey:
            return head.bits == 8 || head.bits == 16;
        default:
            return false;
    }
}

/// A colour of 15 to 32 bits: blue is lowest.
PlainPixel colour_of(std::uint32_t value, std::uint32_t bits) {
    if (bits <= 16) {
        return {
            from_five_bits(value >> 10U), from_five_bits(value >> 5U), from_five_bits(value), 255};
    }
    return {static_cast<std::uint8_t>(value >> 16U),
            static_cast<std::uint8_t>(value >> 8U),
            static_cast<std::uint8_t>(value),
            static_cast<std::uint8_t>(bits == 32 ? value >> 24U : 255U)};
}

/// Pixels one after the other, as they are in the file.
class TgaPixels {
 public:
    TgaPixels(const TgaHead& head, std::span<const std::byte> bytes) : head_(head), bytes_(bytes) {
        at_ = kTgaHead + head.id_bytes;
        const std::size_t width = (head.palette_bits + 7) / 8;
        for (std::uint32_t i = 0; head.has_palette && i < head.palette_count; ++i) {
            palette_.push_back(
                colour_of(plain_number(bytes, at_ + i * width, width), head.palette_bits));
        }
        at_ += head.has_palette ? head.palette_count * width : 0;
    }

    /// False: it is cut.
    bool next(PlainPixel& pixel) {
        if (head_.is_packed && left_ == 0) {
            if (at_ >= bytes_.size()) {
                return false;
            }
            const std::uint32_t packet = plain_number(bytes_, at_++, 1);
            left_ = (packet & 127U) + 1;
            is_repeated_ = (packet & 128U) != 0;
            is_known_ = false;
        }
        if (!is_repeated_ || !is_known_) {
            const std::size_t width = (head_.bits + 7) / 8;
            if (at_ > bytes_.size() || width > bytes_.size() - at_) {
                return false;
            }
            last_ = pixel_of(plain_number(bytes_, at_, width));
            is_known_ = true;
            at_ += width;
        }
        left_ -= head_.is_packed ? 1 : 0;
        pixel = last_;
        return true;
    }

 private:
    [[nodiscard]] PlainPixel pixel_of(std::uint32_t value) const {
        if (head_.kind == kColours) {
            return colour_of(value, head_.bits);
        }
        if (head_.kind == kGrey) {
            const auto grey = static_cast<std::uint8_t>(value);
            return {
                grey, grey, grey, static_cast<std::uint8_t>(head_.bits == 16 ? value >> 8U : 255U)};
        }
        const std::uint32_t index = value - head_.palette_first;
        return index < palette_.size() ? palette_[index] : PlainPixel{0, 0, 0, 255};
    }

    const TgaHead& head_;
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    std::vector<PlainPixel> palette_;
    std::uint32_t left_ = 0;  ///< of a packet
    bool is_repeated_ = false;
    bool is_known_ = false;  ///< the packet's pixel
    PlainPixel last_{};
};

}  // namespace

Expected<Image> read_tga(std::span<const std::byte> bytes) {
    const TgaHead head = tga_head_of(bytes);
    if (bytes.size() < kTgaHead || !is_known(head)) {
        return fail("is not a TGA of a kind that is read");
    }
    auto image = blank_picture(head.width, head.height);
    if (!image) {
        return image;
    }
    TgaPixels pixels(head, bytes);
    PlainPixel pixel{};
    for (int y = 0; y < image->height; ++y) {
        for (int x = 0; x < image->width; ++x) {
            if (!pixels.next(pixel)) {
                return fail("is a TGA that is cut off");
            }
            set_pixel(*image,
                      head.is_from_right ? image->width - 1 - x : x,
                      head.is_from_top ? y : image->height - 1 - y,
                      pixel);
        }
    }
    return image;
}

}  // namespace raks::render
