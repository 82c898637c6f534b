#include "audio/io/lossy_codec.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/log.h>
#include <libswresample/swresample.h>
}

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "audio/io/ffmpeg_handles.hpp"

namespace raks::audio {
namespace {

constexpr int kOpusRate = 48'000;    // hertz: the rate that libopus decodes to
constexpr int kLowMp3Rate = 22'050;  // hertz, below kLowMp3Bits
constexpr int kMp3Rate = 44'100;
constexpr int kLowMp3Bits = 48'000;  // bit/s

// Rate that the codec runs at; the samples are resampled to it and back.
int coded_rate(LossyCodec codec, int bits_per_second) {
    if (codec == LossyCodec::opus) {
        return kOpusRate;
    }
    return bits_per_second < kLowMp3Bits ? kLowMp3Rate : kMp3Rate;
}

// Samples at another rate. swr compensates its own delay, and the second call below flushes it.
std::vector<float> at_rate(int from, int to, std::vector<float> samples) {
    if (from == to) {
        return samples;
    }
    AVChannelLayout mono = AV_CHANNEL_LAYOUT_MONO;
    SwrContext* context = nullptr;
    swr_alloc_set_opts2(
        &context, &mono, AV_SAMPLE_FMT_FLT, to, &mono, AV_SAMPLE_FMT_FLT, from, 0, nullptr);
    const FfmpegHandle<SwrContext> converter(context);
    if (!converter || swr_init(context) < 0) {
        return {};
    }
    // With room for rounding and for what the resampler keeps back.
    const std::int64_t wanted =
        av_rescale(static_cast<std::int64_t>(samples.size()), to, from) + 4'096;
    std::vector<float> result(static_cast<std::size_t>(wanted));
    std::size_t done = 0;
    const auto convert = [&](const float* in, std::size_t count) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(in);
        auto* out = reinterpret_cast<std::uint8_t*>(result.data() + done);
        const int made = swr_convert(context,
                                     &out,
                                     static_cast<int>(result.size() - done),
                                     in == nullptr ? nullptr : &bytes,
                                     static_cast<int>(count));
        done += static_cast<std::size_t>(std::max(made, 0));
    };
    convert(samples.data(), samples.size());
    convert(nullptr, 0);
    result.resize(done);
    return result;
}

// One encoder and one decoder of the same codec; each packet is decoded as soon as it is coded.
class RoundTrip {
 public:
    Expected<void> open(LossyCodec codec, int rate, int bits_per_second);
    Expected<std::vector<float>> run(const std::vector<float>& samples);

 private:
    Expected<void> encode(const float* samples, int count);
    Expected<void> pass_packets();
    void take_frames();

    FfmpegHandle<AVCodecContext> encoder_;
    FfmpegHandle<AVCodecContext> decoder_;
    FfmpegHandle<AVPacket> packet_{av_packet_alloc()};
    FfmpegHandle<AVFrame> frame_{av_frame_alloc()};
    std::int64_t coded_ = 0;               // samples sent to the encoder
    std::int64_t first_ = AV_NOPTS_VALUE;  // of the first decoded sample; < 0: encoder's delay
    std::vector<float> decoded_;
};

// Opens both; the decoder takes its parameters from the encoder, as no container carries them.
Expected<void> RoundTrip::open(LossyCodec codec, int rate, int bits_per_second) {
    const bool is_mp3 = codec == LossyCodec::mp3;
    const std::string name(kLossyCodecNames[static_cast<std::size_t>(codec)]);
    const AVCodec* encoder = avcodec_find_encoder_by_name(is_mp3 ? "libmp3lame" : "libopus");
    const AVCodec* decoder = avcodec_find_decoder(is_mp3 ? AV_CODEC_ID_MP3 : AV_CODEC_ID_OPUS);
    if (encoder == nullptr || decoder == nullptr) {
        return fail(fmt::format("FFmpeg here cannot encode {}; install one that can", name));
    }
    encoder_.reset(avcodec_alloc_context3(encoder));
    encoder_->sample_rate = rate;
    encoder_->sample_fmt = is_mp3 ? AV_SAMPLE_FMT_FLTP : AV_SAMPLE_FMT_FLT;
    encoder_->ch_layout = AV_CHANNEL_LAYOUT_MONO;
    encoder_->bit_rate = bits_per_second;
    encoder_->time_base = {1, rate};
    encoder_->thread_count = 1;
    if (avcodec_open2(encoder_.get(), encoder, nullptr) < 0 || encoder_->frame_size <= 0) {
        return fail(fmt::format("{} cannot be coded with {} bit/s", name, bits_per_second));
    }
    decoder_.reset(avcodec_alloc_context3(decoder));
    AVCodecParameters* parameters = avcodec_parameters_alloc();
    const bool is_ready = avcodec_parameters_from_context(parameters, encoder_.get()) >= 0 &&
                          avcodec_parameters_to_context(decoder_.get(), parameters) >= 0;
    avcodec_parameters_free(&parameters);
    decoder_->thread_count = 1;
    decoder_->pkt_timebase = encoder_->time_base;
    if (!is_ready || avcodec_open2(decoder_.get(), decoder, nullptr) < 0) {
        return fail(name + " cannot be decoded");
    }
    return {};
}

void RoundTrip::take_frames() {
    while (avcodec_receive_frame(decoder_.get(), frame_.get()) == 0) {
        // Mono: planar and interleaved samples are stored alike.
        const auto* samples = reinterpret_cast<const float*>(frame_->extended_data[0]);
        first_ = first_ == AV_NOPTS_VALUE ? frame_->best_effort_timestamp : first_;
        if (frame_->format == AV_SAMPLE_FMT_FLTP || frame_->format == AV_SAMPLE_FMT_FLT) {
            decoded_.insert(decoded_.end(), samples, samples + frame_->nb_samples);
        }
        av_frame_unref(frame_.get());
    }
}

// Decodes all packets that the encoder has ready.
Expected<void> RoundTrip::pass_packets() {
    while (avcodec_receive_packet(encoder_.get(), packet_.get()) == 0) {
        const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
        av_packet_unref(packet_.get());
        if (sent < 0) {
            return fail("FFmpeg's codec cannot decode what it encoded");
        }
        take_frames();
    }
    return {};
}

// Codes one frame of `count` samples; a frame that is not full is filled up with silence.
Expected<void> RoundTrip::encode(const float* samples, int count) {
    frame_->nb_samples = encoder_->frame_size;
    frame_->format = encoder_->sample_fmt;
    frame_->sample_rate = encoder_->sample_rate;
    frame_->ch_layout = AV_CHANNEL_LAYOUT_MONO;
    frame_->pts = coded_;
    if (av_frame_get_buffer(frame_.get(), 0) < 0) {
        return fail("out of memory");
    }
    auto* out = reinterpret_cast<float*>(frame_->extended_data[0]);
    std::copy_n(samples, count, out);
    std::fill_n(out + count, encoder_->frame_size - count, 0.0F);
    const int sent = avcodec_send_frame(encoder_.get(), frame_.get());
    av_frame_unref(frame_.get());
    coded_ += encoder_->frame_size;
    return sent < 0 ? Expected<void>(fail("FFmpeg's codec does not take the samples"))
                    : pass_packets();
}

// Codes and decodes the samples. Silence follows them until the encoder's delay has passed, so that
// the last samples come out, too.
Expected<std::vector<float>> RoundTrip::run(const std::vector<float>& samples) {
    const auto frame = static_cast<std::size_t>(encoder_->frame_size);
    const auto padding = static_cast<std::size_t>(std::max(encoder_->initial_padding, 0));
    const std::size_t all = samples.size() + padding + 2 * frame;
    for (std::size_t at = 0; at < all; at += frame) {
        const std::size_t begin = std::min(at, samples.size());
        const std::size_t count = std::min(frame, samples.size() - begin);
        if (auto done = encode(samples.data() + begin, static_cast<int>(count)); !done) {
            return fail(done.error());
        }
    }
    avcodec_send_frame(encoder_.get(), nullptr);
    if (auto done = pass_packets(); !done) {
        return fail(done.error());
    }
    avcodec_send_packet(decoder_.get(), nullptr);
    take_frames();
    // Some decoders drop the encoder's padding at the start, some do not: where the first decoded
    // sample has a negative time, so many samples are padding.
    const auto lead =
        first_ == AV_NOPTS_VALUE ? 0 : static_cast<std::size_t>(std::max<std::int64_t>(-first_, 0));
    decoded_.erase(decoded_.begin(),
                   decoded_.begin() + static_cast<std::ptrdiff_t>(std::min(lead, decoded_.size())));
    return std::move(decoded_);
}

}  // namespace

Expected<void> pass_lossy_codec(LossyCodec codec,
                                int rate,
                                int bits_per_second,
                                std::vector<float>& samples) {
    av_log_set_level(AV_LOG_QUIET);  // what is wrong comes back as an error
    const int inside = coded_rate(codec, bits_per_second);
    for (float& sample : samples) {
        // As a file of integers would store it; LAME ends the program on a NaN.
        sample = std::isfinite(sample) ? std::clamp(sample, -1.0F, 1.0F) : 0.0F;
    }
    RoundTrip trip;
    if (auto opened = trip.open(codec, inside, bits_per_second); !opened) {
        return opened;
    }
    auto decoded = trip.run(at_rate(rate, inside, samples));
    if (!decoded) {
        return fail(decoded.error());
    }
    std::vector<float> result = at_rate(inside, rate, std::move(*decoded));
    // The padding behind the samples goes; a shorter result is filled up with silence.
    result.resize(samples.size());
    samples = std::move(result);
    return {};
}

}  // namespace raks::audio
