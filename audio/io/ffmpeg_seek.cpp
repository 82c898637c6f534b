// Seeking to an exact frame in containers whose time stamps or indexes are less exact.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "audio/io/ffmpeg_reader.hpp"

namespace raks::audio {
namespace {

constexpr double kPrerollSeconds = 0.30;  // an MP3 frame depends on up to nine frames before it

}  // namespace

// Time stamp of the stream to frames, and back, rounded to the nearest.
std::int64_t FfmpegReader::frames_of(std::int64_t timestamp) const {
    return av_rescale_q(timestamp, stream_->time_base, AVRational{1, info_.rate.hertz()});
}

std::int64_t FfmpegReader::timestamp_of(std::int64_t frame) const {
    return av_rescale_q(frame, AVRational{1, info_.rate.hertz()}, stream_->time_base);
}

// Matroska's time stamps are whole milliseconds. Moves a position from such a coarse time stamp to
// the nearest place where a codec frame of this length can start, if it is within the stamp's
// resolution.
std::int64_t FfmpegReader::on_frame_grid(std::int64_t position) const {
    const std::int64_t size = frame_->nb_samples;
    const double resolution = av_q2d(stream_->time_base) * info_.rate.hertz();  // in frames
    if (resolution <= 1.0 || size <= 0 || position <= 0) {
        return position;
    }
    const double steps = static_cast<double>(position - first_frames_) / static_cast<double>(size);
    const std::int64_t near = first_frames_ + std::llround(steps) * size;
    return static_cast<double>(std::abs(near - position)) <= resolution ? near : position;
}

// Chooses the way to a frame. Formats without an index make FFmpeg guess from the bit rate, so
// their small packets are read up to it without decoding (about 1 ms a minute of sound). Where time
// stamps are coarse and frames differ in length, as in Vorbis, only decoding from the start counts
// exactly.
FfmpegReader::SeekMethod FfmpegReader::seek_method() const {
    const std::string_view name = container_->iformat->name;
    if (name == "mp3" || name == "aac" || name == "ac3" || name == "mpegts" || name == "mpeg") {
        return SeekMethod::reading;
    }
    const bool is_coarse = av_q2d(stream_->time_base) * info_.rate.hertz() > 1.0;
    return is_coarse && decoder_->codec_id == AV_CODEC_ID_VORBIS ? SeekMethod::decoding
                                                                 : SeekMethod::index;
}

// Reads on to the packet that contains `timestamp`, or starts after it, and gives it to the
// decoder.
bool FfmpegReader::skip_packets_before(std::int64_t timestamp) {
    while (av_read_frame(container_.get(), packet_.get()) >= 0) {
        const bool is_ours = packet_->stream_index == stream_->index;
        const std::int64_t end = packet_->pts + packet_->duration;
        const bool is_enough = is_ours && (packet_->pts == AV_NOPTS_VALUE || end > timestamp);
        if (is_enough) {
            const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
            av_packet_unref(packet_.get());
            return sent >= 0;
        }
        av_packet_unref(packet_.get());
    }
    return true;  // beyond the end: the next read reports it
}

// Seeks the container to the time stamp or before; where that fails, to the start of the file.
Expected<void> FfmpegReader::seek_container(std::int64_t timestamp, std::int64_t frame) {
    int error = av_seek_frame(container_.get(), stream_->index, timestamp, AVSEEK_FLAG_BACKWARD);
    if (error < 0) {
        error = av_seek_frame(container_.get(), -1, 0, AVSEEK_FLAG_BACKWARD | AVSEEK_FLAG_ANY);
    }
    if (error < 0) {
        return fail(fmt::format("{}: cannot go to {:.2f} s: {}",
                                path_.string(),
                                static_cast<double>(frame) / info_.rate.hertz(),
                                ffmpeg_reason(error)));
    }
    return {};
}

// Opens the file again: a seek to the start would treat the encoder's delay in another way than
// opening does.
Expected<void> FfmpegReader::reopen() {
    decoder_.reset();
    container_.reset();
    if (auto opened = open_container(); !opened) {
        return opened;
    }
    if (auto opened = open_decoder(); !opened) {
        return opened;
    }
    forget_decoded();
    is_placed_ = true;
    return {};
}

// Forgets all that was decoded; the next frame's place comes from its time stamp.
void FfmpegReader::forget_decoded() {
    converter_.reset();
    buffer_.clear();
    buffer_at_ = 0;
    decoded_until_ = 0;
    is_flushed_ = false;
    is_ended_ = false;
    is_placed_ = false;
}

Expected<void> FfmpegReader::seek(std::int64_t frame) {
    const auto preroll = static_cast<std::int64_t>(kPrerollSeconds * info_.rate.hertz());
    const SeekMethod method = frame <= preroll ? SeekMethod::decoding : seek_method();
    target_ = frame;
    if (method == SeekMethod::decoding) {
        return reopen();
    }
    // Preroll: the decoder needs the frames before the target to give the same samples as without a
    // seek. What it decodes before target_ is dropped.
    const std::int64_t from = first_timestamp_ + timestamp_of(frame - preroll);
    const std::int64_t start = std::min<std::int64_t>(first_timestamp_, 0);
    auto sought = seek_container(method == SeekMethod::index ? from : start, frame);
    if (!sought) {
        return sought;
    }
    avcodec_flush_buffers(decoder_.get());
    forget_decoded();
    if (method == SeekMethod::reading && !skip_packets_before(from)) {
        note_damage();
    }
    return {};
}

}  // namespace raks::audio
