#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>
}

namespace raks::audio {

/// Ends what FFmpeg made, each kind by its own function.
struct FfmpegCloser {
    void operator()(AVFormatContext* context) const noexcept { avformat_close_input(&context); }
    void operator()(AVCodecContext* context) const noexcept { avcodec_free_context(&context); }
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
    void operator()(SwrContext* context) const noexcept { swr_free(&context); }
};
template <typename T>
using FfmpegHandle = std::unique_ptr<T, FfmpegCloser>;

}  // namespace raks::audio
