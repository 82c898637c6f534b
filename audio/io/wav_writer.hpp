#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

#include "base/expected.hpp"
#include "base/pending_file.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// A 16-bit WAV file that is written piece by piece, and is there complete or not at all.
/// Threads: one. Real-time: no.
class WavWriter {
 public:
    /// Of so many frames. Errors: those of PendingFile::create; a full disk; more than 4 GiB.
    [[nodiscard]] static Expected<WavWriter> create(const std::filesystem::path& path,
                                                    std::int64_t frames,
                                                    int channels,
                                                    SampleRate rate);
    /// Samples in [-1, 1], clamped; NaN becomes 0. Never more than all frames. Errors: a full disk.
    [[nodiscard]] Expected<void> write(std::span<const float> interleaved);
    /// After all frames: the file gets its name. Errors: those of PendingFile::commit.
    [[nodiscard]] Expected<void> commit();

 private:
    WavWriter(PendingFile file, std::int64_t samples) : file_(std::move(file)), missing_(samples) {}

    PendingFile file_;
    std::int64_t missing_;  // samples
};

/// Writes all at once. Errors: those of WavWriter.
[[nodiscard]] Expected<void> write_wav(const std::filesystem::path& path,
                                       std::span<const float> interleaved,
                                       int channels,
                                       SampleRate rate);

}  // namespace raks::audio
