#include "audio/io/piped_sound.hpp"

#include <poll.h>
#include <unistd.h>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_tags.hpp"
#include "audio/io/tag_packets.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

// What can be told from its first bytes and played without going back.
constexpr const char* kPipeFormats = "wav,flac,ogg,mp3";
constexpr int kPipeBufferBytes = 16'384;
// Bytes that are looked at to tell the format: a writer in real time must not be waited for long.
constexpr std::int64_t kMostProbedBytes = 262'144;
// Milliseconds between two looks at the stop flag.
constexpr int kPollMilliseconds = 50;
// Packets in a row that do not decode, after which nothing more is expected.
constexpr int kMostBadPackets = 2000;

// The bytes of the pipe, as FFmpeg asks for them.
class PipeBytes {
 public:
    explicit PipeBytes(const OpenPipe& pipe) : pipe_(pipe) {}
    PipeBytes(const PipeBytes&) = delete;
    PipeBytes& operator=(const PipeBytes&) = delete;

    // From here on the writer may take its time.
    void end_head() noexcept { is_head_ = false; }
    [[nodiscard]] bool has_waited_too_long() const noexcept { return has_waited_too_long_; }
    [[nodiscard]] std::int64_t taken() const noexcept { return taken_; }

    static int read(void* me, std::uint8_t* to, int size) {
        return static_cast<PipeBytes*>(me)->read(to, size);
    }

 private:
    int read(std::uint8_t* to, int size);
    [[nodiscard]] bool wait_for_bytes();

    OpenPipe pipe_;
    bool is_head_ = true;
    bool has_waited_too_long_ = false;
    std::int64_t taken_ = 0;
};

// False: stopped, or the head did not come.
bool PipeBytes::wait_for_bytes() {
    const HostTime start = HostClock::now();
    for (;;) {
        if (pipe_.is_stop_requested()) {
            return false;
        }
        pollfd wanted{pipe_.descriptor, POLLIN, 0};
        // A writer that has gone, and errors, show in the read that follows.
        if (::poll(&wanted, 1, kPollMilliseconds) > 0) {
            return true;
        }
        if (is_head_ && HostClock::now() - start > pipe_.longest_wait) {
            has_waited_too_long_ = true;
            return false;
        }
    }
}

int PipeBytes::read(std::uint8_t* to, int size) {
    while (!has_waited_too_long_ && wait_for_bytes()) {
        const ssize_t got = ::read(pipe_.descriptor, to, static_cast<std::size_t>(size));
        if (got > 0) {
            taken_ += got;
            return static_cast<int>(got);
        }
        if (got == 0) {
            return AVERROR_EOF;
        }
        if (errno != EINTR && errno != EAGAIN) {
            return AVERROR(errno);
        }
    }
    return AVERROR_EXIT;
}

// Frees the buffer that FFmpeg may have replaced, then the context around it.
struct FreeBytes {
    void operator()(AVIOContext* context) const noexcept {
        av_freep(&context->buffer);
        avio_context_free(&context);
    }
};

}  // namespace

// Container and decoder, and the bytes below them.
struct PipedSound::Decoder {
    explicit Decoder(std::string pipe_name, std::unique_ptr<PipeBytes> pipe)
        : name(std::move(pipe_name)), bytes(std::move(pipe)) {}

    Expected<void> open();
    // Appends decoded frames; false at the end. `info` says rate and channels to convert to, or is
    // filled in by the first frame.
    bool decode(AudioFileInfo& info, std::vector<float>& to);
    [[nodiscard]] std::string why_not() const;

    std::string name;
    // In the order in which they need one another.
    std::unique_ptr<PipeBytes> bytes;
    std::unique_ptr<AVIOContext, FreeBytes> io;
    FfmpegHandle<AVFormatContext> container;
    FfmpegHandle<AVCodecContext> decoder;
    FfmpegHandle<AVPacket> packet{av_packet_alloc()};
    FfmpegHandle<AVFrame> frame{av_frame_alloc()};
    FfmpegHandle<SwrContext> converter;
    int stream = -1;
    // Form of the frames that the converter is made for.
    std::array<int, 3> converted_form{};
    bool is_damaged = false;
    TagPackets tags;
    bool is_flushed = false;

 private:
    bool send_next_packet();
    bool make_converter(const AudioFileInfo& info);
    void convert(const AudioFileInfo& info, std::vector<float>& to);
};

// Why the head did not become sound.
std::string PipedSound::Decoder::why_not() const {
    if (bytes->has_waited_too_long()) {
        return bytes->taken() == 0
                   ? name + ": nobody writes to this pipe; start the program that does first"
                   : name +
                         ": stopped in the middle of its header; start the program that writes it "
                         "again";
    }
    if (bytes->taken() == 0) {
        return name + ": is empty";
    }
    return name +
           ": is not sound that can be read from a pipe (WAV, FLAC, Ogg or MP3), or ends in "
           "the middle of its header";
}

Expected<void> PipedSound::Decoder::open() {
    av_log_set_level(AV_LOG_QUIET);
    auto* const buffer = static_cast<unsigned char*>(av_malloc(kPipeBufferBytes));
    io.reset(avio_alloc_context(
        buffer, kPipeBufferBytes, 0, bytes.get(), PipeBytes::read, nullptr, nullptr));
    AVFormatContext* context = avformat_alloc_context();
    if (!io || context == nullptr) {
        return fail("out of memory");
    }
    io->seekable = 0;
    context->pb = io.get();
    context->flags |= AVFMT_FLAG_CUSTOM_IO;
    context->probesize = kMostProbedBytes;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "format_whitelist", kPipeFormats, 0);
    const int error = avformat_open_input(&context, nullptr, nullptr, &options);
    av_dict_free(&options);
    container.reset(context);  // null after an error
    if (error < 0 || avformat_find_stream_info(container.get(), nullptr) < 0) {
        return fail(why_not());
    }
    const AVCodec* codec = nullptr;
    stream = av_find_best_stream(container.get(), AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
    if (stream < 0 || codec == nullptr) {
        return fail(why_not());
    }
    const AVStream& track = *container->streams[stream];
    decoder.reset(avcodec_alloc_context3(codec));
    if (!decoder || avcodec_parameters_to_context(decoder.get(), track.codecpar) < 0) {
        return fail(name + ": its sound cannot be decoded");
    }
    decoder->pkt_timebase = track.time_base;
    decoder->thread_count = 1;
    if (avcodec_open2(decoder.get(), codec, nullptr) < 0) {
        return fail(name + ": its sound cannot be decoded");
    }
    return {};
}

// The next packet of the track, or the end of the stream; false when there is nothing more to send.
bool PipedSound::Decoder::send_next_packet() {
    for (int bad = 0; bad < kMostBadPackets && !is_flushed; ++bad) {
        if (av_read_frame(container.get(), packet.get()) < 0) {
            is_flushed = true;
            return avcodec_send_packet(decoder.get(), nullptr) >= 0;
        }
        const bool is_ours = packet->stream_index == stream;
        const int sent = is_ours ? avcodec_send_packet(decoder.get(), packet.get()) : 0;
        const bool is_refused = sent < 0 && sent != AVERROR(EAGAIN);
        is_damaged =
            is_damaged ||
            (is_refused && !tags.is_tag({packet->data, static_cast<std::size_t>(packet->size)}));
        av_packet_unref(packet.get());
        if (is_ours && sent >= 0) {
            return true;
        }
    }
    return false;
}

bool PipedSound::Decoder::make_converter(const AudioFileInfo& info) {
    const std::array<int, 3> form = {
        frame->sample_rate, frame->ch_layout.nb_channels, frame->format};
    if (converter && form == converted_form) {
        return true;
    }
    AVChannelLayout layout{};
    av_channel_layout_default(&layout, info.channels);
    // Same channels: passed on as they are, whatever they are called.
    AVChannelLayout& from =
        frame->ch_layout.nb_channels == info.channels ? layout : frame->ch_layout;
    SwrContext* context = nullptr;
    const int made = swr_alloc_set_opts2(&context,
                                         &layout,
                                         AV_SAMPLE_FMT_FLT,
                                         info.rate.hertz(),
                                         &from,
                                         static_cast<AVSampleFormat>(frame->format),
                                         frame->sample_rate,
                                         0,
                                         nullptr);
    converter.reset(context);
    converted_form = form;
    if (made < 0 || swr_init(converter.get()) < 0) {
        converter.reset();
    }
    return converter != nullptr;
}

void PipedSound::Decoder::convert(const AudioFileInfo& info, std::vector<float>& to) {
    if (!make_converter(info)) {
        is_damaged = true;
        return;
    }
    const int room = swr_get_out_samples(converter.get(), frame->nb_samples);
    const std::size_t before = to.size();
    const auto channels = static_cast<std::size_t>(info.channels);
    to.resize(before + static_cast<std::size_t>(std::max(room, 0)) * channels);
    auto* out = reinterpret_cast<std::uint8_t*>(to.data() + before);
    const int made = swr_convert(converter.get(),
                                 &out,
                                 room,
                                 const_cast<const std::uint8_t**>(frame->extended_data),
                                 frame->nb_samples);
    to.resize(before + static_cast<std::size_t>(std::max(made, 0)) * channels);
}

bool PipedSound::Decoder::decode(AudioFileInfo& info, std::vector<float>& to) {
    for (int bad = 0; bad < kMostBadPackets;) {
        const int got = avcodec_receive_frame(decoder.get(), frame.get());
        if (got == 0) {
            if (info.channels == 0) {
                info.rate = SampleRate(frame->sample_rate);
                info.channels = frame->ch_layout.nb_channels;
            }
            // Beyond these the rate is refused by open(): nothing must be made of it here.
            if (info.rate.is_supported() && info.channels > 0 &&
                info.channels <= kMaxFileChannels) {
                convert(info, to);
            }
            av_frame_unref(frame.get());
            return true;
        }
        if (got == AVERROR_EOF) {
            return false;
        }
        if (got != AVERROR(EAGAIN)) {
            is_damaged = true;
            ++bad;
        }
        if (!send_next_packet()) {
            return false;
        }
    }
    return false;
}

PipedSound::PipedSound(std::unique_ptr<Decoder> decoder) : decoder_(std::move(decoder)) {}
PipedSound::~PipedSound() = default;

Expected<std::unique_ptr<AudioFileReader>> PipedSound::open(OpenPipe pipe) {
    auto decoder = std::make_unique<Decoder>(pipe.name, std::make_unique<PipeBytes>(pipe));
    std::unique_ptr<PipedSound> reader(new PipedSound(std::move(decoder)));
    Decoder& parts = *reader->decoder_;
    if (auto opened = parts.open(); !opened) {
        return fail(opened.error());
    }
    reader->info_.channels = 0;
    // The first frame says rate and channels.
    while (reader->info_.channels == 0 && parts.decode(reader->info_, reader->decoded_)) {
    }
    if (reader->info_.channels == 0) {
        return fail(parts.why_not());
    }
    if (auto checked = check_head(parts.name, reader->info_.rate.hertz(), reader->info_.channels);
        !checked) {
        return fail(checked.error());
    }
    reader->info_.format = fmt::format("{} from a pipe", parts.container->iformat->name);
    reader->info_.tags = tags_of(*parts.container, *parts.container->streams[parts.stream]);
    parts.bytes->end_head();
    return reader;
}

std::size_t PipedSound::read(std::span<float> interleaved) {
    const auto channels = static_cast<std::size_t>(info_.channels);
    while (decoded_at_ == decoded_.size()) {
        decoded_.clear();
        decoded_at_ = 0;
        if (!decoder_->decode(info_, decoded_)) {
            break;
        }
    }
    const std::size_t samples =
        std::min(interleaved.size() / channels * channels, decoded_.size() - decoded_at_);
    const auto from = decoded_.begin() + static_cast<std::ptrdiff_t>(decoded_at_);
    std::copy_n(from, samples, interleaved.begin());
    decoded_at_ += samples;
    position_ += static_cast<std::int64_t>(samples / channels);
    if (decoder_->is_damaged && warning_.empty()) {
        warning_ = fmt::format("{}: is damaged at {:.2f} s",
                               decoder_->name,
                               static_cast<double>(position_) / info_.rate.hertz());
    }
    return samples / channels;
}

Expected<void> PipedSound::seek(std::int64_t /*frame*/) {
    return fail(decoder_->name +
                ": comes through a pipe, in which there is no going back or ahead");
}

}  // namespace raks::audio
