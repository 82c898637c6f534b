#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/expected.hpp"

namespace raks::render {

/// Pictures per second as a fraction, so that no picture time is ever rounded: 30/1, 30000/1001.
struct FrameRate {
    /// Pictures, > 0.
    int numerator = 30;
    /// Seconds in which they are shown, > 0.
    int denominator = 1;

    /// The fraction that is meant by a decimal number: 29.97 is 30000/1001, 12.5 is 25/2.
    /// `fps` > 0; the result is exact to 0.001.
    [[nodiscard]] static FrameRate nearest(double fps) noexcept;
    /// Pictures a second.
    [[nodiscard]] double fps() const noexcept {
        return static_cast<double>(numerator) / denominator;
    }
};

/// What is traded against encoding time and file size.
///             .mp4, .mkv (x264)    .webm (VP9)        .avi (Motion JPEG)
///   draft     ultrafast, crf 23    speed 8, crf 38    qscale 6
///   normal    veryfast,  crf 20    speed 6, crf 33    qscale 3
///   high      medium,    crf 17    speed 4, crf 26    qscale 2
enum class VideoQuality : std::uint8_t { draft, normal, high };

/// Size, rate and quality of a film; `VideoWriter::create` refuses what is out of range.
struct VideoOptions {
    int width = 1280;  ///< pixels; 16 to 8192, even unless pictures are written as files
    int height = 720;  ///< pixels; as width
    FrameRate rate{};  ///< 1 to 240 pictures a second
    /// Of the pictures; PNG files are lossless.
    VideoQuality quality = VideoQuality::normal;
    /// Hz, 8,000 to 192,000; resampled to 48,000 where the form's codec does not have it.
    int audio_rate = 48'000;
    int audio_channels = 2;  ///< 0 (no sound track), 1 or 2
    /// The pictures have alpha and premultiplied colours, and the film keeps both, colours
    /// straight. Only in .mov, .webm and .png; without it a .mov cannot be written.
    bool has_alpha = false;
    /// Written while it is danced: each picture is on the disk within about a second. (.mp4, .mkv)
    bool is_live = false;
    std::string comment{};  ///< of the film, for who looks at its details; empty: none
};

/// Writes a film with sound. The extension chooses the form:
///
///   X.mp4   H.264 (BT.709, limited range, 4:2:0) and AAC 160 kb/s
///   X.mkv   the same pictures and Opus 128 kb/s, in Matroska
///   X.webm  VP9 (the same colours) and Opus
///   X.avi   Motion JPEG and 16 bit PCM: plays everywhere, needs no H.264 encoder
///   X.mov   with alpha: ProRes 4444 (10 bits, 16 of alpha) and 16 bit PCM, for editors
///   X, X/   a folder of pictures 000001.png, 000002.png, ...; sound is accepted and dropped
///
/// Picture k is shown from k / rate on and sample n is played at n / audio_rate; the encoders' own
/// delay is taken off in the file. Sound may be added ahead of the pictures (it waits in memory
/// until they reach it) or behind them. The sound track ends exactly with the last picture: it is
/// cut, or filled with silence.
///
/// The same input gives the same bytes (fixed thread count, no dates, no library versions).
/// Everything goes to NAME.XXXXXX.part first, which gets its name in finish(): a film that is not
/// finished leaves nothing behind, and what had the name stays until then. A program that is told
/// to stop calls finish_stopped() and keeps what was added beside that. One that is killed leaves
/// the part, which plays up to about two seconds before the end: an .mp4 is written in fragments
/// and made a plain one at the end (which takes its size on the disk once more); the other forms
/// are flushed every second. A program also ignores SIGXFSZ, so that a file size limit arrives here
/// as an error.
///
///     auto film = VideoWriter::create("out.mp4", {.width = 1280, .height = 720});
///     (*film)->add_sound(samples);  (*film)->add_picture(rgba);  (*film)->finish();
///
/// Threads: one. Real-time: no.
class VideoWriter {
 public:
    /// Errors: an unknown extension (names the known ones), a size, rate or channel number that
    /// the form cannot hold, no such encoder in this FFmpeg, a path that cannot be written, a
    /// folder that already holds files.
    [[nodiscard]] static Expected<std::unique_ptr<VideoWriter>> create(
        const std::filesystem::path& path, const VideoOptions& options);

    /// The errors of create() that show without an encoder, before long work: nothing stays on the
    /// disk.
    [[nodiscard]] static Expected<void> check(const std::filesystem::path& path,
                                              const VideoOptions& options);

    /// Whether a film of that name can have alpha: VideoOptions::has_alpha.
    [[nodiscard]] static bool keeps_alpha(const std::filesystem::path& path);

    /// One file, one writer: not to be copied or moved.
    VideoWriter(const VideoWriter&) = delete;
    /// As the constructor.
    VideoWriter& operator=(const VideoWriter&) = delete;
    /// Removes the part unless finish() succeeded.
    virtual ~VideoWriter() = default;

    /// Adds one picture: width x height x 4 bytes RGBA, top row first. Without
    /// VideoOptions::has_alpha, alpha is not looked at (kept as it is in .png). Errors: a full disk
    /// and the like; nothing more can be added then.
    [[nodiscard]] virtual Expected<void> add_picture(std::span<const std::uint8_t> rgba) = 0;
    /// Adds interleaved samples, any number of whole audio frames, [-1, 1] (clipped; NaN is 0).
    [[nodiscard]] virtual Expected<void> add_sound(std::span<const float> interleaved) = 0;
    /// Completes the file and gives it its name. Needs at least one picture. Once.
    [[nodiscard]] virtual Expected<void> finish() = 0;
    /// As finish(), of a film that ends before it is complete: what has its name stays, and the
    /// film gets its stopped_name() (base/pending_file.hpp), which is returned.
    [[nodiscard]] virtual Expected<std::filesystem::path> finish_stopped() = 0;

 protected:
    VideoWriter() = default;
};

}  // namespace raks::render
