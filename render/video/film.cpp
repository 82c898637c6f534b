#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"
#include "render/video/film_encoders.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {
namespace {

/// FFmpeg's name of a container.
const char* muxer_name(FilmForm form) {
    switch (form) {
        case FilmForm::mkv:
            return "matroska";
        case FilmForm::webm:
            return "webm";
        case FilmForm::avi:
            return "avi";
        case FilmForm::mov:
            return "mov";
        case FilmForm::mp4:
            break;
    }
    return "mp4";
}

/// A film through FFmpeg's libraries. Sound is encoded only as far as the pictures reach, so that
/// both tracks grow side by side and end together.
class Film final : public VideoWriter {
 public:
    Film(PendingFile file, std::string name, const VideoOptions& options)
        : file_(std::move(file)), name_(std::move(name)), options_(options) {}

    [[nodiscard]] Expected<void> open(FilmForm form);
    Expected<void> add_picture(std::span<const std::uint8_t> rgba) override;
    Expected<void> add_sound(std::span<const float> interleaved) override;
    Expected<void> finish() override;
    Expected<std::filesystem::path> finish_stopped() override;

 private:
    /// All that makes it a film, but its name.
    [[nodiscard]] Expected<void> complete();
    /// Sends a frame (null: the end) and writes what the encoder gives back.
    [[nodiscard]] Expected<void> encode(AVCodecContext& codec,
                                        const AVStream& stream,
                                        const AVFrame* frame);
    [[nodiscard]] Expected<void> write_header(const std::string& url);
    [[nodiscard]] Expected<void> write_trailer();
    [[nodiscard]] Expected<void> make_plain();
    [[nodiscard]] Expected<void> encode_sound();
    /// Audio frames until the end of the last picture, rounded down.
    [[nodiscard]] std::int64_t sound_end() const noexcept;
    /// After this every call fails with the same line.
    [[nodiscard]] tl::unexpected<Error> give_up(const std::string& why);
    [[nodiscard]] Expected<AVStream*> add_stream(const AVCodecContext& codec);

    FilmForm form_ = FilmForm::mp4;
    PendingFile file_;  // first of what writes, so that it is removed after the muxer closed it
    std::string name_;
    VideoOptions options_;
    MuxerHandle muxer_;
    std::optional<PictureEncoder> pictures_;
    std::optional<SoundEncoder> sound_;
    AVStream* picture_stream_ = nullptr;  // the muxer's
    AVStream* sound_stream_ = nullptr;
    std::array<std::optional<std::int64_t>, 2> first_dts_;  // of each stream, in its codec's time
    PacketHandle packet_;
    std::int64_t picture_count_ = 0;
    std::int64_t head_bytes_ = 0;  // what is on the disk before the first fragment or cluster
    bool plays_ = false;           // what is on the disk, by itself
    std::optional<Error> failure_;
};

/// The first failure is kept: what follows it would only report its consequences. So is what plays:
/// as a rule the disk is full.
tl::unexpected<Error> Film::give_up(const std::string& why) {
    failure_ = Error{name_ + ": " + why};
    if (plays_) {
        if (const auto kept = file_.commit_stopped()) {
            failure_->message += "; the film up to there lies in " + kept->string();
        }
    }
    return fail(*failure_);
}

/// A track of the file for an encoder that is open.
Expected<AVStream*> Film::add_stream(const AVCodecContext& codec) {
    AVStream* const stream = avformat_new_stream(muxer_.get(), nullptr);
    if (stream == nullptr || avcodec_parameters_from_context(stream->codecpar, &codec) < 0) {
        return give_up("out of memory");
    }
    // A wish: the muxer may choose another when it writes the header.
    stream->time_base = codec.time_base;
    stream->avg_frame_rate = codec.framerate;
    return stream;
}

/// Opens the encoders first, so that a wrong option is refused before anything is written.
Expected<void> Film::open(FilmForm form) {
    AVFormatContext* muxer = nullptr;
    form_ = form;
    // With the protocol named, a path with a colon in it is not taken for another protocol.
    const std::string url = "file:" + file_.part().string();
    const char* const format = muxer_name(form);
    if (const int error = avformat_alloc_output_context2(&muxer, nullptr, format, url.c_str());
        error < 0) {
        return give_up("this FFmpeg cannot write ." + std::string(format) + ": " +
                       av_reason(error));
    }
    muxer_.reset(muxer);
    // No date and no library version in the file; what is written is there if we are killed.
    muxer_->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_FLUSH_PACKETS;
    if (!options_.comment.empty()) {
        av_dict_set(&muxer_->metadata, "comment", options_.comment.c_str(), 0);
    }
    packet_.reset(av_packet_alloc());

    auto pictures = PictureEncoder::create(form, options_, muxer_->oformat->flags);
    if (!pictures) {
        return give_up(pictures.error().message);
    }
    pictures_ = std::move(*pictures);
    auto stream = add_stream(pictures_->codec());
    if (!stream) {
        return fail(stream.error());
    }
    picture_stream_ = *stream;
    if (options_.audio_channels > 0) {
        auto sound = SoundEncoder::create(form, options_, muxer_->oformat->flags);
        if (!sound) {
            return give_up(sound.error().message);
        }
        sound_ = std::move(*sound);
        stream = add_stream(sound_->codec());
        if (!stream) {
            return fail(stream.error());
        }
        sound_stream_ = *stream;
    }
    return write_header(url);
}

/// What is on the disk plays at any time: fragments, or clusters of a second.
Expected<void> Film::write_header(const std::string& url) {
    AVDictionary* options = nullptr;
    if (form_ == FilmForm::mp4) {
        av_dict_set(&options, "movflags", "+frag_keyframe+delay_moov+default_base_moof", 0);
    } else if (form_ == FilmForm::mov) {
        // Every picture is a key frame: fragments are a second long.
        av_dict_set(&options, "movflags", "+delay_moov+default_base_moof", 0);
        av_dict_set(&options, "frag_duration", "1000000", 0);  // microseconds
    } else if (form_ != FilmForm::avi) {
        av_dict_set(&options, "cluster_time_limit", "1000", 0);  // milliseconds
        // The sound's delay is taken off in encode().
        muxer_->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
    }
    int error = avio_open(&muxer_->pb, url.c_str(), AVIO_FLAG_WRITE);
    if (error >= 0) {
        error = avformat_write_header(muxer_.get(), &options);
    }
    av_dict_free(&options);
    if (error < 0) {
        return give_up("cannot be written: " + av_reason(error));
    }
    head_bytes_ = avio_tell(muxer_->pb);
    return {};
}

Expected<void> Film::encode(AVCodecContext& codec, const AVStream& stream, const AVFrame* frame) {
    if (const int error = avcodec_send_frame(&codec, frame); error < 0) {
        return give_up("cannot be encoded: " + av_reason(error));
    }
    for (;;) {
        int error = avcodec_receive_packet(&codec, packet_.get());
        // The encoder wants more input, or, after the end was sent, has given everything.
        if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) {
            return {};
        }
        if (error < 0) {
            return give_up("cannot be encoded: " + av_reason(error));
        }
        if (packet_->duration == 0 && codec.codec_type == AVMEDIA_TYPE_VIDEO) {
            packet_->duration = 1;  // else the last picture of an .mp4 has no length
        }
        // Matroska's readers take the encoder's delay off once more.
        if (form_ == FilmForm::mkv || form_ == FilmForm::webm) {
            packet_->pts += codec.initial_padding;
            packet_->dts += codec.initial_padding;
        }
        std::optional<std::int64_t>& first = first_dts_.at(static_cast<std::size_t>(stream.index));
        first = first.value_or(packet_->dts);
        // Encoder and container count time in different units.
        av_packet_rescale_ts(packet_.get(), codec.time_base, stream.time_base);
        packet_->stream_index = stream.index;
        // The muxer orders the packets of both tracks by time.
        error = av_interleaved_write_frame(muxer_.get(), packet_.get());
        if (error < 0) {
            return give_up("cannot be written: " + av_reason(error));
        }
        if (!plays_ && avio_tell(muxer_->pb) > head_bytes_) {
            plays_ = true;
            file_.keep_from_here();
        }
    }
}

/// pictures * rate of the sound / fps, in integers: no rounding error adds up over a long film.
std::int64_t Film::sound_end() const noexcept {
    return av_rescale_rnd(
        picture_count_,
        static_cast<std::int64_t>(sound_->codec().sample_rate) * options_.rate.denominator,
        options_.rate.numerator,
        AV_ROUND_DOWN);
}

/// Encodes the sound that the pictures have reached; the rest waits.
Expected<void> Film::encode_sound() {
    for (;;) {
        auto frame = sound_->next(sound_end());
        if (!frame) {
            return give_up(frame.error().message);
        }
        if (!*frame) {
            return {};
        }
        if (auto done = encode(sound_->codec(), *sound_stream_, frame->get()); !done) {
            return done;
        }
    }
}

Expected<void> Film::add_picture(std::span<const std::uint8_t> rgba) {
    if (failure_) {
        return fail(*failure_);
    }
    if (auto fits = check_picture(rgba, options_); !fits) {
        return give_up(fits.error().message);
    }
    // The picture's number is its time in units of the encoder's time base.
    auto frame = pictures_->convert(rgba, picture_count_);
    if (!frame) {
        return give_up(frame.error().message);
    }
    ++picture_count_;
    if (auto done = encode(pictures_->codec(), *picture_stream_, frame->get()); !done) {
        return done;
    }
    return sound_ ? encode_sound() : Expected<void>{};
}

Expected<void> Film::add_sound(std::span<const float> interleaved) {
    if (failure_) {
        return fail(*failure_);
    }
    if (!sound_) {
        return {};
    }
    if (interleaved.size() % static_cast<std::size_t>(options_.audio_channels) != 0) {
        return give_up(std::to_string(interleaved.size()) + " samples are no whole number of " +
                       std::to_string(options_.audio_channels) + "-channel audio frames");
    }
    // Whole audio frames only: half a frame would exchange the channels from there on.
    sound_->add(interleaved);
    return encode_sound();
}

Expected<void> Film::finish() {
    auto done = complete();
    return done ? file_.commit() : done;
}

Expected<std::filesystem::path> Film::finish_stopped() {
    auto done = complete();
    return done ? file_.commit_stopped() : fail(std::move(done.error()));
}

/// Sound to the end of the last picture, then what the encoders still hold, then the trailer.
Expected<void> Film::complete() {
    if (!failure_ && picture_count_ == 0) {
        return give_up("no picture was drawn; nothing is written");
    }
    if (failure_) {
        return fail(*failure_);
    }
    if (sound_) {
        sound_->set_length(sound_end());
        if (auto done = encode_sound(); !done) {
            return done;
        }
        // A null frame ends a track: encoders look ahead and hold frames back.
        if (auto done = encode(sound_->codec(), *sound_stream_, nullptr); !done) {
            return done;
        }
    }
    if (auto done = encode(pictures_->codec(), *picture_stream_, nullptr); !done) {
        return done;
    }
    if (auto written = write_trailer(); !written) {
        return written;
    }
    // Further calls are mistakes of the caller, and get this line.
    failure_ = Error{name_ + ": is finished already"};
    return {};
}

Expected<void> Film::write_trailer() {
    int error = av_write_trailer(muxer_.get());
    // A full disk may show only when the file is closed.
    const int close_error = avio_closep(&muxer_->pb);
    error = error < 0 ? error : close_error;
    if (error < 0) {
        return give_up("cannot be written: " + av_reason(error));
    }
    plays_ = true;
    return form_ == FilmForm::mp4 || form_ == FilmForm::mov ? make_plain() : Expected<void>();
}

/// Replaces the fragments by a plain film. Until the last step the fragments stay: whenever we are
/// killed, one of the two is there whole.
Expected<void> Film::make_plain() {
    std::vector<FilmTrack> tracks = {
        {&pictures_->codec(), first_dts_[0].value_or(0), picture_count_}};
    if (sound_) {
        tracks.push_back({&sound_->codec(), first_dts_[1].value_or(0), sound_end()});
    }
    auto plain = PendingFile::create(file_.part());
    if (!plain) {
        return give_up(plain.error().message);
    }
    auto made =
        make_plain_film(muxer_name(form_), file_.part().string(), plain->part().string(), tracks);
    if (made) {
        made = plain->commit();
    }
    return made ? Expected<void>() : give_up(made.error().message);
}

}  // namespace

Expected<std::unique_ptr<VideoWriter>> create_film(const std::filesystem::path& path,
                                                   FilmForm form,
                                                   const VideoOptions& options) {
    av_log_set_level(AV_LOG_QUIET);  // what matters comes back as an error
    // A film plays up to where its writer was ended.
    auto file = PendingFile::create(path, PendingFile::AtEnd::kept);
    if (!file) {
        return fail(file.error());
    }
    auto film = std::make_unique<Film>(std::move(*file), path.string(), options);
    if (auto opened = film->open(form); !opened) {
        return fail(opened.error());
    }
    return film;
}

}  // namespace raks::render
