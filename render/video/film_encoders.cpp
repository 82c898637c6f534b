#include "render/video/film_encoders.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
}

namespace raks::render {
namespace {

// Settings of one VideoQuality, as in the table of video_writer.hpp.
struct QualityRow {
    const char* x264_preset;
    int x264_crf;
    int jpeg_scale;
};

/// `normal` stands for anything else, too.
QualityRow row_of(VideoQuality quality) {
    switch (quality) {
        case VideoQuality::draft:
            return {"ultrafast", 23, 6};
        case VideoQuality::high:
            return {"medium", 17, 2};
        case VideoQuality::normal:
            break;
    }
    return {"veryfast", 20, 3};
}

/// BT.709 in limited range with 4:2:0 colour: what players assume of a film of this size.
void set_h264(AVCodecContext& codec, const QualityRow& row) {
    codec.pix_fmt = AV_PIX_FMT_YUV420P;
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.colorspace = AVCOL_SPC_BT709;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
    // A key frame at least every two seconds: that far a player may have to seek back.
    codec.gop_size = std::max(1, static_cast<int>(std::lround(2.0 * av_q2d(codec.framerate))));
    av_opt_set(codec.priv_data, "preset", row.x264_preset, 0);
    av_opt_set_double(codec.priv_data, "crf", row.x264_crf, 0);
}

/// Readers take JPEG for what JFIF says: BT.601, full range.
void set_jpeg(AVCodecContext& codec, const QualityRow& row) {
    codec.pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec.color_range = AVCOL_RANGE_JPEG;
    codec.colorspace = AVCOL_SPC_BT470BG;
    codec.flags |= AV_CODEC_FLAG_QSCALE;
    codec.global_quality = FF_QP2LAMBDA * row.jpeg_scale;
}

/// Converts RGBA to the encoder's format with its own colour matrix and range; swscale alone would
/// assume BT.601 for everything. Null on failure.
ScalerHandle make_scaler(const AVCodecContext& codec) {
    ScalerHandle scaler(sws_getContext(codec.width,
                                       codec.height,
                                       AV_PIX_FMT_RGBA,
                                       codec.width,
                                       codec.height,
                                       codec.pix_fmt,
                                       SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT,
                                       nullptr,
                                       nullptr,
                                       nullptr));
    if (scaler) {
        constexpr int kUnity = 1 << 16;
        const bool is_full = codec.color_range == AVCOL_RANGE_JPEG;
        const int* const from_rgb = sws_getCoefficients(is_full ? SWS_CS_ITU601 : SWS_CS_ITU709);
        // Source: full range RGB. Destination: the matrix above, full range for JPEG alone.
        sws_setColorspaceDetails(scaler.get(),
                                 sws_getCoefficients(SWS_CS_DEFAULT),
                                 1,
                                 from_rgb,
                                 is_full ? 1 : 0,
                                 0,
                                 kUnity,
                                 kUnity);
    }
    return scaler;
}

}  // namespace

Expected<PictureEncoder> PictureEncoder::create(FilmForm form,
                                                const VideoOptions& options,
                                                int muxer_flags) {
    const bool is_h264 = form == FilmForm::mp4;
    const AVCodec* const kind =
        is_h264 ? avcodec_find_encoder_by_name("libx264") : avcodec_find_encoder(AV_CODEC_ID_MJPEG);
    if (kind == nullptr) {
        return fail(is_h264 ? "this FFmpeg has no H.264 encoder (libx264); write an .avi instead"
                            : "this FFmpeg has no Motion JPEG encoder; name a folder to get "
                              "numbered .png pictures");
    }
    PictureEncoder encoder;
    encoder.codec_.reset(avcodec_alloc_context3(kind));
    if (!encoder.codec_) {
        return fail("out of memory");
    }
    AVCodecContext& codec = *encoder.codec_;
    codec.width = options.width;
    codec.height = options.height;
    // One picture lasts one unit of time.
    codec.time_base = {options.rate.denominator, options.rate.numerator};
    codec.framerate = {options.rate.numerator, options.rate.denominator};
    codec.sample_aspect_ratio = {1, 1};
    codec.thread_count = kEncoderThreads;
    // No library version in the stream.
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
    if ((muxer_flags & AVFMT_GLOBALHEADER) != 0) {
        codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    (is_h264 ? set_h264 : set_jpeg)(codec, row_of(options.quality));
    if (const int error = avcodec_open2(&codec, kind, nullptr); error < 0) {
        return fail(std::string(kind->name) + " does not start: " + av_reason(error));
    }
    encoder.scaler_ = make_scaler(codec);
    if (!encoder.scaler_) {
        return fail("no conversion from RGBA to the codec's colours");
    }
    return encoder;
}

Expected<FrameHandle> PictureEncoder::convert(std::span<const std::uint8_t> rgba,
                                              std::int64_t number) const {
    // A fresh frame each time: the encoder keeps the last ones while it looks ahead.
    FrameHandle frame(av_frame_alloc());
    if (!frame) {
        return fail("out of memory");
    }
    frame->format = codec_->pix_fmt;
    frame->width = codec_->width;
    frame->height = codec_->height;
    frame->color_range = codec_->color_range;
    frame->colorspace = codec_->colorspace;
    frame->pts = number;
    frame->quality = codec_->global_quality;
    if (av_frame_get_buffer(frame.get(), 0) < 0) {
        return fail("out of memory");
    }
    const std::uint8_t* const rows[] = {rgba.data()};
    const int strides[] = {codec_->width * 4};
    sws_scale(scaler_.get(), rows, strides, 0, codec_->height, frame->data, frame->linesize);
    return frame;
}

namespace {

// PCM has no frame size of its own: any will do.
constexpr std::int64_t kPcmFrameSize = 1024;
constexpr std::int64_t kAacBitsPerChannel = 80'000;

/// "8000, 11025, ...": rising, for the error line.
std::string rates_of(const AVCodec& kind) {
    std::vector<int> rates;
    for (const int* rate = kind.supported_samplerates; *rate != 0; ++rate) {
        rates.push_back(*rate);
    }
    std::sort(rates.begin(), rates.end());
    std::string text;
    for (const int rate : rates) {
        text += (text.empty() ? "" : ", ") + std::to_string(rate);
    }
    return text;
}

/// An encoder without a list takes every rate.
bool is_rate_known(const AVCodec& kind, int rate) {
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

/// Interleaved 16 bit: PCM's form.
void fill_packed(AVFrame& frame, const float* from, std::size_t channels) {
    auto* const to = reinterpret_cast<std::int16_t*>(frame.data[0]);
    const std::size_t count = static_cast<std::size_t>(frame.nb_samples) * channels;
    for (std::size_t i = 0; i < count; ++i) {
        to[i] = static_cast<std::int16_t>(std::lrint(clean(from[i]) * 32767.0F));
    }
}

}  // namespace

Expected<SoundEncoder> SoundEncoder::create(FilmForm form,
                                            const VideoOptions& options,
                                            int muxer_flags) {
    const bool is_aac = form == FilmForm::mp4;
    const AVCodec* const kind =
        avcodec_find_encoder(is_aac ? AV_CODEC_ID_AAC : AV_CODEC_ID_PCM_S16LE);
    if (kind == nullptr) {
        return fail(is_aac ? "this FFmpeg has no AAC encoder; write an .avi instead"
                           : "this FFmpeg has no PCM encoder");
    }
    if (!is_rate_known(*kind, options.audio_rate)) {
        return fail("sound of " + std::to_string(options.audio_rate) +
                    " Hz does not fit AAC; its rates are " + rates_of(*kind));
    }
    SoundEncoder encoder;
    encoder.codec_.reset(avcodec_alloc_context3(kind));
    if (!encoder.codec_) {
        return fail("out of memory");
    }
    AVCodecContext& codec = *encoder.codec_;
    codec.sample_fmt = is_aac ? AV_SAMPLE_FMT_FLTP : AV_SAMPLE_FMT_S16;
    codec.sample_rate = options.audio_rate;
    av_channel_layout_default(&codec.ch_layout, options.audio_channels);
    // The rate of PCM follows from its samples.
    codec.bit_rate = is_aac ? kAacBitsPerChannel * options.audio_channels : 0;
    // One audio frame lasts one unit of time.
    codec.time_base = {1, options.audio_rate};
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
    samples_.insert(samples_.end(), interleaved.begin(), interleaved.end());
}

void SoundEncoder::set_length(std::int64_t audio_frames) {
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
    const bool is_planar = codec_->sample_fmt == AV_SAMPLE_FMT_FLTP;
    (is_planar ? fill_planar : fill_packed)(*frame, samples_.data() + first_, channels);
    first_ += static_cast<std::size_t>(audio_frames) * channels;
    position_ += audio_frames;
    return frame;
}

}  // namespace raks::render
