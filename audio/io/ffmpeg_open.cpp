// Opening a container and its sound track, and what they say of the length.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_reader.hpp"
#include "audio/io/ffmpeg_tags.hpp"
#include "audio/io/ffmpeg_window.hpp"

namespace raks::audio {
namespace {

// Containers of sound and video only: FFmpeg would also open pictures, subtitles, plain text and
// play-lists (which name other files) as media.
constexpr const char* kFormats =
    "mp3,aac,mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,ogg,asf,avi,flv,flac,wav,w64,aiff,au,caf,ac3,"
    "eac3,dts,amr,amrnb,amrwb,ape,wv,tta,tak,mpc,mpc8,mpeg,mpegts,mpegvideo,rm,xwma,dsf,oma,loas,"
    "gxf,mxf,nut,swf,voc,aa,aax,adts,latm";

// Decoders of sound in such files; those of pictures are never run.
constexpr const char* kCodecs =
    "mp3float,mp3,mp2float,mp2,mp1float,mp1,mp3adufloat,mp3on4float,aac,aac_fixed,aac_latm,ac3,"
    "ac3_fixed,eac3,dca,truehd,mlp,flac,alac,vorbis,libvorbis,opus,libopus,speex,libspeex,wavpack,"
    "ape,tta,tak,als,mpc7,mpc8,wmav1,wmav2,wmapro,wmalossless,wmavoice,amrnb,amrwb,"
    "libopencore_amrnb,libopencore_amrwb,atrac1,atrac3,atrac3al,atrac3plus,atrac3plusal,atrac9,"
    "cook,ra_144,ra_288,ralf,sipr,qdm2,qdmc,qcelp,evrc,ilbc,libilbc,nellymoser,gsm,gsm_ms,libgsm,"
    "libgsm_ms,truespeech,shorten,dsd_lsbf,dsd_msbf,dsd_lsbf_planar,dsd_msbf_planar,s302m,g723_1,"
    "g729,g722,g726,g726le,mace3,mace6,dvaudio,metasound,on2avc,"
    "pcm_alaw,pcm_mulaw,pcm_vidc,pcm_bluray,pcm_dvd,pcm_f16le,pcm_f24le,pcm_f32be,pcm_f32le,"
    "pcm_f64be,pcm_f64le,pcm_lxf,pcm_s16be,pcm_s16be_planar,pcm_s16le,pcm_s16le_planar,pcm_s24be,"
    "pcm_s24daud,pcm_s24le,pcm_s24le_planar,pcm_s32be,pcm_s32le,pcm_s32le_planar,pcm_s64be,"
    "pcm_s64le,pcm_s8,pcm_s8_planar,pcm_sga,pcm_u16be,pcm_u16le,pcm_u24be,pcm_u24le,pcm_u32be,"
    "pcm_u32le,pcm_u8,adpcm_ima_wav,adpcm_ms,adpcm_ima_qt,adpcm_swf,adpcm_yamaha,adpcm_g722,"
    "adpcm_g726,adpcm_g726le,adpcm_ct,adpcm_sbpro_2,adpcm_sbpro_3,adpcm_sbpro_4,adpcm_aica";

// Time stamps of the file that mean something; others are counted by FFmpeg.
struct StampedFormat {
    std::string_view name;
    double least_jump;    // seconds; live recorders write FLV and ASF with more jitter
    bool may_begin_anew;  // transport streams that were cut and joined
};
constexpr std::array<StampedFormat, 8> kStamped{{{"mov", 0.02, false},
                                                 {"matroska", 0.02, false},
                                                 {"ogg", 0.02, false},
                                                 {"nut", 0.02, false},
                                                 {"mpegts", 0.02, true},
                                                 {"mpeg", 0.02, true},
                                                 {"flv", 0.1, false},
                                                 {"asf", 0.1, false}}};
constexpr double kLongestGap = 3600.0;  // seconds
constexpr double kLongestJoint = 10.0;  // of a gap in a transport stream
constexpr double kLongestOverlap = 1.0;

// Whether FFmpeg recognised the container by content and not by its name alone: a program or a font
// that is named .mp3 also holds bytes that decode. MP3 behind a foreign tag has a low score and is
// still music.
bool is_known(const AVFormatContext& container) {
    const bool is_mp3 = container.iformat->name == std::string_view("mp3");
    return container.probe_score > (is_mp3 ? 1 : AVPROBE_SCORE_RETRY);
}

// Is there a moving picture? Covers of albums are pictures, too.
AVStream* video_of(const AVFormatContext& container) {
    for (unsigned i = 0; i < container.nb_streams; ++i) {
        AVStream* const stream = container.streams[i];
        const bool is_cover = (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
        if (stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO && !is_cover) {
            return stream;
        }
    }
    return nullptr;
}

// The first time stamp of a track of pictures. As these are not decoded, FFmpeg takes the sound's
// for it in Matroska, whose index of the pictures that stand alone knows better.
std::optional<std::int64_t> start_of(AVStream& stream, const AVFormatContext& container) {
    if (std::string_view(container.iformat->name).starts_with("matroska")) {
        if (const AVIndexEntry* const first = avformat_index_get_entry(&stream, 0)) {
            return first->timestamp;
        }
    }
    return stream.start_time == AV_NOPTS_VALUE ? std::nullopt : std::optional(stream.start_time);
}

// Packets of subtitles, data and attachments are not even read; those of pictures tell the time.
void drop_what_is_not_heard(const AVFormatContext& container) {
    for (unsigned i = 0; i < container.nb_streams; ++i) {
        const AVMediaType kind = container.streams[i]->codecpar->codec_type;
        if (kind != AVMEDIA_TYPE_AUDIO && kind != AVMEDIA_TYPE_VIDEO &&
            kind != AVMEDIA_TYPE_UNKNOWN) {
            container.streams[i]->discard = AVDISCARD_ALL;
        }
    }
}

// Seconds of a track's end as Matroska's muxers note it, "00:00:08.092000000"; 0: none.
double tagged_end(const AVStream& stream) {
    const AVDictionaryEntry* tag =
        av_dict_get(stream.metadata, "DURATION", nullptr, AV_DICT_IGNORE_SUFFIX);
    int hours = 0;
    int minutes = 0;
    double seconds = 0.0;
    if (tag == nullptr || std::sscanf(tag->value, "%d:%d:%lf", &hours, &minutes, &seconds) != 3) {
        return 0.0;
    }
    return 3600.0 * hours + 60.0 * minutes + seconds;
}

}  // namespace

Expected<void> FfmpegReader::open() {
    // FFmpeg would print; its errors are returned from here instead.
    av_log_set_level(AV_LOG_QUIET);
    extent_ = read_container_extent(input_.window);
    if (auto opened = open_container(); !opened) {
        return opened;
    }
    if (auto opened = open_decoder(); !opened) {
        return opened;
    }
    return describe();
}

bool FfmpegReader::open_window() {
    container_.reset();
    cursor_ = WindowCursor{input_.window};
    window_ = read_through(cursor_);
    return window_ != nullptr;
}

// Opens the file and finds its streams.
Expected<void> FfmpegReader::open_container() {
    AVFormatContext* context = nullptr;
    AVDictionary* options = nullptr;
    // Files alone: a play-list or a container must not make FFmpeg open network addresses.
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", kFormats, 0);
    av_dict_set(&options, "codec_whitelist", kCodecs, 0);
    // Of MP4 the tempo, too, which FFmpeg leaves out otherwise.
    av_dict_set(&options, "export_all", "1", 0);
    // A path with a colon would be read as a protocol.
    const std::string url = "file:" + input_.path.string();
    if (!open_window()) {
        return fail(input_.path.string() + ": no memory to open it");
    }
    context = avformat_alloc_context();
    context->pb = window_.get();
    const int error = avformat_open_input(&context, url.c_str(), nullptr, &options);
    av_dict_free(&options);
    container_.reset(context);
    if (extent_.lacks_index) {
        return fail(
            fmt::format("{}: is cut off at {} bytes, before its index, without which its "
                        "sound cannot be found; copy or record it again",
                        input_.path.string(),
                        input_.window.size()));
    }
    if (error < 0 || !is_known(*context)) {
        return fail(input_.path.string() + ": is not audio that can be read");
    }
    drop_what_is_not_heard(*context);
    if (const int found = avformat_find_stream_info(context, nullptr); found < 0) {
        return fail(input_.path.string() +
                    ": is not audio that can be read: " + ffmpeg_reason(found));
    }
    return {};
}

// Chooses the best sound track and opens its decoder.
Expected<void> FfmpegReader::open_decoder() {
    const AVCodec* codec = nullptr;
    const int index = av_find_best_stream(container_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
    if (index < 0) {
        return fail(input_.path.string() + ": has no sound track");
    }
    // Packets of pictures and other tracks are dropped by the container's reader.
    for (unsigned i = 0; i < container_->nb_streams; ++i) {
        if (static_cast<int>(i) != index) {
            container_->streams[i]->discard = AVDISCARD_ALL;
        }
    }
    stream_ = container_->streams[index];
    const AVCodecParameters& head = *stream_->codecpar;
    if (auto checked = check_head(input_.path, head.sample_rate, head.ch_layout.nb_channels);
        !checked) {
        return checked;
    }
    decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_ || avcodec_parameters_to_context(decoder_.get(), stream_->codecpar) < 0) {
        return fail(input_.path.string() + ": its sound track cannot be decoded");
    }
    // FFmpeg needs the time base to correct time stamps where it trims samples.
    decoder_->pkt_timebase = stream_->time_base;
    // One thread is enough for sound.
    decoder_->thread_count = 1;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "codec_whitelist", kCodecs, 0);
    const int error = avcodec_open2(decoder_.get(), codec, &options);
    av_dict_free(&options);
    if (error < 0) {
        return fail(input_.path.string() +
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
        return fail(input_.path.string() + ": holds no sound that can be decoded");
    }
    first_frames_ = static_cast<std::int64_t>((buffer_.size() - buffer_at_)) / info_.channels;
    line_.set_grid(lead_ + first_frames_, typical_frames_);
    const std::string_view codec = decoder_->codec->name;
    info_.format = codec == "mp3float" || codec == "mp3"
                       ? "MP3"
                       : fmt::format("{} in {}", codec, container_->iformat->name);
    info_.tags = tags_of(*container_, *stream_);
    claim_length();
    tell_notes();
    return {};
}

// Time line of the file: its origin is the first sound or, in a film, what comes first of sound and
// picture.
void FfmpegReader::prepare_time_line(std::int64_t first_stamp) {
    const std::string_view format = container_->iformat->name;
    const auto* stamped =
        std::find_if(kStamped.begin(), kStamped.end(), [format](const StampedFormat& known) {
            return format == known.name || format.starts_with(std::string(known.name) + ",");
        });
    const double rate = info_.rate.hertz();
    TimeLineRules rules{.unit = stream_->time_base, .rate = info_.rate.hertz()};
    if (stamped != kStamped.end()) {
        rules.are_from_file = true;
        rules.is_jitter_left_out = input_.has_loose_stamps;
        rules.least_jump = std::llround(stamped->least_jump * rate);
        rules.longest_gap =
            std::llround((stamped->may_begin_anew ? kLongestJoint : kLongestGap) * rate);
        rules.longest_overlap = std::llround(kLongestOverlap * rate);
    }
    std::int64_t origin = first_stamp;
    AVStream* const video = video_of(*container_);
    if (const auto start = video == nullptr ? std::nullopt : start_of(*video, *container_);
        rules.are_from_file && start) {
        origin = std::min(origin, av_rescale_q(*start, video->time_base, stream_->time_base));
    }
    line_.prepare(rules, origin);
    // A late start that is shorter than what counts as a gap is rounding, and one that is longer
    // than any gap a wrong time stamp.
    const std::int64_t lead = line_.frames_of(first_stamp - origin);
    if (lead < rules.least_jump || lead > rules.longest_gap) {
        line_.prepare(rules, first_stamp);
    }
}

// The end of the sound as the file tells it: by the track, by a tag, or, where there is no picture
// that may be longer, by the container.
void FfmpegReader::claim_length() {
    const bool is_film = video_of(*container_) != nullptr;
    const double rate = info_.rate.hertz();
    const double unit = av_q2d(stream_->time_base);
    std::optional<double> end;
    if (container_->duration > 0) {
        info_.claimed_seconds = static_cast<double>(container_->duration) / AV_TIME_BASE;
        end = is_film ? std::nullopt : info_.claimed_seconds;
    }
    if (is_film && stream_->duration > 0 && stream_->start_time != AV_NOPTS_VALUE) {
        const std::int64_t stamp = stream_->start_time + stream_->duration;
        end = static_cast<double>(stamp - line_.stamp_of(0)) * unit;
    } else if (const double tagged = tagged_end(*stream_); is_film && tagged > 0.0) {
        end = tagged - static_cast<double>(line_.stamp_of(0)) * unit;
    }
    if (end && *end > 0.0) {
        info_.claimed_seconds = end;
    }
    // A length that FFmpeg estimated from the bit rate is no claim.
    const bool is_sure = container_->duration_estimation_method != AVFMT_DURATION_FROM_BITRATE;
    claimed_end_ = is_sure && end ? std::llround(*end * rate) : 0;
}

Expected<AudioFileReaderPtr> open_by_ffmpeg(const DecoderInput& input) {
    auto reader = std::make_unique<FfmpegReader>(input);
    if (auto opened = reader->open(); !opened) {
        return fail(opened.error());
    }
    return reader;
}

}  // namespace raks::audio
