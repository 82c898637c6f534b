extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_reader.hpp"

namespace raks::audio {
namespace {

constexpr int kMaxFaultsInARow = 2000;         // of packets: passes a damaged stretch, ends at last
constexpr int kMaxPacketsToFirstFrame = 5000;  // then the decoder is taken to give nothing
// Seconds below the claimed length that are rounding: others than MP3 round up.
constexpr double kShortByRounding = 1.0;
// MP3 counts its frames, of which what encoder and decoder add at both ends is no sound.
constexpr double kAddedToMp3 = 2.0 * 1152 + 1105;  // samples

}  // namespace

// Keeps the first damage for warning(); before the first frame open() reports the failure.
void FfmpegReader::note_damage() {
    if (damage_.empty() && info_.channels > 0) {
        damage_ = fmt::format("is damaged at {:.2f} s",
                              static_cast<double>(decoded_until_) / info_.rate.hertz());
        tell_notes();
    }
}

// Remembers a gap or an overlap, once although a seek may bring it again.
void FfmpegReader::note_jump(TimeLine::Step step, std::int64_t at, std::int64_t frames) {
    if (at <= last_jump_) {
        return;
    }
    last_jump_ = at;
    Jumps& jumps = step == TimeLine::Step::gap ? gaps_ : overlaps_;
    jumps.first = jumps.count == 0 ? at : jumps.first;
    jumps.count += 1;
    jumps.frames += frames;
    tell_notes();
}

// Puts the warning together from all that was noted.
void FfmpegReader::tell_notes() {
    const double rate = info_.rate.hertz();
    const auto seconds = [rate](std::int64_t frames) { return static_cast<double>(frames) / rate; };
    warning_.clear();
    add_note(warning_, input_.path, input_.note);
    if (gaps_.count == 1) {
        add_note(warning_,
                 input_.path,
                 fmt::format("has a gap of {:.2f} s at {:.2f} s, which is silent",
                             seconds(gaps_.frames),
                             seconds(gaps_.first)));
    } else if (gaps_.count > 1) {
        add_note(
            warning_,
            input_.path,
            fmt::format("has {} gaps, together {:.2f} s, the first at {:.2f} s; they are silent",
                        gaps_.count,
                        seconds(gaps_.frames),
                        seconds(gaps_.first)));
    }
    if (overlaps_.count > 0) {
        add_note(
            warning_,
            input_.path,
            fmt::format("its time stamps go back at {:.2f} s; {:.2f} s that overlap are left out",
                        seconds(overlaps_.first),
                        seconds(overlaps_.frames)));
    }
    add_note(warning_, input_.path, damage_);
}

// At the end: notes a file that is shorter than it claims. Where the container tells how many bytes
// it has, these decide; else the length that it claims. After a seek the position must be known.
void FfmpegReader::note_end() {
    is_ended_ = true;
    if (!is_placed_) {
        return;
    }
    const double rate = info_.rate.hertz();
    const double short_by = static_cast<double>(claimed_end_ - decoded_until_) / rate;
    const bool is_cut = extent_.missing_bytes > 0 || input_.missing_seconds > 0.0 || input_.is_cut;
    const bool is_told = extent_.is_known || input_.is_complete;
    const double tolerance = info_.format == "MP3" ? kAddedToMp3 / rate : kShortByRounding;
    const bool is_short = !is_told && claimed_end_ > 0 && short_by > tolerance;
    if (is_cut || is_short) {
        // It stands for damage at the cut.
        damage_ = cut_off_note(static_cast<double>(decoded_until_) / rate,
                               std::max(short_by, input_.missing_seconds));
    }
    tell_notes();
    if (input_.window.has_grown()) {
        add_note(warning_, input_.path, kHasGrown);
    }
}

// Sends the decoder the next packet of the track, or the end of the stream. Returns 0 or FFmpeg's
// error.
int FfmpegReader::feed_decoder() {
    for (int faults = 0; faults < kMaxFaultsInARow; ++faults) {
        const int got = av_read_frame(container_.get(), packet_.get());
        // An error at the end of the data ends the stream, too.
        if (got == AVERROR_EOF || (got < 0 && avio_feof(container_->pb) != 0)) {
            is_flushed_ = true;
            return avcodec_send_packet(decoder_.get(), nullptr);
        }
        if (got < 0) {
            note_damage();
            continue;
        }
        const bool is_ours = packet_->stream_index == stream_->index;
        const int sent = is_ours ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
        const bool is_refused = sent < 0 && sent != AVERROR(EAGAIN);
        if (is_refused && !tags_.is_tag({packet_->data, static_cast<std::size_t>(packet_->size)})) {
            note_damage();
        }
        av_packet_unref(packet_.get());
        if (is_refused) {
            continue;
        }
        if (is_ours) {
            return 0;
        }
        faults = 0;  // a packet of another track is no fault
    }
    return AVERROR_INVALIDDATA;
}

// Decodes one more frame into the buffer, which may stay empty where the frame is dropped after a
// seek. Returns false at the end.
bool FfmpegReader::decode_next() {
    int faults = 0;
    while (!is_ended_ && faults < kMaxPacketsToFirstFrame) {
        const int got = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (got == 0) {
            take_frame();
            av_frame_unref(frame_.get());
            return true;
        }
        if (got == AVERROR(EAGAIN) && !is_flushed_) {
            if (feed_decoder() < 0) {
                break;
            }
        } else if (got == AVERROR_EOF || is_flushed_) {
            break;
        } else {
            note_damage();
        }
        ++faults;
    }
    if (info_.channels > 0 && !is_ended_) {
        note_end();
    }
    is_ended_ = true;
    return false;
}

// Sets the converter up for frames of this kind, to interleaved floats at the rate and with the
// number of channels of the first frame. A stream may change its format on the way.
bool FfmpegReader::prepare_converter() {
    const int channels = frame_->ch_layout.nb_channels;
    if (converter_ && converter_rate_ == frame_->sample_rate && converter_channels_ == channels &&
        converter_format_ == frame_->format) {
        return true;
    }
    AVChannelLayout from{};
    // Frames without a channel layout get the usual one for their number of channels.
    AVChannelLayout to{};
    if (frame_->ch_layout.order == AV_CHANNEL_ORDER_UNSPEC) {
        av_channel_layout_default(&from, channels);
    } else {
        av_channel_layout_copy(&from, &frame_->ch_layout);
    }
    if (channels == info_.channels) {
        av_channel_layout_copy(&to, &from);
    } else {
        av_channel_layout_default(&to, info_.channels);
    }
    drain_converter();
    SwrContext* context = nullptr;
    const int set = swr_alloc_set_opts2(&context,
                                        &to,
                                        AV_SAMPLE_FMT_FLT,
                                        info_.rate.hertz(),
                                        &from,
                                        static_cast<AVSampleFormat>(frame_->format),
                                        frame_->sample_rate,
                                        0,
                                        nullptr);
    av_channel_layout_uninit(&from);
    av_channel_layout_uninit(&to);
    converter_.reset(context);
    converter_rate_ = frame_->sample_rate;
    converter_channels_ = channels;
    converter_format_ = frame_->format;
    if (set < 0 || swr_init(context) < 0) {
        converter_.reset();
        return false;
    }
    return true;
}

// What the converter holds of frames of another kind comes before the current frame.
void FfmpegReader::drain_converter() {
    if (converter_ && converter_rate_ != info_.rate.hertz()) {
        append_converted(nullptr, 0);
    }
}

// Converts `count` audio frames, or with none brings out what the converter holds.
void FfmpegReader::append_converted(const std::uint8_t** in, int count) {
    const auto width = static_cast<std::size_t>(info_.channels);
    const std::size_t before = buffer_.size();
    const int room = std::max(swr_get_out_samples(converter_.get(), count), 0);
    buffer_.resize(before + static_cast<std::size_t>(room) * width);
    auto* out = reinterpret_cast<std::uint8_t*>(buffer_.data() + before);
    const int made = std::max(swr_convert(converter_.get(), &out, room, in, count), 0);
    buffer_.resize(before + static_cast<std::size_t>(made) * width);
    // The converter may keep samples back; what came out counts.
    decoded_until_ += made;
}

// Place of the current frame: after the last one or, at the start, after a seek and after a jump of
// the time stamps, where its own stamp puts it. A gap before it becomes silence.
void FfmpegReader::place_frame() {
    const std::int64_t stamp = frame_->best_effort_timestamp;
    const std::int64_t frames =
        av_rescale(frame_->nb_samples, info_.rate.hertz(), frame_->sample_rate);
    typical_frames_ = std::max(typical_frames_, frames);
    if (!has_origin_) {
        has_origin_ = true;
        prepare_time_line(stamp != AV_NOPTS_VALUE ? stamp : 0);
    }
    if (stamp == AV_NOPTS_VALUE) {
        line_.pass(frames);
        return;
    }
    const bool is_first = is_placed_ && decoded_until_ == 0;
    const TimeLine::Place place = line_.place(stamp, frames);
    if (is_first) {
        lead_ = std::max<std::int64_t>(place.position, 0);
        silence_ = lead_;
        decoded_until_ = lead_;
    } else if (!is_placed_) {
        decoded_until_ = place.position;
        is_placed_ = true;
    } else if (place.step == TimeLine::Step::gap && place.position > decoded_until_) {
        note_jump(place.step, decoded_until_, place.position - decoded_until_);
        silence_ = place.position - decoded_until_;
        decoded_until_ = place.position;
    } else if (place.step == TimeLine::Step::overlap && place.position < decoded_until_) {
        note_jump(place.step, decoded_until_, decoded_until_ - place.position);
        target_ = std::max(target_, decoded_until_);
        decoded_until_ = place.position;
    }
}

// Converts the current frame into the buffer, which is empty.
void FfmpegReader::take_frame() {
    const int channels = frame_->ch_layout.nb_channels;
    if (info_.channels == 0) {
        if (const auto head = check_head(input_.path, frame_->sample_rate, channels); !head) {
            head_fault_ = head.error().message;
            return;
        }
        info_.rate = SampleRate(frame_->sample_rate);
        info_.channels = channels;
    }
    buffer_.clear();
    buffer_at_ = 0;
    if (frame_->sample_rate <= 0 || channels < 1 || channels > kMaxFileChannels) {
        note_damage();
        return;
    }
    place_frame();
    if (!prepare_converter()) {
        note_damage();
        return;
    }
    append_converted(const_cast<const std::uint8_t**>(frame_->extended_data), frame_->nb_samples);
    drop_until_target();
}

// After a seek the decoder starts before the target, and where sound overlaps before what was
// given; frames before it are skipped.
void FfmpegReader::drop_until_target() {
    const auto width = static_cast<std::size_t>(info_.channels);
    const std::int64_t start = decoded_until_ - buffered_frames();
    if (start < target_) {
        const std::int64_t silent = std::min(target_ - start, silence_);
        silence_ -= silent;
        const std::int64_t surplus = std::min(target_ - start - silent, buffered_frames());
        buffer_at_ += static_cast<std::size_t>(surplus) * width;
    }
}

// Decodes as needed; fewer frames than wanted mean the end.
std::size_t FfmpegReader::read(std::span<float> interleaved) {
    const auto width = static_cast<std::size_t>(info_.channels);
    const std::size_t wanted = interleaved.size() / width;
    std::size_t done = 0;
    while (done < wanted) {
        const std::size_t silent = std::min(wanted - done, static_cast<std::size_t>(silence_));
        std::fill_n(interleaved.data() + done * width, silent * width, 0.0F);
        silence_ -= static_cast<std::int64_t>(silent);
        done += silent;
        const std::size_t count = std::min(wanted - done, (buffer_.size() - buffer_at_) / width);
        std::copy_n(buffer_.data() + buffer_at_, count * width, interleaved.data() + done * width);
        buffer_at_ += count * width;
        done += count;
        if (done < wanted && !decode_next()) {
            break;
        }
    }
    return done;
}

}  // namespace raks::audio
