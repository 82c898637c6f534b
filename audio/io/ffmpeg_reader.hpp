#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "audio/io/ffmpeg_handles.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// AudioFileReader by FFmpeg. Opening, decoding and warnings are in ffmpeg_reader.cpp, seeking in
/// ffmpeg_seek.cpp. Only audio_file.cpp and these use it.
class FfmpegReader final : public AudioFileReader {
 public:
    /// Opens nothing yet: see open().
    explicit FfmpegReader(std::filesystem::path path) : path_(std::move(path)) {}

    /// Opens container and decoder and decodes the first frame. Errors: as open_by_ffmpeg.
    Expected<void> open();
    /// As AudioFileReader::read.
    std::size_t read(std::span<float> interleaved) override;
    /// As AudioFileReader::seek.
    Expected<void> seek(std::int64_t frame) override;

 private:
    Expected<void> open_container();
    Expected<void> open_decoder();
    Expected<void> describe();
    [[nodiscard]] bool decode_next();
    [[nodiscard]] int feed_decoder();
    void take_frame();
    [[nodiscard]] bool prepare_converter();
    void place_frame();
    void drop_until_target();
    [[nodiscard]] bool skip_packets_before(std::int64_t timestamp);
    [[nodiscard]] std::int64_t frames_of(std::int64_t timestamp) const;
    [[nodiscard]] std::int64_t timestamp_of(std::int64_t frame) const;
    enum class SeekMethod { index, reading, decoding };
    [[nodiscard]] SeekMethod seek_method() const;
    [[nodiscard]] std::int64_t on_frame_grid(std::int64_t position) const;
    [[nodiscard]] Expected<void> reopen();
    void forget_decoded();
    [[nodiscard]] Expected<void> seek_container(std::int64_t timestamp, std::int64_t frame);
    void note_damage();
    void note_end();
    [[nodiscard]] std::size_t buffered_frames() const {
        return (buffer_.size() - buffer_at_) / static_cast<std::size_t>(info_.channels);
    }

    std::filesystem::path path_;
    FfmpegHandle<AVFormatContext> container_;
    FfmpegHandle<AVCodecContext> decoder_;
    FfmpegHandle<AVPacket> packet_{av_packet_alloc()};
    FfmpegHandle<AVFrame> frame_{av_frame_alloc()};
    FfmpegHandle<SwrContext> converter_;
    AVStream* stream_ = nullptr;
    int converter_rate_ = 0;  // format of the frames that the converter is set up for
    int converter_channels_ = 0;
    int converter_format_ = -1;

    std::vector<float> buffer_;       // decoded, interleaved; from buffer_at_ on not yet read
    std::size_t buffer_at_ = 0;       // place of the next sample to read
    std::int64_t decoded_until_ = 0;  // frame number of the end of the buffer
    std::int64_t first_timestamp_ = AV_NOPTS_VALUE;  // of the file's start
    std::int64_t target_ = 0;                        // after a seek: frames before it are dropped
    bool is_placed_ = true;    // whether decoded_until_ is known: not right after a seek
    bool is_flushed_ = false;  // the decoder got all packets
    bool is_ended_ = false;
    std::int64_t first_frames_ = 0;  // length of the first decoded frame
    std::string head_fault_;         // error of the first frame's rate or channels
};

/// FFmpeg's text for this error number.
[[nodiscard]] std::string ffmpeg_reason(int error_number);

}  // namespace raks::audio
