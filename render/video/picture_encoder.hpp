#pragma once

#include <cstdint>
#include <span>

#include "base/expected.hpp"
#include "render/video/av_handles.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {

/// H.264 for .mp4, Motion JPEG for .avi: converts RGBA pictures into frames for libavcodec.
/// Threads: one. Real-time: no.
class PictureEncoder {
 public:
    /// Opens the encoder. `muxer_flags` are AVOutputFormat's: they tell whether the container keeps
    /// the codec's header. Errors: no such encoder in this FFmpeg, or one that does not start.
    [[nodiscard]] static Expected<PictureEncoder> create(FilmForm form,
                                                         const VideoOptions& options,
                                                         int muxer_flags);

    /// The open encoder; owned by this object.
    [[nodiscard]] AVCodecContext& codec() const noexcept { return *codec_; }
    /// The picture in the codec's pixel format, at time `number` / rate. `rgba` has the size of the
    /// options. Errors: out of memory.
    [[nodiscard]] Expected<FrameHandle> convert(std::span<const std::uint8_t> rgba,
                                                std::int64_t number) const;

 private:
    CodecHandle codec_;
    ScalerHandle scaler_;
};

}  // namespace raks::render
