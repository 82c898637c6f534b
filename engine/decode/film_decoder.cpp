#include "engine/decode/film_decoder.hpp"

extern "C" {
#include <libavutil/dict.h>
#include <libavutil/display.h>
#include <libavutil/log.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_window.hpp"

namespace raks::engine {
namespace {

// Containers of films and single pictures. No play-lists, which name other files.
constexpr const char* kFormats =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,ogg,asf,avi,flv,mpeg,mpegts,mxf,nut,yuv4mpegpipe,"
    "png_pipe,jpeg_pipe";

// Decoders of pictures; and of sound, of which FFmpeg looks at the first samples.
constexpr const char* kCodecs =
    "h264,hevc,mpeg4,mjpeg,vp8,vp9,libvpx,libvpx-vp9,libdav1d,libaom-av1,prores,rawvideo,png,"
    "aac,aac_latm,mp3float,mp3,ac3,eac3,flac,alac,vorbis,opus,amrnb,amrwb,pcm_s16le,pcm_s16be,"
    "pcm_s24le,pcm_s24be,pcm_s32le,pcm_f32le,pcm_u8,pcm_alaw,pcm_mulaw,adpcm_ima_qt,adpcm_ima_wav";
constexpr const char* kNamesOfCodecs =
    "H.264, HEVC, MPEG-4, Motion JPEG, VP8, VP9, AV1, ProRes, PNG or uncompressed";

constexpr int kMaxFaultsInARow = 2000;    // of packets: passes a damaged stretch, ends at last
constexpr double kLeastLead = 0.02;       // seconds; a sound's later start below it is rounding
constexpr double kShortByRounding = 1.0;  // seconds below the claimed length

double seconds_of(std::int64_t stamp, const AVStream& track) {
    return static_cast<double>(stamp) * av_q2d(track.time_base);
}

std::optional<double> start_of(const AVStream& track) {
    return track.start_time == AV_NOPTS_VALUE ? std::nullopt
                                              : std::optional(seconds_of(track.start_time, track));
}

bool is_cover(const AVStream& stream) {
    return (stream.disposition & (AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS)) !=
           0;
}

// Of a track's or a picture's matrix, FFmpeg's or that of a photograph's Exif.
template <typename Data>
std::optional<Orientation> orientation_of(const Data* bytes, std::size_t size) {
    std::array<std::int32_t, 9> matrix{};
    if (bytes == nullptr || size < sizeof matrix) {
        return std::nullopt;
    }
    std::memcpy(matrix.data(), bytes, sizeof matrix);
    return Orientation::of_matrix(matrix);
}

// The date of a film, "2026-11-30T16:21:36.000000Z", in seconds since 1970; 0: it has none.
double date_of(const AVFormatContext& container) {
    constexpr int kFirstYear = 1980;  // phones whose clock is not set say 1904 or 1970
    constexpr int kLastYear = 2200;
    const AVDictionaryEntry* const date =
        av_dict_get(container.metadata, "creation_time", nullptr, 0);
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    int second = 0;
    // NOLINTNEXTLINE(cert-err34-c): numbers that do not fit are refused below.
    if (date == nullptr ||
        std::sscanf(
            date->value, "%4d-%2u-%2uT%2d:%2d:%2d", &year, &month, &day, &hour, &minute, &second) !=
            6) {
        return 0.0;
    }
    const std::chrono::year_month_day calendar{
        std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    if (!calendar.ok() || year < kFirstYear || year > kLastYear) {
        return 0.0;
    }
    const auto days = std::chrono::sys_days(calendar).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

}  // namespace

Expected<std::unique_ptr<FilmDecoder>> FilmDecoder::open(const std::string& name,
                                                         const audio::FileWindow& window) {
    // FFmpeg would print; its errors are returned from here instead.
    av_log_set_level(AV_LOG_QUIET);
    if (window.size() == 0) {
        return fail(name + ": is empty");
    }
    std::unique_ptr<FilmDecoder> film(new FilmDecoder(name, window));
    for (const auto step :
         {&FilmDecoder::open_container, &FilmDecoder::choose_track, &FilmDecoder::open_decoder}) {
        if (auto done = ((*film).*step)(); !done) {
            return fail(std::move(done.error()).in(name));
        }
    }
    film->describe();
    return film;
}

Expected<void> FilmDecoder::open_container() {
    extent_ = audio::read_container_extent(cursor_.window);
    window_ = audio::read_through(cursor_);
    AVFormatContext* context = avformat_alloc_context();
    if (window_ == nullptr || context == nullptr) {
        avformat_free_context(context);
        return fail("no memory to open it");
    }
    context->pb = window_.get();
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", kFormats, 0);
    av_dict_set(&options, "codec_whitelist", kCodecs, 0);
    // The name decides nothing: it is recognised by content.
    const int error = avformat_open_input(&context, "file:film", nullptr, &options);
    av_dict_free(&options);
    container_.reset(context);
    if (extent_.lacks_index) {
        return fail(
            fmt::format("is cut off at {} bytes, before its index, without which its pictures "
                        "cannot be found; copy or record it again",
                        cursor_.window.size()));
    }
    if (error < 0 || context->probe_score <= AVPROBE_SCORE_RETRY ||
        avformat_find_stream_info(context, nullptr) < 0) {
        return fail("is not a film or picture that can be read");
    }
    return {};
}

// The first track of pictures that are no cover.
Expected<void> FilmDecoder::choose_track() {
    for (unsigned i = 0; i < container_->nb_streams; ++i) {
        AVStream* const stream = container_->streams[i];
        const bool is_chosen = track_ == nullptr && !is_cover(*stream) &&
                               stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO;
        if (is_chosen) {
            track_ = stream;
        } else {
            stream->discard = AVDISCARD_ALL;
        }
    }
    if (track_ == nullptr) {
        return fail("has no track of pictures");
    }
    const AVCodecParameters& head = *track_->codecpar;
    if (head.width > kMostFilmPixels || head.height > kMostFilmPixels) {
        return fail(fmt::format("has pictures of {} x {}, at most {} x {} are read",
                                head.width,
                                head.height,
                                kMostFilmPixels,
                                kMostFilmPixels));
    }
    return {};
}

Expected<void> FilmDecoder::open_decoder() {
    codec_ = avcodec_find_decoder(track_->codecpar->codec_id);
    // FFmpeg's own AV1 decoder only drives graphics cards.
    if (track_->codecpar->codec_id == AV_CODEC_ID_AV1) {
        const AVCodec* const dav1d = avcodec_find_decoder_by_name("libdav1d");
        codec_ = dav1d != nullptr ? dav1d : avcodec_find_decoder_by_name("libaom-av1");
    }
    const std::string coded = avcodec_get_name(track_->codecpar->codec_id);
    decoder_.reset(avcodec_alloc_context3(codec_));
    if (codec_ == nullptr || !decoder_ ||
        avcodec_parameters_to_context(decoder_.get(), track_->codecpar) < 0) {
        return fail("its pictures (" + coded + ") cannot be decoded");
    }
    decoder_->pkt_timebase = track_->time_base;
    decoder_->thread_count = 1;  // more are not allowed in the cage
    decoder_->max_pixels = std::int64_t{kMostFilmPixels} * kMostFilmPixels;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "codec_whitelist", kCodecs, 0);
    const int error = avcodec_open2(decoder_.get(), codec_, &options);
    av_dict_free(&options);
    if (error < 0) {
        return fail(
            fmt::format("its pictures ({}) cannot be decoded; {} are: convert it with "
                        "ffmpeg -i FILM -crf 16 NEW.mp4",
                        coded,
                        kNamesOfCodecs));
    }
    return {};
}

void FilmDecoder::describe() {
    const AVCodecParameters& head = *track_->codecpar;
    std::size_t size = 0;
    const std::uint8_t* const matrix =
        av_stream_get_side_data(track_, AV_PKT_DATA_DISPLAYMATRIX, &size);
    orientation_ = orientation_of(matrix, size).value_or(Orientation{});
    info_.width = head.width;
    info_.height = head.height;
    if (orientation_.is_transposed) {
        std::swap(info_.width, info_.height);
    }
    info_.turned = orientation_.degrees();
    if (track_->avg_frame_rate.num > 0 && track_->avg_frame_rate.den > 0) {
        info_.pictures_per_second = av_q2d(track_->avg_frame_rate);
    }
    if (track_->duration > 0) {
        info_.claimed_seconds = seconds_of(track_->duration, *track_);
    } else if (container_->duration > 0) {
        info_.claimed_seconds = static_cast<double>(container_->duration) / AV_TIME_BASE;
    }
    info_.recorded = date_of(*container_);
    info_.format = fmt::format("{} in {}", codec_->name, container_->iformat->name);
    zero_ = start_of_time();
}

// As the sound's decoder has it (audio/io/ffmpeg_open.cpp).
double FilmDecoder::start_of_time() const {
    const std::optional<double> picture = start_of(*track_);
    const int index = av_find_best_stream(container_.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
    auto sound = index < 0 ? std::nullopt : start_of(*container_->streams[index]);
    if (!picture || !sound) {
        return picture.value_or(0.0);
    }
    // Matroska's sound begins with what its coder adds, which is not heard.
    if (std::string_view(container_->iformat->name).starts_with("matroska")) {
        const AVCodecParameters& head = *container_->streams[index]->codecpar;
        *sound += static_cast<double>(head.initial_padding) / std::max(head.sample_rate, 1);
    }
    return *sound - *picture < kLeastLead ? *sound : *picture;
}

// Gives the decoder the next packet of the track, or the end. False: nothing more comes.
bool FilmDecoder::feed() {
    for (int faults = 0; faults < kMaxFaultsInARow;) {
        const int got = av_read_frame(container_.get(), packet_.get());
        if (got == AVERROR_EOF || (got < 0 && avio_feof(container_->pb) != 0)) {
            break;
        }
        int sent = got;
        if (got >= 0 && packet_->stream_index == track_->index) {
            sent = avcodec_send_packet(decoder_.get(), packet_.get());
        }
        const bool is_ours = got >= 0 && packet_->stream_index == track_->index;
        av_packet_unref(packet_.get());
        if (is_ours && sent >= 0) {
            return true;
        }
        if (got < 0 || is_ours) {
            ++faults;
            first_damage_ = damaged_ == 0 ? seconds_ : first_damage_;
            ++damaged_;
        }
    }
    is_flushed_ = true;
    return avcodec_send_packet(decoder_.get(), nullptr) >= 0;
}

// The next decoded picture into frame_; false at the end.
bool FilmDecoder::receive() {
    for (int faults = 0; faults < kMaxFaultsInARow;) {
        const int got = avcodec_receive_frame(decoder_.get(), frame_.get());
        if (got == 0) {
            return true;
        }
        if (got == AVERROR_EOF || (got == AVERROR(EAGAIN) && (is_flushed_ || !feed()))) {
            return false;
        }
        faults += got == AVERROR(EAGAIN) ? 0 : 1;
    }
    return false;
}

// Gives the picture its time. False for one that is left out.
bool FilmDecoder::place() {
    const double rate = info_.pictures_per_second;
    double seconds = seconds_ + (has_picture_ && rate > 0.0 ? 1.0 / rate : 0.0);
    if (frame_->best_effort_timestamp != AV_NOPTS_VALUE) {
        seconds = seconds_of(frame_->best_effort_timestamp, *track_) - zero_;
    }
    if (!std::isfinite(seconds) || (has_picture_ && seconds <= seconds_)) {
        ++left_out_;
        return false;
    }
    if ((frame_->flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame_->decode_error_flags != 0) {
        first_damage_ = damaged_ == 0 ? seconds : first_damage_;
        ++damaged_;
    }
    seconds_ = seconds;
    return true;
}

Expected<std::optional<DecodedFilmPicture>> FilmDecoder::next() {
    while (!is_at_end_ && receive()) {
        if (frame_->width < 1 || frame_->height < 1 || !place()) {
            continue;
        }
        if (has_picture_ && (frame_->width != stored_width_ || frame_->height != stored_height_)) {
            end_note_ = fmt::format("its pictures become {} x {} at {:.2f} s; the rest is left out",
                                    frame_->width,
                                    frame_->height,
                                    seconds_);
            is_at_end_ = true;
            return std::nullopt;
        }
        if (!has_picture_) {
            const AVFrameSideData* const turned =
                av_frame_get_side_data(frame_.get(), AV_FRAME_DATA_DISPLAYMATRIX);
            if (turned != nullptr) {
                orientation_ = orientation_of(turned->data, turned->size).value_or(orientation_);
            }
        }
        has_picture_ = true;
        stored_width_ = frame_->width;
        stored_height_ = frame_->height;
        const auto rgb = converter_.to_rgb(*frame_, orientation_);
        if (!rgb) {
            return fail(name_ + ": " + rgb.error().message);
        }
        DecodedFilmPicture picture{seconds_, frame_->width, frame_->height, *rgb};
        if (orientation_.is_transposed) {
            std::swap(picture.width, picture.height);
        }
        return picture;
    }
    if (!is_at_end_) {
        note_end();
    }
    return std::nullopt;
}

// Where the container tells how many bytes it has, these decide; else the length that it claims.
void FilmDecoder::note_end() {
    is_at_end_ = true;
    const double missing = info_.claimed_seconds - seconds_;
    const bool is_short = !extent_.is_known && missing > kShortByRounding;
    if (!has_picture_) {
        end_note_ = "holds no picture that can be decoded";
    } else if (extent_.missing_bytes > 0 || is_short) {
        end_note_ = audio::cut_off_note(seconds_, std::max(missing, 0.0));
    } else if (cursor_.window.has_grown()) {
        end_note_ = audio::kHasGrown;
    }
}

std::string FilmDecoder::warning() const {
    std::string text;
    if (damaged_ > 0) {
        audio::add_note(
            text,
            name_,
            fmt::format(
                "{} of its pictures are damaged, the first at {:.2f} s", damaged_, first_damage_));
    }
    if (left_out_ > 0) {
        audio::add_note(
            text,
            name_,
            fmt::format("{} pictures whose time stamps run back are left out", left_out_));
    }
    audio::add_note(text, name_, end_note_);
    return text;
}

}  // namespace raks::engine
