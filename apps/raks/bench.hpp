#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "base/expected.hpp"

/// The parts of `raks bench`.
namespace raks::apps {

/// Percentiles of some measurements.
struct Spread {
    double p50 = 0.0;  ///< median
    double p95 = 0.0;  ///< 95th percentile
    double p99 = 0.0;  ///< 99th percentile
    double max = 0.0;  ///< the highest value
};
/// All 0 when there are no values.
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// The results of one benchmark by name; a name ends in its unit.
struct BenchReport {
    std::vector<std::pair<std::string, std::string>> notes;  ///< name, text
    std::vector<std::pair<std::string, double>> values;      ///< name, number
    std::vector<std::pair<std::string, Spread>> spreads;     ///< name, percentiles
};
/// One line a result.
[[nodiscard]] std::string to_text(const BenchReport& report);
/// One document: format "raks-bench", version 1.
[[nodiscard]] std::string to_json(const std::string& what, const BenchReport& report);

/// User and system time of this thread, seconds.
[[nodiscard]] double thread_cpu_seconds();
/// User and system time of all threads, seconds.
[[nodiscard]] double process_cpu_seconds();

/// Plays generated music (drums at 180 BPM) on the loudspeaker's device, or by our own clock where
/// there is none, and measures: callback time, ages of what is drawn, and on JACK, through a loop
/// from our output to our input (loop_recorder.hpp), the latency, the lead of the pictures over the
/// sound, and the landing of the displayed poses. Without a loop those are "not measured".
/// landing_mean_ms and landing_sd_ms are of the signed errors (late is positive), landing_abs_ms of
/// their sizes. `is_held`: five beats are tapped as they are heard, and the tempo is held then.
[[nodiscard]] Expected<BenchReport> bench_latency(double seconds, bool is_held);

/// Times Baum-Welch training and scoring of a left-to-right HMM with a full covariance a state, at
/// sizes that other programs were timed at: 10 states, 39 features, 50 sequences of 500 frames, 20
/// iterations.
[[nodiscard]] Expected<BenchReport> bench_train();

/// Times the tracker of joint angles: whole postures that are weighed in a second of one core, and
/// frames of a simulated dance (300 particles, 10 layers) that are followed in a second, of the
/// clock and of the processor. Takes some 8 s.
[[nodiscard]] Expected<BenchReport> bench_capture();

/// Measures a model as an avatar: loading it (from file to the driver's memory), pictures in two
/// sizes beside the mannequin's with fast shaders, a step of its drivers, memory; and moving
/// vertices on the processor. Ratios are against a fixed workload of the same run. Errors: those of
/// engine::load_avatar; no OpenGL.
[[nodiscard]] Expected<BenchReport> bench_avatar(const std::string& model);

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
