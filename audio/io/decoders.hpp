#pragma once

#include <filesystem>
#include <memory>

#include "audio/io/audio_file.hpp"
#include "audio/io/file_window.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What open_audio_file() answers with, decoded in this process by libsndfile or FFmpeg: for the
/// program raks-decode, and for tests that compare with it. `name` is for messages alone.
/// Errors: as open_audio_file(), but for a file that cannot be opened.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<std::unique_ptr<AudioFileReader>> open_by_decoders(
    const std::filesystem::path& name, const FileWindow& file);

}  // namespace raks::audio
