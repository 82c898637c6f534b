#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>

/// Owners of FFmpeg's objects: each is freed by the function that FFmpeg has for it.
namespace raks::render {

/// Frees an encoder.
struct FreeCodec {
    void operator()(AVCodecContext* codec) const noexcept { avcodec_free_context(&codec); }
};
/// Frees a picture or a piece of sound.
struct FreeFrame {
    void operator()(AVFrame* frame) const noexcept { av_frame_free(&frame); }
};
/// Frees encoded data.
struct FreePacket {
    void operator()(AVPacket* packet) const noexcept { av_packet_free(&packet); }
};
/// Frees a colour converter.
struct FreeScaler {
    void operator()(SwsContext* scaler) const noexcept { sws_freeContext(scaler); }
};
/// Closes the file and frees the container's writer.
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

/// Threads of an encoder. A fixed number, so that the same input gives the same file on every
/// machine: x264 writes the number into the file, and its pictures depend on it.
inline constexpr int kEncoderThreads = 2;

}  // namespace raks::render
