#pragma once

#include <filesystem>
#include <memory>

#include "audio/io/audio_file.hpp"
#include "base/expected.hpp"

namespace raks::audio {

using AudioFileReaderPtr = std::unique_ptr<AudioFileReader>;

/// libsndfile: WAV, AIFF, FLAC, Ogg Vorbis, Opus and its other formats, but not MP3.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_sndfile(const std::filesystem::path& path);

/// FFmpeg: MP3, M4A, AAC, WebM, WMA, the first sound track of videos.
[[nodiscard]] Expected<AudioFileReaderPtr> open_by_ffmpeg(const std::filesystem::path& path);

/// The first fault of a head as an error, or nothing.
[[nodiscard]] Expected<void> check_head(const std::filesystem::path& path, int hertz, int channels);

}  // namespace raks::audio
