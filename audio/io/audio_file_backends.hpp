#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "audio/io/audio_file.hpp"
#include "audio/io/file_window.hpp"
#include "base/expected.hpp"

/// The two decoders behind open_audio_file(), and what they are given. For audio/io alone.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// An open file, owned.
using AudioFileReaderPtr = std::unique_ptr<AudioFileReader>;

/// A file, or one of the streams in it, as a decoder gets it.
struct DecoderInput {
    std::filesystem::path path;    ///< for messages
    FileWindow window;             ///< what to decode
    std::string note{};            ///< becomes part of warning(), which adds the path
    double missing_seconds = 0.0;  ///< of sound that the head promises and the file has not
    /// Has all bytes that its head promises: an end that comes before the claimed length is then
    /// no damage.
    bool is_complete = false;
    bool is_cut = false;  ///< ends within a packet
    /// Its time stamps lie a little beside its packets: these follow each other without a break.
    bool has_loose_stamps = false;
};

/// By libsndfile: WAV, AIFF, FLAC, Ogg Vorbis, Opus and its other formats, but not MP3.
/// Errors: not a file that it reads; check_head.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_sndfile(const DecoderInput& input);

/// By FFmpeg: MP3, M4A, AAC, WebM, WMA, the first sound track of videos.
/// Errors: not audio that it reads; no sound track; check_head.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_ffmpeg(const DecoderInput& input);

/// Errors: a rate outside 1 kHz to 3 MHz, no channels or too many (the first of these faults).
[[nodiscard]] Expected<void> check_head(const std::filesystem::path& path, int hertz, int channels);

/// What is said of a file that a recorder was still writing.
inline constexpr std::string_view kHasGrown =
    "grew while it was read; what came after it was opened is left out";

/// Appends `note` to a warning: "PATH: NOTE", or "...; NOTE" where there was one. An empty note
/// changes nothing.
void add_note(std::string& warning, const std::filesystem::path& path, std::string_view note);

/// "is damaged or cut off at 12.30 s; 3.40 s are missing", the latter part only from 5 ms on.
[[nodiscard]] std::string cut_off_note(double at_seconds, double missing_seconds);

}  // namespace raks::audio
