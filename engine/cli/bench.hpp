#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/expected.hpp"

/// What the parts of `raks bench` share.
namespace raks::cli {

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

/// Plays generated music through the loudspeaker's device (JACK where it runs; our own clock where
/// there is none) and measures callback time, ages and the landing of displayed poses.
[[nodiscard]] Expected<BenchReport> bench_latency(double seconds);

}  // namespace raks::cli
