extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_reader.hpp"

namespace raks::audio {
namespace {

// Containers of sound and video only: FFmpeg would also open pictures, subtitles, plain text and
// play-lists (which name other files) as media.
constexpr const char* kFormats =
    "mp3,aac,mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,ogg,asf,avi,flv,flac,wav,w64,aiff,au,caf,ac3,"
    "eac3,dts,amr,amrnb,amrwb,ape,wv,tta,tak,mpc,mpc8,mpeg,mpegts,mpegvideo,rm,xwma,dsf,oma,loas,"
    "gxf,mxf,nut,swf,voc,aa,aax,adts,latm";

constexpr int kMaxFaultsInARow = 2000;         // of packets: passes a damaged stretch, ends at last
constexpr int kMaxPacketsToFirstFrame = 5000;  // then the decoder is taken to give nothing
constexpr double kShortBySeconds = 1.0;        // seconds: less below the claimed length is rounding

// Whether FFmpeg recognised the container by content and not by its name alone: a program or a font
// that is named .mp3 also holds bytes that decode. MP3 behind a foreign tag has a low score and is
// still music.
bool is_known(const AVFormatContext& container) {
    const bool is_mp3 = container.iformat->name == std::string_view("mp3");
    return container.probe_score > (is_mp3 ? 1 : AVPROBE_SCORE_RETRY);
}

}  // namespace

std::string ffmpeg_reason(int error_number) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(error_number, text, sizeof text);
    return text;
}

Expected<void> FfmpegReader::open() {
    // FFmpeg would print; its errors are returned from here instead.
    av_log_set_level(AV_LOG_QUIET);
    if (auto opened = open_container(); !opened) {
        return opened;
    }
    if (auto opened = open_decoder(); !opened) {
        return opened;
    }
    return describe();
}

// Opens the file and finds its streams.
Expected<void> FfmpegReader::open_container() {
    AVFormatContext* context = nullptr;
    AVDictionary* options = nullptr;
    // Files alone: a play-list or a container must not make FFmpeg open network addresses.
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", kFormats, 0);
    // A path with a colon would be read as a protocol.
    const std::string url = "file:" + path_.string();
    const int error = avformat_open_input(&context, url.c_str(), nullptr, &options);
    av_dict_free(&options);
    container_.reset(context);
    if (error < 0 || !is_known(*context)) {
        return fail(path_.string() + ": is not audio that can be read");
    }
    if (const int found = avformat_find_stream_info(context, nullptr); found < 0) {
        return fail(path_.string() + ": is not audio that can be read: " + ffmpeg_reason(found));
    }
    return {};
}

// Chooses the best sound track and opens its decoder.
Expected<void> FfmpegReader::open_decoder() {
    const AVCodec* codec = nullptr;
    const int index = av_find_best_stream(container_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
    if (index < 0) {
        return fail(path_.string() + ": has no sound track");
    }
    // Packets of pictures and other tracks are dropped by the container's reader.
    for (unsigned i = 0; i < container_->nb_streams; ++i) {
        if (static_cast<int>(i) != index) {
            container_->streams[i]->discard = AVDISCARD_ALL;
        }
    }
    stream_ = container_->streams[index];
    const AVCodecParameters& head = *stream_->codecpar;
    if (auto checked = check_head(path_, head.sample_rate, head.ch_layout.nb_channels); !checked) {
        return checked;
    }
    decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_ || avcodec_parameters_to_context(decoder_.get(), stream_->codecpar) < 0) {
        return fail(path_.string() + ": its sound track cannot be decoded");
    }
    // FFmpeg needs the time base to correct time stamps where it trims samples.
    decoder_->pkt_timebase = stream_->time_base;
    // One thread is enough for sound.
    decoder_->thread_count = 1;
    if (const int error = avcodec_open2(decoder_.get(), codec, nullptr); error < 0) {
        return fail(path_.string() +
                    ": its sound track cannot be decoded: " + ffmpeg_reason(error));
    }
    return {};
}

// Takes rate and channels from the first decoded frame: they may differ from the head's (AAC may
// double the rate).
Expected<void> FfmpegReader::describe() {
    info_.channels = 0;  // until the first frame says it
    while (buffer_.empty() && head_fault_.empty() && decode_next()) {
    }
    if (!head_fault_.empty()) {
        return fail(head_fault_);
    }
    if (buffer_.empty()) {
        return fail(path_.string() + ": holds no sound that can be decoded");
    }
    first_frames_ = static_cast<std::int64_t>(buffered_frames());
    const std::string_view codec = decoder_->codec->name;
    info_.format = codec == "mp3float" || codec == "mp3"
                       ? "MP3"
                       : fmt::format("{} in {}", codec, container_->iformat->name);
    if (container_->duration > 0) {
        info_.claimed_seconds = static_cast<double>(container_->duration) / AV_TIME_BASE;
    }
    return {};
}

// Keeps the first damage for warning(); before the first frame open() reports the failure.
void FfmpegReader::note_damage() {
    if (warning_.empty() && info_.channels > 0) {
        warning_ = fmt::format("{}: is damaged at {:.2f} s",
                               path_.string(),
                               static_cast<double>(decoded_until_) / info_.rate.hertz());
    }
}

// At the end: notes a file that is shorter than it claims. A length that FFmpeg estimated from the
// bit rate is no claim, and after a seek the position must be known.
void FfmpegReader::note_end() {
    is_ended_ = true;
    const bool is_claim_sure =
        container_->duration_estimation_method != AVFMT_DURATION_FROM_BITRATE;
    const double seconds = static_cast<double>(decoded_until_) / info_.rate.hertz();
    if (warning_.empty() && is_claim_sure && info_.claimed_seconds && is_placed_ &&
        seconds < *info_.claimed_seconds - kShortBySeconds) {
        warning_ = fmt::format("{}: is damaged or cut off at {:.2f} s", path_.string(), seconds);
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
        av_packet_unref(packet_.get());
        if (sent < 0 && sent != AVERROR(EAGAIN)) {
            note_damage();
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

// Position of the current frame: after the last one or, after a seek, by its time stamp.
void FfmpegReader::place_frame() {
    const std::int64_t timestamp = frame_->best_effort_timestamp;
    if (first_timestamp_ == AV_NOPTS_VALUE) {
        first_timestamp_ = timestamp != AV_NOPTS_VALUE ? timestamp : 0;
    }
    if (is_placed_ || timestamp == AV_NOPTS_VALUE) {
        return;
    }
    // FFmpeg's time stamps need not start at 0.
    decoded_until_ = on_frame_grid(frames_of(timestamp - first_timestamp_));
    is_placed_ = true;
}

// Converts the current frame into the buffer.
void FfmpegReader::take_frame() {
    const int channels = frame_->ch_layout.nb_channels;
    if (info_.channels == 0) {
        if (const auto head = check_head(path_, frame_->sample_rate, channels); !head) {
            head_fault_ = head.error().message;
            return;
        }
        info_.rate = SampleRate(frame_->sample_rate);
        info_.channels = channels;
    }
    if (frame_->sample_rate <= 0 || channels < 1 || channels > kMaxFileChannels ||
        !prepare_converter()) {
        note_damage();
        return;
    }
    place_frame();
    // Removes what was read, so that the buffer holds about one frame at most.
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_at_));
    buffer_at_ = 0;
    const std::size_t before = buffer_.size();
    const auto width = static_cast<std::size_t>(info_.channels);
    const int room = swr_get_out_samples(converter_.get(), frame_->nb_samples);
    buffer_.resize(before + static_cast<std::size_t>(std::max(room, 0)) * width);
    auto* out = reinterpret_cast<std::uint8_t*>(buffer_.data() + before);
    const auto** in = const_cast<const std::uint8_t**>(frame_->extended_data);
    const int made = swr_convert(converter_.get(), &out, room, in, frame_->nb_samples);
    buffer_.resize(before + static_cast<std::size_t>(std::max(made, 0)) * width);
    // The converter may keep samples back; what came out counts.
    decoded_until_ += std::max(made, 0);
    drop_until_target();
}

// After a seek the decoder starts before the target; frames before it are skipped.
void FfmpegReader::drop_until_target() {
    const auto width = static_cast<std::size_t>(info_.channels);
    const std::int64_t start = decoded_until_ - static_cast<std::int64_t>(buffered_frames());
    if (start < target_) {
        const auto surplus = static_cast<std::size_t>(target_ - start);
        buffer_at_ += std::min(surplus, buffered_frames()) * width;
    }
}

// Decodes as needed; fewer frames than wanted mean the end.
std::size_t FfmpegReader::read(std::span<float> interleaved) {
    const auto width = static_cast<std::size_t>(info_.channels);
    const std::size_t wanted = interleaved.size() / width;
    std::size_t done = 0;
    while (done < wanted) {
        const std::size_t count = std::min(wanted - done, buffered_frames());
        std::copy_n(buffer_.data() + buffer_at_, count * width, interleaved.data() + done * width);
        buffer_at_ += count * width;
        done += count;
        if (done < wanted && !decode_next()) {
            break;
        }
    }
    return done;
}

Expected<AudioFileReaderPtr> open_by_ffmpeg(const std::filesystem::path& path) {
    auto reader = std::make_unique<FfmpegReader>(path);
    if (auto opened = reader->open(); !opened) {
        return fail(opened.error());
    }
    return reader;
}

}  // namespace raks::audio
