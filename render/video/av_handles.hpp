#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>

/// Owners of FFmpeg's objects.
namespace raks::render {

struct FreeCodec {
    void operator()(AVCodecContext* codec) const noexcept { avcodec_free_context(&codec); }
};
struct FreeFrame {
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
};
struct FreePacket {
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
};
struct FreeScaler {
    void operator()(SwsContext* scaler) const noexcept { sws_freeContext(scaler); }
};
struct FreeMuxer {
    void operator()(AVFormatContext* muxer) const noexcept {
        avio_closep(&muxer->pb);
        avformat_free_context(muxer);
    }
};
using CodecHandle = std::unique_ptr<AVCodecContext, FreeCodec>;
using FrameHandle = std::unique_ptr<AVFrame, FreeFrame>;
using PacketHandle = std::unique_ptr<AVPacket, FreePacket>;
using ScalerHandle = std::unique_ptr<SwsContext, FreeScaler>;
using MuxerHandle = std::unique_ptr<AVFormatContext, FreeMuxer>;

/// FFmpeg's number for what went wrong, in words.
[[nodiscard]] inline std::string av_reason(int error) {
    char text[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(error, text, sizeof text);
    return text;
}

/// The same number of threads everywhere: x264 writes it into the file, and the pictures of other
/// numbers differ.
inline constexpr int kEncoderThreads = 2;

}  // namespace raks::render
