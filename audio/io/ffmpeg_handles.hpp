#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>
}

namespace raks::audio {

/// Deleter of FFmpeg's objects: each kind is freed by its own function.
struct FfmpegCloser {
    /// A container that was opened for reading.
    void operator()(AVFormatContext* context) const noexcept { avformat_close_input(&context); }
    /// Functions through which a container is read.
    void operator()(AVIOContext* context) const noexcept {
        av_freep(&context->buffer);
        avio_context_free(&context);
    }
    /// An encoder or decoder.
    void operator()(AVCodecContext* context) const noexcept { avcodec_free_context(&context); }
    /// A packet and its reference to data.
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
    /// A frame and its reference to data.
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
    /// A resampler.
    void operator()(SwrContext* context) const noexcept { swr_free(&context); }
};
/// Owner of an FFmpeg object.
template <typename T>
using FfmpegHandle = std::unique_ptr<T, FfmpegCloser>;

}  // namespace raks::audio
