#include "render/video/png.hpp"

#include <png.h>

#include <csetjmp>
#include <string>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"

namespace raks::render {
namespace {

/// Bytes that libpng writes, and its error as text.
struct Sink {
    std::string bytes;
    std::string error;
};

/// libpng's write function: collects the bytes in memory.
void append(png_structp png, png_bytep data, png_size_t size) {
    auto* const sink = static_cast<Sink*>(png_get_io_ptr(png));
    sink->bytes.append(reinterpret_cast<const char*>(data), size);
}

/// libpng's error function must not return: it jumps back to `encode`.
void keep_error(png_structp png, png_const_charp text) {
    static_cast<Sink*>(png_get_error_ptr(png))->error = text;
    png_longjmp(png, 1);
}

/// Else libpng writes them to stderr.
void ignore_warning(png_structp, png_const_charp) {}

/// libpng leaves by longjmp: nothing with a destructor may be made in here after setjmp.
void encode(png_structp png,
            png_infop info,
            png_uint_32 width,
            png_uint_32 height,
            png_bytepp rows,
            int level) {
    if (setjmp(png_jmpbuf(png)) != 0) {  // NOLINT(cert-err52-cpp): libpng's way
        return;
    }
    png_set_IHDR(png,
                 info,
                 width,
                 height,
                 8,
                 PNG_COLOR_TYPE_RGBA,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, level);
    // No filter: faster, and drawn pictures have large areas of one colour anyway.
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_write_info(png, info);
    png_write_image(png, rows);
    png_write_end(png, nullptr);
}

/// Checks size and bytes, then encodes. `level`: zlib's, 1 fast to 9 small.
Expected<std::string> encoded(int width,
                              int height,
                              std::span<const std::uint8_t> rgba,
                              int level) {
    const auto wide = static_cast<std::size_t>(width < 0 ? 0 : width);
    const auto high = static_cast<std::size_t>(height < 0 ? 0 : height);
    if (wide == 0 || high == 0 || rgba.size() != wide * high * 4) {
        return fail("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                    " does not have " + std::to_string(rgba.size()) + " bytes");
    }
    // Everything with a destructor is made out here, where no longjmp leaves it behind.
    std::vector<png_bytep> rows(high);
    for (std::size_t y = 0; y < high; ++y) {
        // libpng takes rows as writable and only reads them.
        rows[y] = const_cast<png_bytep>(rgba.data()) + y * wide * 4;
    }
    Sink sink;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, keep_error, ignore_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info != nullptr) {
        png_set_write_fn(png, &sink, append, nullptr);
        encode(png,
               info,
               static_cast<png_uint_32>(width),
               static_cast<png_uint_32>(height),
               rows.data(),
               level);
    } else {
        sink.error = "out of memory";
    }
    // Frees both, also when one of them was not made.
    png_destroy_write_struct(&png, &info);
    if (!sink.error.empty()) {
        return fail("a picture cannot be encoded as PNG: " + sink.error);
    }
    return std::move(sink.bytes);
}

}  // namespace

Expected<void> write_png(const std::filesystem::path& path,
                         int width,
                         int height,
                         std::span<const std::uint8_t> rgba) {
    auto bytes = encoded(width, height, rgba, 1);
    if (!bytes) {
        return fail(std::move(bytes.error()).in(path.string()));
    }
    return write_file(path, *bytes);
}

Expected<std::string> encode_png(int width, int height, std::span<const std::uint8_t> rgba) {
    return encoded(width, height, rgba, 9);
}

}  // namespace raks::render
