#pragma once

#include <string>

#include "audio/io/ffmpeg_handles.hpp"
#include "audio/io/file_window.hpp"

namespace raks::audio {

/// What FFmpeg reads a container through, so that it sees the window alone; null without memory.
/// `cursor` must outlive it, and it the container. Threads: one. Real-time: no.
[[nodiscard]] FfmpegHandle<AVIOContext> read_through(WindowCursor& cursor);

/// FFmpeg's error in words. Threads: any. Real-time: no.
[[nodiscard]] std::string ffmpeg_reason(int error_number);

}  // namespace raks::audio
