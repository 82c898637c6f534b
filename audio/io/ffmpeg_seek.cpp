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
#include "audio/io/ffmpeg_window.hpp"

namespace raks::audio {
namespace {

constexpr double kPrerollSeconds = 0.30;  // an MP3 frame depends on up to nine frames before it
constexpr std::int64_t kMostToRead = 256 << 20U;  // bytes of a file that is read for a seek

}  // namespace

// Chooses the way to a frame. Formats without an index make FFmpeg guess from the bit rate, so
// their small packets are read up to it without decoding (about 1 ms a minute of sound). Where time
// stamps are coarse and frames differ in length, as in Vorbis, only decoding from the start counts
// exactly. Where stamps lie beside their packets, these are counted. Behind a gap coarse stamps are
// exact only when the gap was met, so files that are not very large are read as well.
FfmpegReader::SeekMethod FfmpegReader::seek_method() const {
    const std::string_view name = container_->iformat->name;
    if (name == "mp3" || name == "aac" || name == "ac3" || name == "mpegts" || name == "mpeg") {
        return SeekMethod::reading;
    }
    if (input_.has_loose_stamps) {
        return SeekMethod::reading;
    }
    if (!line_.is_coarse()) {
        return SeekMethod::index;
    }
    if (decoder_->codec_id == AV_CODEC_ID_VORBIS) {
        return SeekMethod::decoding;
    }
    return input_.window.size() <= kMostToRead ? SeekMethod::reading : SeekMethod::index;
}

// Reads on to the packet that contains this frame of the file, or starts after it, and gives it to
// the decoder.
bool FfmpegReader::walk_to(std::int64_t frame) {
    while (av_read_frame(container_.get(), packet_.get()) >= 0) {
        bool is_enough = false;
        if (packet_->stream_index == stream_->index) {
            const std::int64_t frames = line_.is_coarse() && typical_frames_ > 0
                                            ? typical_frames_
                                            : line_.frames_of(packet_->duration);
            // The first decoded frame is placed once more, as following the packet before.
            const TimeLine before = line_;
            is_enough = packet_->pts == AV_NOPTS_VALUE ||
                        line_.place(packet_->pts, frames).position + frames > frame;
            if (is_enough) {
                line_ = before;
                const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
                av_packet_unref(packet_.get());
                return sent >= 0;
            }
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
                                input_.path.string(),
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
    line_.rewind();
    return {};
}

// Forgets all that was decoded; the next frame's place comes from its time stamp.
void FfmpegReader::forget_decoded() {
    converter_.reset();
    buffer_.clear();
    buffer_at_ = 0;
    silence_ = 0;
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
    const std::int64_t from = line_.stamp_of(frame - preroll);
    const std::int64_t start = std::min<std::int64_t>(line_.stamp_of(0), 0);
    line_.set_grid(lead_ + first_frames_, typical_frames_);
    line_.rewind();
    auto sought = seek_container(method == SeekMethod::index ? from : start, frame);
    if (!sought) {
        return sought;
    }
    avcodec_flush_buffers(decoder_.get());
    forget_decoded();
    if (method == SeekMethod::reading && !walk_to(frame - preroll)) {
        note_damage();
    }
    return {};
}

}  // namespace raks::audio
