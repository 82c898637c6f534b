#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "audio/io/container_extent.hpp"
#include "audio/io/ffmpeg_handles.hpp"
#include "audio/io/file_window.hpp"
#include "base/expected.hpp"
#include "engine/decode/orientation.hpp"
#include "engine/decode/picture_converter.hpp"

namespace raks::engine {

inline constexpr int kMostFilmPixels = 8192;  ///< of a picture's width and height

/// What a film says of itself, its pictures as they are to be seen.
struct DecodedFilm {
    int width = 0;                     ///< pixels, 1 to kMostFilmPixels
    int height = 0;                    ///< likewise
    int turned = 0;                    ///< degrees clockwise that its metadata asks for
    double pictures_per_second = 0.0;  ///< on average, as claimed; 0: unknown
    double claimed_seconds = -1.0;     ///< < 0: unknown
    double recorded = 0.0;             ///< its date, seconds since 1970; 0: unknown
    std::string format{};              ///< "h264 in mov,mp4,..."
};

/// A picture as it is to be seen; its pixels are valid until the next one.
struct DecodedFilmPicture {
    double seconds = 0.0;  ///< later than the one before
    int width = 0;
    int height = 0;
    std::span<const std::uint8_t> rgb;  ///< width x height x 3, top row first
};

/// Decodes the pictures of a film, or a single PNG or JPEG picture, by FFmpeg, in one thread. Time
/// begins where that of the film's sound does (audio/io): with what comes first of sound and
/// picture. Each picture has the time stamp of the file, not its number divided by a rate.
/// For raks-decode and tests. Threads: one. Real-time: no.
class FilmDecoder {
 public:
    /// `name` is for messages alone. Errors: empty; not a film; without a track of pictures; coded
    /// in a way that is not on the list; too large; cut off before its index.
    [[nodiscard]] static Expected<std::unique_ptr<FilmDecoder>> open(
        const std::string& name, const audio::FileWindow& window);

    [[nodiscard]] const DecodedFilm& info() const noexcept { return info_; }
    /// The next picture; none at the end. Errors: pixels that cannot be converted.
    [[nodiscard]] Expected<std::optional<DecodedFilmPicture>> next();
    /// "NAME: is cut off ...", one line; empty where all is well. Complete at the end only.
    [[nodiscard]] std::string warning() const;

 private:
    FilmDecoder(std::string name, const audio::FileWindow& window)
        : name_(std::move(name)), cursor_{window} {}
    [[nodiscard]] Expected<void> open_container();
    [[nodiscard]] Expected<void> choose_track();
    [[nodiscard]] Expected<void> open_decoder();
    void describe();
    [[nodiscard]] double start_of_time() const;
    [[nodiscard]] bool feed();
    [[nodiscard]] bool receive();
    [[nodiscard]] bool place();
    void note_end();

    std::string name_;
    audio::WindowCursor cursor_;
    audio::ContainerExtent extent_;
    audio::FfmpegHandle<AVIOContext> window_;  // reads by cursor_; outlives container_
    audio::FfmpegHandle<AVFormatContext> container_;
    audio::FfmpegHandle<AVCodecContext> decoder_;
    audio::FfmpegHandle<AVPacket> packet_{av_packet_alloc()};
    audio::FfmpegHandle<AVFrame> frame_{av_frame_alloc()};
    const AVCodec* codec_ = nullptr;
    AVStream* track_ = nullptr;
    PictureConverter converter_;
    Orientation orientation_;
    DecodedFilm info_;
    double zero_ = 0.0;     // seconds of the file's clock at time 0
    double seconds_ = 0.0;  // of the newest picture
    bool has_picture_ = false;
    bool is_flushed_ = false;
    bool is_at_end_ = false;
    int stored_width_ = 0;  // of the first picture
    int stored_height_ = 0;
    int left_out_ = 0;  // their time stamps run back
    int damaged_ = 0;
    double first_damage_ = 0.0;
    std::string end_note_;
};

}  // namespace raks::engine
