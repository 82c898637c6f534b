// Going to a frame, exactly, in containers that know less exactly where it is.
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

constexpr double kPrerollSeconds = 0.30;  // an MP3 frame leans on up to nine before it

}  // namespace

std::int64_t FfmpegReader::frames_of(std::int64_t timestamp) const {
    return av_rescale_q(timestamp, stream_->time_base, AVRational{1, info_.rate.hertz()});
}

std::int64_t FfmpegReader::timestamp_of(std::int64_t frame) const {
    return av_rescale_q(frame, AVRational{1, info_.rate.hertz()}, stream_->time_base);
}

/// A position that a coarse time stamp gave (Matroska's are whole milliseconds), moved to where a
/// frame of this length can start.
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

/// How to reach a frame exactly. Formats without an index let FFmpeg guess from the bit rate; their
/// packets are small: reading past them without decoding costs about 1 ms a minute of sound. Where
/// time stamps are coarse and frames differ in length, only decoding from the start counts right.
FfmpegReader::SeekMethod FfmpegReader::seek_method() const {
    const std::string_view name = container_->iformat->name;
    if (name == "mp3" || name == "aac" || name == "ac3" || name == "mpegts" || name == "mpeg") {
        return SeekMethod::reading;
    }
    const bool is_coarse = av_q2d(stream_->time_base) * info_.rate.hertz() > 1.0;
    return is_coarse && decoder_->codec_id == AV_CODEC_ID_VORBIS ? SeekMethod::decoding
                                                                 : SeekMethod::index;
}

/// Reads on to the last packet that starts at or before `timestamp`, and gives it to the decoder.
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
    return true;  // behind the end: the next read says so
}

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

/// Everything as just opened (a seek to the start would treat the encoder's delay otherwise).
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
