#include "render/video/film_encoders.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

extern "C" {
#include <libavutil/opt.h>
}

namespace raks::render {
namespace {

// Settings of one VideoQuality, as in the table of video_writer.hpp.
struct QualityRow {
    const char* x264_preset;
    int x264_crf;
    int vp9_speed;
    int vp9_crf;
    int jpeg_scale;
    int prores_bits;  // a macroblock, at most
};

/// `normal` stands for anything else, too.
QualityRow row_of(VideoQuality quality) {
    switch (quality) {
        case VideoQuality::draft:
            return {"ultrafast", 23, 8, 38, 6, 1000};
        case VideoQuality::high:
            return {"medium", 17, 4, 26, 2, 4000};
        case VideoQuality::normal:
            break;
    }
    return {"veryfast", 20, 6, 33, 3, 2000};
}

/// BT.709 in limited range with 4:2:0 colour: what players assume of a film of this size.
void set_bt709(AVCodecContext& codec) {
    codec.pix_fmt = AV_PIX_FMT_YUV420P;
    codec.color_range = AVCOL_RANGE_MPEG;
    codec.colorspace = AVCOL_SPC_BT709;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_BT709;
    // A key frame at least every second: that far a player may have to seek back, and so much may
    // be lost of a film whose writer is killed.
    codec.gop_size = std::max(1, static_cast<int>(std::lround(av_q2d(codec.framerate))));
}

void set_h264(AVCodecContext& codec, const QualityRow& row) {
    set_bt709(codec);
    av_opt_set(codec.priv_data, "preset", row.x264_preset, 0);
    av_opt_set_double(codec.priv_data, "crf", row.x264_crf, 0);
    // x264 164 otherwise looks ahead in a thread of its own, which counts down the references to a
    // picture, without a lock, while the encoder does: seldom both write the same count, and the
    // picture is never freed. Looking ahead within the call gives the same bytes.
    av_opt_set(codec.priv_data, "x264-params", "sync-lookahead=0", 0);
}

/// Constant quality: the bit rate 0 tells the encoder that only the quality counts.
void set_vp9(AVCodecContext& codec, const QualityRow& row) {
    set_bt709(codec);
    codec.bit_rate = 0;
    av_opt_set_int(codec.priv_data, "crf", row.vp9_crf, 0);
    av_opt_set(codec.priv_data, "deadline", "good", 0);
    av_opt_set_int(codec.priv_data, "cpu-used", row.vp9_speed, 0);
    // Two columns for two threads.
    av_opt_set_int(codec.priv_data, "tile-columns", 1, 0);
}

/// Alpha is a film of its own beside the colours; frames that are never shown would part the two.
void set_vp9_with_alpha(AVCodecContext& codec, const QualityRow& row) {
    set_vp9(codec, row);
    codec.pix_fmt = AV_PIX_FMT_YUVA420P;
    av_opt_set_int(codec.priv_data, "auto-alt-ref", 0, 0);
}

void set_prores(AVCodecContext& codec, const QualityRow& row) {
    set_bt709(codec);
    codec.pix_fmt = AV_PIX_FMT_YUVA444P10;
    av_opt_set(codec.priv_data, "profile", "4444", 0);
    av_opt_set_int(codec.priv_data, "alpha_bits", 16, 0);
    av_opt_set_int(codec.priv_data, "bits_per_mb", row.prores_bits, 0);
    // Some editors refuse what does not bear this mark.
    av_opt_set(codec.priv_data, "vendor", "apl0", 0);
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
    ScalerHandle scaler(sws_alloc_context());
    if (!scaler) {
        return nullptr;
    }
    const bool is_full = codec.color_range == AVCOL_RANGE_JPEG;
    const auto set = [&scaler](const char* name, int value) {
        av_opt_set_int(scaler.get(), name, value, 0);
    };
    set("srcw", codec.width);
    set("srch", codec.height);
    set("src_format", AV_PIX_FMT_RGBA);
    set("dstw", codec.width);
    set("dsth", codec.height);
    set("dst_format", codec.pix_fmt);
    set("sws_flags", SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT);
    // Halved colour lies between two pixels in JPEG, on the left one in films (1/256 of a pixel):
    // readers take it so, and what is coloured would be half a pixel beside itself.
    set("dst_h_chr_pos", is_full ? 128 : 0);
    set("dst_v_chr_pos", 128);
    constexpr int kUnity = 1 << 16;
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
    return sws_init_context(scaler.get(), nullptr, nullptr) < 0 ? nullptr : std::move(scaler);
}

/// The encoder of a form: FFmpeg's name, how it is set up, and what to do without it.
struct PictureCodec {
    const char* name;
    void (*set)(AVCodecContext&, const QualityRow&);
    const char* instead;
};

const PictureCodec& codec_of(FilmForm form, bool has_alpha) {
    static constexpr PictureCodec kH264{"libx264", set_h264, "write an .avi instead"};
    static constexpr PictureCodec kVp9{"libvpx-vp9", set_vp9, "write an .avi instead"};
    static constexpr PictureCodec kVp9WithAlpha{
        "libvpx-vp9", set_vp9_with_alpha, "name a folder to get numbered .png pictures"};
    static constexpr PictureCodec kProRes{
        "prores_ks", set_prores, "name a folder to get numbered .png pictures"};
    static constexpr PictureCodec kJpeg{
        "mjpeg", set_jpeg, "name a folder to get numbered .png pictures"};
    switch (form) {
        case FilmForm::webm:
            return has_alpha ? kVp9WithAlpha : kVp9;
        case FilmForm::mov:
            return kProRes;
        case FilmForm::avi:
            return kJpeg;
        case FilmForm::mp4:
        case FilmForm::mkv:
            break;
    }
    return kH264;
}

}  // namespace

Expected<PictureEncoder> PictureEncoder::create(FilmForm form,
                                                const VideoOptions& options,
                                                int muxer_flags) {
    const PictureCodec& choice = codec_of(form, options.has_alpha);
    const AVCodec* const kind = avcodec_find_encoder_by_name(choice.name);
    if (kind == nullptr) {
        return fail(std::string("this FFmpeg has no encoder ") + choice.name + "; " +
                    choice.instead);
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
    choice.set(codec, row_of(options.quality));
    if (options.is_live) {
        // x264 holds nothing back; others do not know it.
        av_opt_set(codec.priv_data, "tune", "zerolatency", 0);
    }
    if (const int error = avcodec_open2(&codec, kind, nullptr); error < 0) {
        return fail(std::string(kind->name) + " does not start: " + av_reason(error));
    }
    if (options.has_alpha) {
        encoder.edges_.emplace(options.width, options.height);
    }
    encoder.scaler_ = make_scaler(codec);
    if (!encoder.scaler_) {
        return fail("no conversion from RGBA to the codec's colours");
    }
    return encoder;
}

Expected<FrameHandle> PictureEncoder::convert(std::span<const std::uint8_t> rgba,
                                              std::int64_t number) {
    if (edges_) {
        straight_.assign(rgba.begin(), rgba.end());
        edges_->make_straight(straight_);
        rgba = straight_;
    }
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

}  // namespace raks::render
