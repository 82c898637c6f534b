#include "engine/decode/picture_converter.hpp"

extern "C" {
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <string>
#include <utility>

namespace raks::engine {
namespace {

constexpr std::size_t kChannels = 3;
constexpr int kLinesOfHighDefinition = 720;
// Interpolated colour and exact sums. Not "bilinear", whose colour lies half a pixel too low, and
// not "fast bilinear", which makes code at run time.
constexpr int kFlags =
    SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_BITEXACT;

int matrix_of(const AVFrame& frame) {
    switch (frame.colorspace) {
        case AVCOL_SPC_BT709:
            return SWS_CS_ITU709;
        case AVCOL_SPC_BT2020_NCL:
        case AVCOL_SPC_BT2020_CL:
            return SWS_CS_BT2020;
        case AVCOL_SPC_SMPTE240M:
            return SWS_CS_SMPTE240M;
        case AVCOL_SPC_FCC:
            return SWS_CS_FCC;
        case AVCOL_SPC_BT470BG:
        case AVCOL_SPC_SMPTE170M:
            return SWS_CS_ITU601;
        default:
            break;
    }
    const bool is_photo = frame.color_range == AVCOL_RANGE_JPEG;
    return frame.height >= kLinesOfHighDefinition && !is_photo ? SWS_CS_ITU709 : SWS_CS_ITU601;
}

// Where colour that is halved was taken, in 1/256 of a pixel of the luma's.
struct ChromaPlace {
    int x = 0;
    int y = 128;
};

ChromaPlace place_of(const AVFrame& frame) {
    switch (frame.chroma_location) {
        case AVCHROMA_LOC_CENTER:
            return {128, 128};
        case AVCHROMA_LOC_TOPLEFT:
            return {0, 0};
        case AVCHROMA_LOC_TOP:
            return {128, 0};
        case AVCHROMA_LOC_UNSPECIFIED:
            // Photographs in the middle, films at the left.
            return frame.color_range == AVCOL_RANGE_JPEG ? ChromaPlace{128, 128} : ChromaPlace{};
        default:
            return {};
    }
}

// One that says its range by the old names of pixel formats is put under the new ones, for which
// swscale has no warning.
AVPixelFormat plain_format(int format) {
    switch (format) {
        case AV_PIX_FMT_YUVJ420P:
            return AV_PIX_FMT_YUV420P;
        case AV_PIX_FMT_YUVJ422P:
            return AV_PIX_FMT_YUV422P;
        case AV_PIX_FMT_YUVJ444P:
            return AV_PIX_FMT_YUV444P;
        case AV_PIX_FMT_YUVJ440P:
            return AV_PIX_FMT_YUV440P;
        default:
            return static_cast<AVPixelFormat>(format);
    }
}

bool is_full_range(const AVFrame& frame) {
    return frame.color_range == AVCOL_RANGE_JPEG || plain_format(frame.format) != frame.format;
}

// Reads the stored picture in the order in which the seen one is written.
void turn(std::span<const std::uint8_t> stored,
          const AVFrame& frame,
          Orientation orientation,
          std::span<std::uint8_t> seen) {
    const auto stored_width = static_cast<std::ptrdiff_t>(frame.width);
    const auto stored_height = static_cast<std::ptrdiff_t>(frame.height);
    const std::ptrdiff_t width = orientation.is_transposed ? stored_height : stored_width;
    const std::ptrdiff_t height = orientation.is_transposed ? stored_width : stored_height;
    std::ptrdiff_t step_x = kChannels;
    std::ptrdiff_t step_y = stored_width * static_cast<std::ptrdiff_t>(kChannels);
    if (orientation.is_transposed) {
        std::swap(step_x, step_y);
    }
    std::ptrdiff_t start = 0;
    if (orientation.is_x_reversed) {
        start += step_x * (width - 1);
        step_x = -step_x;
    }
    if (orientation.is_y_reversed) {
        start += step_y * (height - 1);
        step_y = -step_y;
    }
    std::uint8_t* to = seen.data();
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        const std::uint8_t* from = stored.data() + start + y * step_y;
        for (std::ptrdiff_t x = 0; x < width; ++x, from += step_x) {
            to = std::copy_n(from, kChannels, to);
        }
    }
}

}  // namespace

PictureConverter::PictureConverter() = default;
PictureConverter::~PictureConverter() { sws_freeContext(context_); }

Expected<void> PictureConverter::prepare(const AVFrame& frame) {
    SwsContext* const fresh = sws_alloc_context();
    if (fresh == nullptr) {
        return fail("no memory to convert its pictures");
    }
    const ChromaPlace place = place_of(frame);
    const auto set = [fresh](const char* name, int value) {
        av_opt_set_int(fresh, name, value, 0);
    };
    set("srcw", frame.width);
    set("srch", frame.height);
    set("src_format", plain_format(frame.format));
    set("src_range", is_full_range(frame) ? 1 : 0);
    set("dstw", frame.width);
    set("dsth", frame.height);
    set("dst_format", AV_PIX_FMT_RGB24);
    set("dst_range", 1);
    set("sws_flags", kFlags);
    set("src_h_chr_pos", place.x);
    set("src_v_chr_pos", place.y);
    // Before sws_init_context(), which chooses the conversion by it.
    const int* const matrix = sws_getCoefficients(matrix_of(frame));
    constexpr int kOne = 1 << 16;
    sws_setColorspaceDetails(fresh, matrix, is_full_range(frame) ? 1 : 0, matrix, 1, 0, kOne, kOne);
    sws_freeContext(context_);
    context_ = fresh;
    if (sws_init_context(fresh, nullptr, nullptr) < 0) {
        const char* const name = av_get_pix_fmt_name(static_cast<AVPixelFormat>(frame.format));
        return fail(std::string("its pixels (") + (name == nullptr ? "unknown" : name) +
                    ") cannot be converted");
    }
    return {};
}

Expected<std::span<const std::uint8_t>> PictureConverter::to_rgb(const AVFrame& frame,
                                                                 Orientation orientation) {
    constexpr std::size_t kWrittenAtOnce = 64;  // bytes, by swscale, also behind the last row
    const auto width = static_cast<std::size_t>(frame.width);
    const auto height = static_cast<std::size_t>(frame.height);
    const std::size_t bytes = width * height * kChannels;
    if (width_ != frame.width || height_ != frame.height || format_ != frame.format) {
        if (auto prepared = prepare(frame); !prepared) {
            return fail(prepared.error());
        }
        width_ = frame.width;
        height_ = frame.height;
        format_ = frame.format;
        stored_.resize(bytes + kWrittenAtOnce);
    }
    std::uint8_t* const rows[] = {stored_.data()};
    const int strides[] = {frame.width * static_cast<int>(kChannels)};
    if (sws_scale(context_, frame.data, frame.linesize, 0, frame.height, rows, strides) !=
        frame.height) {
        return fail("a picture cannot be converted");
    }
    if (!orientation.turns()) {
        return std::span<const std::uint8_t>(stored_).first(bytes);
    }
    seen_.resize(bytes);
    turn(stored_, frame, orientation, seen_);
    return std::span<const std::uint8_t>(seen_);
}

}  // namespace raks::engine
