#include "apps/raks/bench.hpp"

#include <nlohmann/json.hpp>

namespace raks::apps {

std::string to_json(const std::string& what, const BenchReport& report) {
    // All results are on one level, by name.
    nlohmann::ordered_json document = {{"format", "raks-bench"}, {"version", 1}, {"bench", what}};
    for (const auto& [name, note] : report.notes) {
        document[name] = note;
    }
    for (const auto& [name, value] : report.values) {
        document[name] = value;
    }
    for (const auto& [name, spread] : report.spreads) {
        document[name] = {
            {"p50", spread.p50}, {"p95", spread.p95}, {"p99", spread.p99}, {"max", spread.max}};
    }
    // A driver's name need not be UTF-8.
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace raks::apps
