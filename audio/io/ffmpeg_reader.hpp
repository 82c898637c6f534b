#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/container_extent.hpp"
#include "audio/io/ffmpeg_handles.hpp"
#include "audio/io/tag_packets.hpp"
#include "audio/io/time_line.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// AudioFileReader by FFmpeg. Opening is in ffmpeg_open.cpp, decoding and warnings in
/// ffmpeg_reader.cpp, seeking in ffmpeg_seek.cpp. Only these use it.
class FfmpegReader final : public AudioFileReader {
 public:
    /// Opens nothing yet: see open().
    explicit FfmpegReader(DecoderInput input) : input_(std::move(input)), cursor_{input_.window} {}

    /// Opens container and decoder and decodes the first frame. Errors: as open_by_ffmpeg.
    Expected<void> open();
    /// As AudioFileReader::read.
    std::size_t read(std::span<float> interleaved) override;
    /// As AudioFileReader::seek.
    Expected<void> seek(std::int64_t frame) override;

 private:
    [[nodiscard]] bool open_window();
    Expected<void> open_container();
    Expected<void> open_decoder();
    Expected<void> describe();
    void prepare_time_line(std::int64_t first_stamp);
    void claim_length();
    [[nodiscard]] bool decode_next();
    [[nodiscard]] int feed_decoder();
    void take_frame();
    [[nodiscard]] bool prepare_converter();
    void drain_converter();
    void append_converted(const std::uint8_t** in, int count);
    void place_frame();
    void drop_until_target();
    [[nodiscard]] bool walk_to(std::int64_t frame);
    enum class SeekMethod { index, reading, decoding };
    [[nodiscard]] SeekMethod seek_method() const;
    [[nodiscard]] Expected<void> reopen();
    void forget_decoded();
    [[nodiscard]] Expected<void> seek_container(std::int64_t timestamp, std::int64_t frame);
    void note_damage();
    void note_jump(TimeLine::Step step, std::int64_t at, std::int64_t frames);
    void note_end();
    void tell_notes();
    [[nodiscard]] std::int64_t buffered_frames() const {
        return silence_ + static_cast<std::int64_t>(buffer_.size() - buffer_at_) / info_.channels;
    }

    // Gaps or overlaps of the time stamps that were met so far.
    struct Jumps {
        int count = 0;
        std::int64_t first = 0;   // position
        std::int64_t frames = 0;  // of all
    };

    DecoderInput input_;
    ContainerExtent extent_;
    WindowCursor cursor_;
    FfmpegHandle<AVIOContext> window_;  // reads by cursor_; outlives container_
    FfmpegHandle<AVFormatContext> container_;
    FfmpegHandle<AVCodecContext> decoder_;
    FfmpegHandle<AVPacket> packet_{av_packet_alloc()};
    FfmpegHandle<AVFrame> frame_{av_frame_alloc()};
    FfmpegHandle<SwrContext> converter_;
    TagPackets tags_;
    AVStream* stream_ = nullptr;
    int converter_rate_ = 0;  // format of the frames that the converter is set up for
    int converter_channels_ = 0;
    int converter_format_ = -1;

    TimeLine line_;
    bool has_origin_ = false;          // of line_
    std::int64_t lead_ = 0;            // silence before the first sound
    std::int64_t first_frames_ = 0;    // length of the first decoded frame
    std::int64_t typical_frames_ = 0;  // of a frame of the codec: of the longest so far
    std::int64_t claimed_end_ = 0;     // of the sound, in frames; 0: the file does not say

    std::int64_t silence_ = 0;        // frames of silence before the buffer
    std::vector<float> buffer_;       // decoded, interleaved; from buffer_at_ on not yet read
    std::size_t buffer_at_ = 0;       // place of the next sample to read
    std::int64_t decoded_until_ = 0;  // frame number of the end of the buffer
    std::int64_t target_ = 0;         // frames before it are dropped, after a seek or an overlap
    bool is_placed_ = true;           // whether decoded_until_ is known: not right after a seek
    bool is_flushed_ = false;         // the decoder got all packets
    bool is_ended_ = false;
    std::string head_fault_;  // error of the first frame's rate or channels
    std::string damage_;      // the first, as warning() says it
    Jumps gaps_;
    Jumps overlaps_;
    std::int64_t last_jump_ = -1;  // position of the last of them
};

}  // namespace raks::audio
