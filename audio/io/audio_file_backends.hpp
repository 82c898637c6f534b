#pragma once

#include <filesystem>
#include <memory>

#include "audio/io/audio_file.hpp"
#include "base/expected.hpp"

/// The two decoders behind open_audio_file(). For audio/io alone. Threads: any. Real-time: no.
namespace raks::audio {

/// An open file, owned.
using AudioFileReaderPtr = std::unique_ptr<AudioFileReader>;

/// By libsndfile: WAV, AIFF, FLAC, Ogg Vorbis, Opus and its other formats, but not MP3.
/// Errors: not a file that it reads; check_head.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_sndfile(const std::filesystem::path& path);

/// By FFmpeg: MP3, M4A, AAC, WebM, WMA, the first sound track of videos.
/// Errors: not audio that it reads; no sound track; check_head.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_ffmpeg(const std::filesystem::path& path);

/// Errors: a rate outside 8 to 192 kHz, no channels or too many (the first of these faults).
[[nodiscard]] Expected<void> check_head(const std::filesystem::path& path, int hertz, int channels);

}  // namespace raks::audio
