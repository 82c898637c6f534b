#pragma once

#include <cstdint>
#include <span>

#include "base/expected.hpp"
#include "render/video/av_handles.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {

/// H.264 for .mp4, Motion JPEG for .avi: one RGBA picture in, frames of libavcodec's own out.
class PictureEncoder {
 public:
    /// `has_global_header`: the container keeps the codec's header itself.
    [[nodiscard]] static Expected<PictureEncoder> create(FilmForm form,
                                                         const VideoOptions& options,
                                                         int muxer_flags);

    [[nodiscard]] AVCodecContext& codec() const noexcept { return *codec_; }
    /// The picture in the codec's colours, at time `number` / rate.
    [[nodiscard]] Expected<FrameHandle> convert(std::span<const std::uint8_t> rgba,
                                                std::int64_t number) const;

 private:
    CodecHandle codec_;
    ScalerHandle scaler_;
};

}  // namespace raks::render
