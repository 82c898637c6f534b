#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "render/video/av_handles.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {

/// AAC for .mp4, 16 bit PCM for .avi: collects samples until a frame of the codec's size is full.
/// Threads: one. Real-time: no.
class SoundEncoder {
 public:
    /// Opens the encoder; `muxer_flags` are AVOutputFormat's. Errors: no such encoder in this
    /// FFmpeg, a sample rate that it does not have, or one that does not start.
    [[nodiscard]] static Expected<SoundEncoder> create(FilmForm form,
                                                       const VideoOptions& options,
                                                       int muxer_flags);

    /// The open encoder; owned by this object.
    [[nodiscard]] AVCodecContext& codec() const noexcept { return *codec_; }
    /// Appends interleaved samples, whole audio frames.
    void add(std::span<const float> interleaved);
    /// Cuts or fills with silence, so that the sound ends after `audio_frames`.
    void set_length(std::int64_t audio_frames);
    /// The next frame that is full and ends at or before `until` audio frames, or, when `until`
    /// is the length set, what is left. Null: there is none.
    [[nodiscard]] Expected<FrameHandle> next(std::int64_t until);

 private:
    [[nodiscard]] std::int64_t kept() const noexcept;
    [[nodiscard]] Expected<FrameHandle> take(std::int64_t audio_frames);

    CodecHandle codec_;
    std::int64_t channels_ = 0;
    std::int64_t frame_size_ = 0;
    std::int64_t position_ = 0;   // audio frames handed out
    std::int64_t length_ = -1;    // < 0: not yet known
    std::vector<float> samples_;  // interleaved, from position_ on, behind first_
    std::size_t first_ = 0;
};

}  // namespace raks::render
