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

/// Properties of an audio file, as its head and first frames give them.
struct AudioFileInfo {
    SampleRate rate{48'000};  ///< a supported one
    int channels = 2;         ///< 1..kMaxFileChannels
    /// Length that the file claims, in seconds; often wrong (truncated file, no header). Fit for a
    /// progress bar, never for the size of a buffer or as the end. Empty when it claims none.
    std::optional<double> claimed_seconds{};
    std::string format{};  ///< for display: "WAV", "MP3", "aac in mov,mp4"
};

inline constexpr int kMaxFileChannels = 64;  ///< of a file that is opened

/// Decodes one audio file, or the first sound track of a video, as a stream: memory is bounded for
/// any length. The format is found by content, never by name. Samples are passed on as the file has
/// them, NaN and values beyond [-1, 1] included.
/// Threads: one at a time. Real-time: no.
class AudioFileReader {
 public:
    /// Closes the file.
    virtual ~AudioFileReader() = default;

    /// Rate, channels and format; constant while the reader lives.
    [[nodiscard]] const AudioFileInfo& info() const noexcept { return info_; }

    /// Decodes the next frames into `interleaved` (whole frames of info().channels); returns how
    /// many frames, 0 at the end. Of a damaged file it gives what can be decoded: see warning().
    [[nodiscard]] virtual std::size_t read(std::span<float> interleaved) = 0;

    /// Continues at this frame (>= 0), to the sample, in every format; beyond the end read()
    /// returns 0. Errors: the file cannot be sought.
    [[nodiscard]] virtual Expected<void> seek(std::int64_t frame) = 0;

    /// What is wrong with a file that plays nevertheless, such as "x.mp3: is damaged or cut off at
    /// 12.3 s"; empty when nothing is. Complete at the end of the file only.
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

/// A whole file as mono at its own rate: the average of the left and right channel; more than two
/// channels are mixed down first (downmix.hpp).
struct MonoAudio {
    SampleRate rate{48'000};     ///< of the file
    std::vector<float> samples;  ///< one a frame
    std::string warning;         ///< as AudioFileReader::warning()
};

/// Reads and decodes a whole file. Errors: as open_audio_file; a file longer than `max_seconds` (it
/// is refused, not cut).
[[nodiscard]] Expected<MonoAudio> read_all_mono(const std::filesystem::path& path,
                                                double max_seconds = 3600.0);

/// Writes 16-bit WAV (interleaved, [-1, 1], clamped), complete or not at all.
/// Errors: the folder does not exist, a full disk, more than 4 GiB.
[[nodiscard]] Expected<void> write_wav(const std::filesystem::path& path,
                                       std::span<const float> interleaved,
                                       int channels,
                                       SampleRate rate);

}  // namespace raks::audio
