#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audio/io/audio_tags.hpp"
#include "audio/io/hearing.hpp"
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
    /// The same in frames, where the file counts them; empty for formats that tell a time only.
    std::optional<std::int64_t> claimed_frames{};
    std::string format{};  ///< for display: "WAV", "MP3", "aac in mov,mp4"
    Hearing hearing{};     ///< how the analyzer should hear it: hear_mono(), hear_stereo()
    AudioTags tags{};      ///< title, artist, album, genre, tempo, as the file says them
};

inline constexpr int kMaxFileChannels = 64;  ///< of a file that is opened

/// Decodes one audio file, or the first sound track of a video, as a stream: memory is bounded for
/// any length. The format is found by content, never by name. Samples are passed on as the file has
/// them, NaN and values beyond [-1, 1] included; info().hearing says what an analyzer should do
/// with them where they are far out of the usual.
///
/// The time line is the file's own: the sound of a film begins where the film has it, gaps between
/// time stamps are silent, streams that lie one behind the other follow each other, and what a
/// recorder appends after the file was opened is not read.
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

    /// What is wrong with a file that plays nevertheless, or out of the usual and was mended, in
    /// one line, such as "x.mp3: is damaged or cut off at 12.30 s; 3.40 s are missing"; empty when
    /// nothing is. Complete at the end of the file only.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

 protected:
    AudioFileInfo info_;
    std::string warning_;
};

/// Opens a file, which the program raks-decode reads and decodes (engine/decode): by libsndfile
/// (WAV, AIFF, FLAC, Ogg Vorbis, Opus and its other formats) or FFmpeg (MP3, M4A, AAC, WebM, WMA,
/// the sound of videos). Rates below 8 and above 192 kHz are resampled to the nearest whole
/// multiple or part within. Where that program dies or hangs the sound ends, and warning() says it.
/// Errors, one line each: missing, empty, a folder, not audio, no sound track, cut off before its
/// index, a rate outside 1 kHz to 3 MHz (0 Hz too), too many channels; raks-decode is not there,
/// broke off or hung.
/// `is_stopped` is asked every 50 ms while that program keeps one waiting, by whoever opens, reads
/// or seeks: once it is true, that fails, or the sound ends, at once and without a warning.
[[nodiscard]] Expected<std::unique_ptr<AudioFileReader>> open_audio_file(
    const std::filesystem::path& path, std::function<bool()> is_stopped = {});

/// A whole file as mono at its own rate: the average of the left and right channel; more than two
/// channels are mixed down first (downmix.hpp); then as its Hearing says.
struct MonoAudio {
    SampleRate rate{48'000};     ///< of the file
    std::vector<float> samples;  ///< one a frame
    std::string warning;         ///< as AudioFileReader::warning()
    AudioTags tags;              ///< as AudioFileInfo::tags
};

/// Reads and decodes a whole file. Errors: as open_audio_file; a file longer than `max_seconds` (it
/// is refused, not cut).
[[nodiscard]] Expected<MonoAudio> read_all_mono(const std::filesystem::path& path,
                                                double max_seconds = 3600.0);

}  // namespace raks::audio
