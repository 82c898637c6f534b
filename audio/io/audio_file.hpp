#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// What the head of an audio file says.
struct AudioFileInfo {
    SampleRate rate{48'000};  ///< a supported one
    int channels = 2;         ///< 1..kMaxFileChannels
    /// What the file claims, in seconds; often wrong (truncated or without a header): for a
    /// progress bar, never for the size of a buffer or for the end. Empty when it does not say.
    std::optional<double> claimed_seconds{};
    std::string format{};  ///< for people: "WAV", "MP3", "aac in mov,mp4"
};

inline constexpr int kMaxFileChannels = 64;

/// Decodes one audio file, or the first sound track of a video, as a stream: memory is bounded
/// for any length. The kind is found by content, never by name. Values are handed on as they are
/// in the file, NaN and beyond [-1, 1] included.
/// Threads: one at a time. Real-time: no.
class AudioFileReader {
 public:
    virtual ~AudioFileReader() = default;

    [[nodiscard]] const AudioFileInfo& info() const noexcept { return info_; }

    /// Decodes the next frames into `interleaved` (whole frames of info().channels); returns how
    /// many frames, 0 at the end. A damaged file plays what is there: see warning().
    [[nodiscard]] virtual std::size_t read(std::span<float> interleaved) = 0;

    /// Goes on at this frame (>= 0), exactly, in every format; behind the end, read() gives 0.
    /// Errors: the file cannot be sought.
    [[nodiscard]] virtual Expected<void> seek(std::int64_t frame) = 0;

    /// What is wrong with a file that still plays, e.g. "x.mp3: is damaged or cut off at 12.3 s";
    /// empty when nothing is.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

 protected:
    AudioFileInfo info_;
    std::string warning_;
};

/// Opens by libsndfile (WAV, AIFF, FLAC, Ogg Vorbis, Opus and its other formats) or FFmpeg (MP3,
/// M4A, AAC, WebM, WMA, the sound of videos). Errors, one line each: missing, empty, a folder, not
/// audio, no sound track, a rate outside 8-192 kHz (0 Hz too), too many channels.
[[nodiscard]] Expected<std::unique_ptr<AudioFileReader>> open_audio_file(
    const std::filesystem::path& path);

/// A whole file as mono (average of a stereo file's channels, downmix of more) at its own rate.
struct MonoAudio {
    SampleRate rate{48'000};
    std::vector<float> samples;
    std::string warning;  ///< as AudioFileReader::warning()
};

/// Errors: as open_audio_file, and a file longer than `max_seconds` (nothing is cut in silence).
[[nodiscard]] Expected<MonoAudio> read_all_mono(const std::filesystem::path& path,
                                                double max_seconds = 3600.0);

/// Writes 16-bit WAV (interleaved, [-1, 1], clamped), complete or not at all.
/// Errors: the folder does not exist, a full disk, more than 4 GiB.
[[nodiscard]] Expected<void> write_wav(const std::filesystem::path& path,
                                       std::span<const float> interleaved,
                                       int channels,
                                       SampleRate rate);

}  // namespace raks::audio
