#include "engine/unpack/image_codecs.hpp"

#include <cstdio>  // jpeglib.h needs it before

#include <jpeglib.h>
#include <png.h>
#include <webp/decode.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string_view>
#include <vector>

#include "render/import/image_file.hpp"

// libpng and libjpeg leave by longjmp. Each jump here ends in the function that called the library,
// which holds nothing with a destructor: what must be freed is the caller's.
namespace raks::engine {
namespace {

/// Chunks of a PNG that are no picture (text, profiles) may take so much.
constexpr png_alloc_size_t kLargestPngChunk = 8U << 20U;
/// A progressive JPEG of thousands of scans would keep a thread busy for minutes.
constexpr int kMostJpegScans = 200;

void keep(CodecFault& fault, const char* text) {
    const std::string_view said(text);
    const std::size_t kept = std::min(said.size(), fault.text.size() - 1);
    std::copy_n(said.begin(), kept, fault.text.begin());
    fault.text[kept] = 0;
}

/// A line of the pixels, as the libraries want it.
unsigned char* line_of(const PictureRoom& room, std::size_t y) {
    return reinterpret_cast<unsigned char*>(
        room.pixels.subspan(y * static_cast<std::size_t>(room.width) * 4).data());
}

// ---- PNG

struct PngSource {
    const std::byte* next;
    std::size_t left;
};

void read_png_bytes(png_structp png, png_bytep out, png_size_t count) {
    auto* const source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (count > source->left) {
        png_error(png, "cut");
    }
    std::memcpy(out, source->next, count);
    source->next += count;
    source->left -= count;
}

void on_png_error(png_structp png, png_const_charp text) {
    keep(*static_cast<CodecFault*>(png_get_error_ptr(png)), text);
    png_longjmp(png, 1);
}

void on_png_warning(png_structp /*png*/, png_const_charp /*text*/) {}

/// Asks for eight bits of red, green, blue and opacity, whatever the file has.
void ask_for_rgba(png_structp png, png_infop info) {
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

bool read_png(png_structp png, png_infop info, png_bytep* rows, std::size_t row_bytes) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_read_info(png, info);
    ask_for_rgba(png, info);
    if (png_get_rowbytes(png, info) != row_bytes) {
        png_error(png, "rows of another size");
    }
    png_read_image(png, rows);
    return true;
}

// ---- JPEG

struct JpegErrors {
    jpeg_error_mgr manager;  // first: libjpeg knows this part alone
    std::jmp_buf leave;
    CodecFault* fault;
};

void on_jpeg_error(j_common_ptr jpeg) {
    auto* const errors = reinterpret_cast<JpegErrors*>(jpeg->err);
    char text[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, text);
    keep(*errors->fault, text);
    std::longjmp(errors->leave, 1);
}

void on_jpeg_message(j_common_ptr /*jpeg*/, int /*level*/) {}

void on_jpeg_progress(j_common_ptr jpeg) {
    const auto* const decoder = reinterpret_cast<j_decompress_ptr>(jpeg);
    if (decoder->input_scan_number > kMostJpegScans) {
        keep(*reinterpret_cast<JpegErrors*>(jpeg->err)->fault, "too many scans");
        std::longjmp(reinterpret_cast<JpegErrors*>(jpeg->err)->leave, 1);
    }
}

bool read_jpeg(jpeg_decompress_struct& jpeg,
               JpegErrors& errors,
               jpeg_progress_mgr& progress,
               std::span<const std::byte> packed,
               const PictureRoom& room) {
    if (setjmp(errors.leave) != 0) {
        return false;
    }
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(packed.data()), packed.size());
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&jpeg);
    if (jpeg.output_width != static_cast<JDIMENSION>(room.width) ||
        jpeg.output_height != static_cast<JDIMENSION>(room.height)) {
        keep(*errors.fault, "of another size than its head says");
        return false;
    }
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = line_of(room, jpeg.output_scanline);
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

}  // namespace

bool unpack_png(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault) {
    const std::size_t row_bytes = static_cast<std::size_t>(room.width) * 4;
    std::vector<png_bytep> rows(static_cast<std::size_t>(room.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = line_of(room, y);
    }
    PngSource source{packed.data(), packed.size()};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, on_png_error, on_png_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr) {
        keep(fault, "no memory");
        png_destroy_read_struct(&png, nullptr, nullptr);
        return false;
    }
    png_set_read_fn(png, &source, read_png_bytes);
    png_set_user_limits(png, render::kLargestImageSide, render::kLargestImageSide);
    png_set_chunk_malloc_max(png, kLargestPngChunk);
    const bool is_good = read_png(png, info, rows.data(), row_bytes);
    png_destroy_read_struct(&png, &info, nullptr);
    return is_good;
}

bool unpack_jpeg(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault) {
    JpegErrors errors{};
    jpeg_decompress_struct jpeg{};
    jpeg_progress_mgr progress{};
    jpeg.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = on_jpeg_error;
    errors.manager.emit_message = on_jpeg_message;
    errors.fault = &fault;
    progress.progress_monitor = on_jpeg_progress;
    const bool is_good = read_jpeg(jpeg, errors, progress, packed, room);
    jpeg_destroy_decompress(&jpeg);
    return is_good;
}

bool unpack_webp(std::span<const std::byte> packed, const PictureRoom& room, CodecFault& fault) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(packed.data());
    int width = 0;
    int height = 0;
    // A smaller picture would leave a part of the room as it is.
    const bool is_good =
        WebPGetInfo(bytes, packed.size(), &width, &height) != 0 && width == room.width &&
        height == room.height &&
        WebPDecodeRGBAInto(
            bytes, packed.size(), line_of(room, 0), room.pixels.size(), room.width * 4) != nullptr;
    if (!is_good) {
        keep(fault, "broken WebP");
    }
    return is_good;
}

}  // namespace raks::engine
