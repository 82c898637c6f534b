#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Size and rate of the pictures that an output gets.
struct VideoFormat {
    int width = 1280;                   ///< pixels
    int height = 720;                   ///< pixels
    std::int64_t rate_numerator = 30;   ///< pictures ..
    std::int64_t rate_denominator = 1;  ///< .. in so many seconds

    /// Bytes of a picture as it is drawn: RGBA.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    }
    /// When picture `number` is due after the first one, exact.
    [[nodiscard]] Nanos time_of(std::int64_t number) const noexcept {
        return Nanos(number * rate_denominator * 1'000'000'000 / rate_numerator);
    }
};

/// How a pipe has the pictures.
enum class PixelForm : std::uint8_t {
    rgba,  ///< as drawn: 8 bits each, premultiplied alpha, nothing between pictures
    y4m,   ///< YUV4MPEG2: BT.601, limited range, colour for each pixel (C444), no alpha
};

/// One place outside of the program where pictures go. It owns a descriptor or a stream and its
/// counters. What cannot be sent at once is dropped and counted; nothing waits for a reader.
///
/// Threads: the constructor on main, counters from any, all else on the sender's thread alone.
class VideoSink {
 public:
    VideoSink() = default;
    virtual ~VideoSink() = default;                   ///< closes it
    VideoSink(const VideoSink&) = delete;             ///< owns a descriptor
    VideoSink& operator=(const VideoSink&) = delete;  ///< likewise

    /// The picture that is due now: VideoFormat::bytes() of RGBA, premultiplied, top row first.
    virtual void send(std::span<const std::uint8_t> rgba) = 0;
    /// A line for the person about what has changed since the last call: it failed, it is back.
    [[nodiscard]] virtual std::optional<std::string> take_trouble() { return std::nullopt; }

    /// Pictures that were sent.
    [[nodiscard]] std::uint64_t sent() const noexcept { return sent_.load(); }
    /// Pictures that a reader was too slow for.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 protected:
    void count_sent() noexcept { ++sent_; }        ///< one picture
    void count_dropped() noexcept { ++dropped_; }  ///< one picture

 private:
    std::atomic<std::uint64_t> sent_{0};
    std::atomic<std::uint64_t> dropped_{0};
};

/// What a person asks for with `--video-out`.
struct VideoWish {
    std::string target;                ///< "-", a pipe with a name, "pipewire" or "pipewire:NAME"
    PixelForm form = PixelForm::rgba;  ///< of a pipe
    [[nodiscard]] bool is_stdout() const noexcept { return target == "-"; }  ///< its reader
};

/// Opens what is asked for. Errors: a target that is neither of the above; a pipe that cannot be
/// opened; Raks was built without PipeWire. That nobody reads yet, and that no PipeWire runs yet,
/// is no error.
[[nodiscard]] Expected<std::unique_ptr<VideoSink>> open_video_sink(const VideoWish& wish,
                                                                   const VideoFormat& format);

}  // namespace raks::engine
