#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks/bench.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// A music file that is removed at the end.
class TemporaryMusic {
 public:
    explicit TemporaryMusic(const audio::GeneratedMusic& music);
    ~TemporaryMusic();
    TemporaryMusic(const TemporaryMusic&) = delete;
    TemporaryMusic& operator=(const TemporaryMusic&) = delete;

    [[nodiscard]] const Expected<void>& written() const { return written_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    Expected<void> written_;
};

/// User + system seconds of a program that runs to its end with its output thrown away.
/// Errors: it is not installed, or ends with another code than 0.
[[nodiscard]] Expected<double> cpu_seconds_of(const std::vector<std::string>& command);

/// Adds what aubio's beat tracker (Debian: aubio-tools) needs for the same music, on this machine
/// in this run; a note says so where it is not installed.
void add_aubio(const audio::GeneratedMusic& music, double seconds, BenchReport& report);

/// Adds what MFCC-39 of a file at 16 kHz costs, and aubio's 13 MFCC without derivatives (aubiomfcc)
/// of the same file, whose start, reading and printing cannot be left out.
[[nodiscard]] Expected<void> add_mfcc(const audio::GeneratedMusic& music,
                                      double seconds,
                                      BenchReport& report);

}  // namespace raks::apps
