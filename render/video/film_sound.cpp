#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "render/video/film_encoders.hpp"

extern "C" {
#include <libavutil/channel_layout.h>
}

namespace raks::render {
namespace {

// PCM has no frame size of its own: any will do.
constexpr std::int64_t kPcmFrameSize = 1024;
// Every codec here has it.
constexpr int kUsualRate = 48'000;

/// The encoder of a form's sound.
struct SoundCodec {
    const char* name;
    AVSampleFormat samples;
    std::int64_t bits_per_channel;  // a second; 0: as the samples make it
};

const SoundCodec& sound_codec_of(FilmForm form) {
    static constexpr SoundCodec kAac{"aac", AV_SAMPLE_FMT_FLTP, 80'000};
    static constexpr SoundCodec kOpus{"libopus", AV_SAMPLE_FMT_FLT, 64'000};
    static constexpr SoundCodec kPcm{"pcm_s16le", AV_SAMPLE_FMT_S16, 0};
    switch (form) {
        case FilmForm::webm:
        case FilmForm::mkv:  // Matroska cannot say how long an AAC encoder's delay is
            return kOpus;
        case FilmForm::avi:
        case FilmForm::mov:
            return kPcm;
        case FilmForm::mp4:
            break;
    }
    return kAac;
}

/// An encoder without a list takes every rate. Opus counts in 48 kHz whatever it is given, and its
/// containers say its delay so.
bool is_rate_known(const AVCodec& kind, int rate) {
    if (kind.id == AV_CODEC_ID_OPUS) {
        return rate == kUsualRate;
    }
    if (kind.supported_samplerates == nullptr) {
        return true;
    }
    for (const int* known = kind.supported_samplerates; *known != 0; ++known) {
        if (*known == rate) {
            return true;
        }
    }
    return false;
}

/// Encoders may not be given NaN or what is out of range.
float clean(float sample) { return std::isnan(sample) ? 0.0F : std::clamp(sample, -1.0F, 1.0F); }

/// One array a channel: AAC's form.
void fill_planar(AVFrame& frame, const float* from, std::size_t channels) {
    const auto count = static_cast<std::size_t>(frame.nb_samples);
    for (std::size_t c = 0; c < channels; ++c) {
        auto* const plane = reinterpret_cast<float*>(frame.extended_data[c]);
        for (std::size_t i = 0; i < count; ++i) {
            plane[i] = clean(from[i * channels + c]);
        }
    }
}

/// Interleaved, as they came: Opus's form.
void fill_interleaved(AVFrame& frame, const float* from, std::size_t channels) {
    auto* const to = reinterpret_cast<float*>(frame.data[0]);
    const std::size_t count = static_cast<std::size_t>(frame.nb_samples) * channels;
    std::transform(from, from + count, to, clean);
}

/// Interleaved 16 bit: PCM's form.
void fill_packed(AVFrame& frame, const float* from, std::size_t channels) {
    auto* const to = reinterpret_cast<std::int16_t*>(frame.data[0]);
    const std::size_t count = static_cast<std::size_t>(frame.nb_samples) * channels;
    for (std::size_t i = 0; i < count; ++i) {
        to[i] = static_cast<std::int16_t>(std::lrint(clean(from[i]) * 32767.0F));
    }
}

/// Interleaved samples of another rate to the codec's. Null on failure.
ResamplerHandle make_resampler(const AVCodecContext& codec, int from_rate) {
    SwrContext* context = nullptr;
    AVChannelLayout layout = codec.ch_layout;
    swr_alloc_set_opts2(&context,
                        &layout,
                        AV_SAMPLE_FMT_FLT,
                        codec.sample_rate,
                        &layout,
                        AV_SAMPLE_FMT_FLT,
                        from_rate,
                        0,
                        nullptr);
    ResamplerHandle resampler(context);
    return resampler && swr_init(resampler.get()) >= 0 ? std::move(resampler) : nullptr;
}

}  // namespace

Expected<SoundEncoder> SoundEncoder::create(FilmForm form,
                                            const VideoOptions& options,
                                            int muxer_flags) {
    const SoundCodec& choice = sound_codec_of(form);
    const AVCodec* const kind = avcodec_find_encoder_by_name(choice.name);
    if (kind == nullptr) {
        return fail(std::string("this FFmpeg has no encoder ") + choice.name +
                    "; write an .avi instead");
    }
    SoundEncoder encoder;
    encoder.codec_.reset(avcodec_alloc_context3(kind));
    if (!encoder.codec_) {
        return fail("out of memory");
    }
    AVCodecContext& codec = *encoder.codec_;
    codec.sample_fmt = choice.samples;
    codec.sample_rate = is_rate_known(*kind, options.audio_rate) ? options.audio_rate : kUsualRate;
    av_channel_layout_default(&codec.ch_layout, options.audio_channels);
    codec.bit_rate = choice.bits_per_channel * options.audio_channels;
    // One audio frame lasts one unit of time.
    codec.time_base = {1, codec.sample_rate};
    codec.thread_count = kEncoderThreads;
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
    if ((muxer_flags & AVFMT_GLOBALHEADER) != 0) {
        codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    if (const int error = avcodec_open2(&codec, kind, nullptr); error < 0) {
        return fail(std::string(kind->name) + " does not start: " + av_reason(error));
    }
    encoder.channels_ = options.audio_channels;
    encoder.frame_size_ = codec.frame_size > 0 ? codec.frame_size : kPcmFrameSize;
    if (codec.sample_rate != options.audio_rate) {
        encoder.resampler_ = make_resampler(codec, options.audio_rate);
        if (!encoder.resampler_) {
            return fail("no conversion from " + std::to_string(options.audio_rate) + " to " +
                        std::to_string(codec.sample_rate) + " Hz");
        }
    }
    return encoder;
}

/// Audio frames that wait.
std::int64_t SoundEncoder::kept() const noexcept {
    return static_cast<std::int64_t>(samples_.size() - first_) / channels_;
}

void SoundEncoder::add(std::span<const float> interleaved) {
    if (first_ > samples_.size() / 2) {  // so each sample moves about once
        samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first_));
        first_ = 0;
    }
    if (resampler_) {
        // What is no number would spoil all that the filter reaches.
        std::vector<float> cleaned(interleaved.size());
        std::transform(interleaved.begin(), interleaved.end(), cleaned.begin(), clean);
        resample(cleaned);
    } else {
        samples_.insert(samples_.end(), interleaved.begin(), interleaved.end());
    }
}

/// Appends what becomes of `interleaved` at the codec's rate; nothing more follows where it is
/// empty: then what the filter still holds is appended.
void SoundEncoder::resample(std::span<const float> interleaved) {
    const auto channels = static_cast<std::size_t>(channels_);
    const int frames = static_cast<int>(interleaved.size() / channels);
    const int room = std::max(0, swr_get_out_samples(resampler_.get(), frames));
    const std::size_t before = samples_.size();
    samples_.resize(before + static_cast<std::size_t>(room) * channels);
    const auto* from = reinterpret_cast<const std::uint8_t*>(interleaved.data());
    auto* to = reinterpret_cast<std::uint8_t*>(samples_.data() + before);
    const int made = swr_convert(resampler_.get(), &to, room, frames > 0 ? &from : nullptr, frames);
    samples_.resize(before + static_cast<std::size_t>(std::max(made, 0)) * channels);
}

void SoundEncoder::set_length(std::int64_t audio_frames) {
    if (resampler_) {
        resample({});
    }
    length_ = audio_frames;
    const std::int64_t left = std::max<std::int64_t>(0, audio_frames - position_);
    // Cuts what goes beyond the last picture, or appends silence.
    samples_.resize(first_ + static_cast<std::size_t>(left * channels_), 0.0F);
}

Expected<FrameHandle> SoundEncoder::next(std::int64_t until) {
    const std::int64_t ready = std::min(kept(), until - position_);
    if (ready >= frame_size_) {
        return take(frame_size_);
    }
    // Only the last frame may be shorter than the codec's size.
    return length_ >= 0 && ready > 0 ? take(ready) : FrameHandle();
}

/// Moves samples into a frame of the codec's format and advances both positions.
Expected<FrameHandle> SoundEncoder::take(std::int64_t audio_frames) {
    FrameHandle frame(av_frame_alloc());
    if (!frame) {
        return fail("out of memory");
    }
    frame->format = codec_->sample_fmt;
    frame->sample_rate = codec_->sample_rate;
    frame->nb_samples = static_cast<int>(audio_frames);
    // Time stamps count audio frames from the start; the encoder's own delay is the muxer's to take
    // off.
    frame->pts = position_;
    if (av_channel_layout_copy(&frame->ch_layout, &codec_->ch_layout) < 0 ||
        av_frame_get_buffer(frame.get(), 0) < 0) {
        return fail("out of memory");
    }
    const auto channels = static_cast<std::size_t>(channels_);
    const auto fill = codec_->sample_fmt == AV_SAMPLE_FMT_FLTP  ? fill_planar
                      : codec_->sample_fmt == AV_SAMPLE_FMT_FLT ? fill_interleaved
                                                                : fill_packed;
    fill(*frame, samples_.data() + first_, channels);
    first_ += static_cast<std::size_t>(audio_frames) * channels;
    position_ += audio_frames;
    return frame;
}

}  // namespace raks::render
