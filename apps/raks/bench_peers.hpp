#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks/bench.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// A WAV file of generated music, removed when this is destroyed.
class TemporaryMusic {
 public:
    /// Writes the file into the folder for temporary files; see written().
    explicit TemporaryMusic(const audio::GeneratedMusic& music);
    ~TemporaryMusic();  ///< removes the file
    /// Not copied: two would remove one file.
    TemporaryMusic(const TemporaryMusic&) = delete;
    TemporaryMusic& operator=(const TemporaryMusic&) = delete;  ///< likewise

    /// Whether the file could be written. Errors: those of write_wav.
    [[nodiscard]] const Expected<void>& written() const { return written_; }
    /// Where the file lies.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    Expected<void> written_;
};

/// User and system time in seconds of a program that runs to its end, its output discarded. Errors:
/// it is not installed, or ends with another code than 0.
[[nodiscard]] Expected<double> cpu_seconds_of(const std::vector<std::string>& command);

/// Adds the processor time of aubio's beat tracker (Debian: aubio-tools) on the same music, on this
/// machine in this run; a note says so where it is not installed.
void add_aubio(const audio::GeneratedMusic& music, double seconds, BenchReport& report);

/// Adds the cost of MFCC-39 of a file at 16 kHz, and of aubio's 13 MFCC without derivatives
/// (aubiomfcc) on the same file, whose start, reading and printing cannot be separated.
[[nodiscard]] Expected<void> add_mfcc(const audio::GeneratedMusic& music,
                                      double seconds,
                                      BenchReport& report);

}  // namespace raks::apps
