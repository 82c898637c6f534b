#include "audio/io/ffmpeg_window.hpp"

#include <algorithm>
#include <cstdint>

namespace raks::audio {
namespace {

constexpr int kWindowBuffer = 64 * 1024;  // bytes that FFmpeg asks for at once

int read_window(void* data, std::uint8_t* bytes, int count) {
    auto& cursor = *static_cast<WindowCursor*>(data);
    const std::size_t got =
        cursor.read({reinterpret_cast<char*>(bytes), static_cast<std::size_t>(std::max(count, 0))});
    return got > 0 ? static_cast<int>(got) : AVERROR_EOF;
}

std::int64_t seek_window(void* data, std::int64_t offset, int whence) {
    auto& cursor = *static_cast<WindowCursor*>(data);
    if (whence == AVSEEK_SIZE) {
        return cursor.window.size();
    }
    const std::int64_t at = cursor.seek(offset, whence & ~AVSEEK_FORCE);
    return at < 0 ? AVERROR(EINVAL) : at;
}

}  // namespace

FfmpegHandle<AVIOContext> read_through(WindowCursor& cursor) {
    auto* buffer = static_cast<unsigned char*>(av_malloc(kWindowBuffer));
    AVIOContext* context =
        avio_alloc_context(buffer, kWindowBuffer, 0, &cursor, read_window, nullptr, seek_window);
    if (context == nullptr) {
        av_free(buffer);
    }
    return FfmpegHandle<AVIOContext>(context);
}

std::string ffmpeg_reason(int error_number) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(error_number, text, sizeof text);
    return text;
}

}  // namespace raks::audio
