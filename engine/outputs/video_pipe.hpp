#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/video_sink.hpp"

namespace raks::engine {

/// Pictures one after another into a pipe: `-` is standard output, anything else a pipe with a name
/// that is there already. Whole pictures alone are written, each as soon as the reader takes it.
/// A pipe with a name waits for its reader, and for another one once that has left; standard output
/// ends when its reader leaves. Errors: no such pipe; a file that is none.
[[nodiscard]] Expected<std::unique_ptr<VideoSink>> open_video_pipe(const std::string& target,
                                                                   PixelForm form,
                                                                   const VideoFormat& format);

/// A picture as YUV4MPEG2 has it, behind its line "FRAME": three planes, BT.601 in limited range.
/// Alpha is not looked at. `planes`: 3 bytes a pixel.
void to_yuv444(std::span<const std::uint8_t> rgba, std::span<std::uint8_t> planes) noexcept;

}  // namespace raks::engine
