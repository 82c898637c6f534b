#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/expected.hpp"

/// What the parts of `raks bench` share.
namespace raks::apps {

struct Spread {
    double p50 = 0.0;
    double p95 = 0.0;
    double p99 = 0.0;
    double max = 0.0;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Named figures; a name ends in its unit.
struct BenchReport {
    std::vector<std::pair<std::string, std::string>> notes;
    std::vector<std::pair<std::string, double>> values;
    std::vector<std::pair<std::string, Spread>> spreads;
};
[[nodiscard]] std::string to_text(const BenchReport& report);
/// One document: format "raks-bench", version 1.
[[nodiscard]] std::string to_json(const std::string& what, const BenchReport& report);

/// User + system time of this thread, of all threads; seconds.
[[nodiscard]] double thread_cpu_seconds();
[[nodiscard]] double process_cpu_seconds();

/// Plays generated music (drums at 180 BPM) through the loudspeaker's device, or by our own clock
/// where there is none, and measures callback time, ages of what is drawn, and on JACK, through a
/// loop from our output to our input (loop_recorder.hpp), the latency, how far pictures lie ahead
/// of the sound, and the landing of displayed poses. What a loop would be needed for is "not
/// measured" without one. landing_mean_ms and landing_sd_ms are of the signed errors (late is
/// positive), landing_abs_ms of their sizes.
[[nodiscard]] Expected<BenchReport> bench_latency(double seconds);

/// Baum-Welch and scores of a left-to-right model with a full covariance a state, at sizes that
/// other programs were timed at: 10 states, 39 features, 50 sequences of 500 frames, 20 iterations.
[[nodiscard]] Expected<BenchReport> bench_train();

}  // namespace raks::apps
