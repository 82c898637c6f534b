#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "render/video/straight_alpha.hpp"
#include "render/video/video_forms.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

/// The encoders of a film, and owners of FFmpeg's objects: each is freed by the function that
/// FFmpeg has for it.
namespace raks::render {

/// Frees an encoder.
struct FreeCodec {
    void operator()(AVCodecContext* codec) const noexcept { avcodec_free_context(&codec); }
};
/// Frees a picture or a piece of sound.
struct FreeFrame {
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
};
/// Frees encoded data.
struct FreePacket {
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
};
/// Frees a colour converter.
struct FreeScaler {
    void operator()(SwsContext* scaler) const noexcept { sws_freeContext(scaler); }
};
/// Frees a sample rate converter.
struct FreeResampler {
    void operator()(SwrContext* resampler) const noexcept { swr_free(&resampler); }
};
/// Closes the file and frees the container's writer.
struct FreeMuxer {
    void operator()(AVFormatContext* muxer) const noexcept {
        avio_closep(&muxer->pb);
        avformat_free_context(muxer);
    }
};
using CodecHandle = std::unique_ptr<AVCodecContext, FreeCodec>;
using FrameHandle = std::unique_ptr<AVFrame, FreeFrame>;
using PacketHandle = std::unique_ptr<AVPacket, FreePacket>;
using ScalerHandle = std::unique_ptr<SwsContext, FreeScaler>;
using ResamplerHandle = std::unique_ptr<SwrContext, FreeResampler>;
using MuxerHandle = std::unique_ptr<AVFormatContext, FreeMuxer>;

/// FFmpeg's number for what went wrong, in words.
[[nodiscard]] inline std::string av_reason(int error) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(error, text, sizeof text);
    return text;
}

/// Threads of an encoder. A fixed number, so that the same input gives the same file on every
/// machine: x264 writes the number into the file, and its pictures depend on it.
inline constexpr int kEncoderThreads = 2;

/// H.264 for .mp4 and .mkv, VP9 for .webm, Motion JPEG for .avi, ProRes 4444 for .mov: converts
/// RGBA pictures into frames for libavcodec. Threads: one. Real-time: no.
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
                                                std::int64_t number);

 private:
    CodecHandle codec_;
    ScalerHandle scaler_;
    std::optional<EdgeColours> edges_;    // of pictures with alpha
    std::vector<std::uint8_t> straight_;  // the picture that is converted
};

/// AAC for .mp4, Opus for .mkv and .webm, 16 bit PCM for .avi: collects samples until a frame of
/// the codec's size is full. Positions and lengths count at the codec's rate, codec().sample_rate.
/// Threads: one. Real-time: no.
class SoundEncoder {
 public:
    /// Opens the encoder; `muxer_flags` are AVOutputFormat's. Errors: no such encoder in this
    /// FFmpeg, or one that does not start.
    [[nodiscard]] static Expected<SoundEncoder> create(FilmForm form,
                                                       const VideoOptions& options,
                                                       int muxer_flags);

    /// The open encoder; owned by this object.
    [[nodiscard]] AVCodecContext& codec() const noexcept { return *codec_; }
    /// Appends interleaved samples of the options' rate, whole audio frames.
    void add(std::span<const float> interleaved);
    /// Cuts or fills with silence, so that the sound ends after `audio_frames`. Nothing may be
    /// added afterwards.
    void set_length(std::int64_t audio_frames);
    /// The next frame that is full and ends at or before `until` audio frames, or, when `until`
    /// is the length set, what is left. Null: there is none.
    [[nodiscard]] Expected<FrameHandle> next(std::int64_t until);

 private:
    [[nodiscard]] std::int64_t kept() const noexcept;
    [[nodiscard]] Expected<FrameHandle> take(std::int64_t audio_frames);
    void resample(std::span<const float> interleaved);

    CodecHandle codec_;
    ResamplerHandle resampler_;  // null: the rate is the codec's
    std::int64_t channels_ = 0;
    std::int64_t frame_size_ = 0;
    std::int64_t position_ = 0;   // audio frames handed out
    std::int64_t length_ = -1;    // < 0: not yet known
    std::vector<float> samples_;  // interleaved, from position_ on, behind first_
    std::size_t first_ = 0;
};

/// An encoder's track in a film.
struct FilmTrack {
    const AVCodecContext* codec = nullptr;  ///< open, as it was when the film was written
    std::int64_t first_dts = 0;             ///< of its first packet, in the codec's time base
    std::int64_t end = 0;                   ///< of the track, likewise: what is longer is cut
};
/// Writes a film in fragments anew as a plain one, without encoding anything again. `form`: "mp4"
/// or "mov"; `tracks`: as the fragments have them. Errors: `fragments` cannot be read, `plain`
/// cannot be written; then `plain` may be there in part.
[[nodiscard]] Expected<void> make_plain_film(const char* form,
                                             const std::string& fragments,
                                             const std::string& plain,
                                             std::span<const FilmTrack> tracks);

}  // namespace raks::render
