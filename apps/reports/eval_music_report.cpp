#include "apps/reports/eval_music_report.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/reports/text_table.hpp"
#include "base/json.hpp"
#include "base/statistics.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// All kinds together.
audio::EventScore total_of(const audio::FormScores& scores) {
    audio::EventScore total;
    for (const audio::EventScore& score : scores) {
        total.wanted += score.wanted;
        total.found += score.found;
        total.false_ones += score.false_ones;
        total.offsets.insert(total.offsets.end(), score.offsets.begin(), score.offsets.end());
        total.delays.insert(total.delays.end(), score.delays.begin(), score.delays.end());
    }
    return total;
}

double found_share(const audio::EventScore& score) {
    return score.wanted == 0 ? 1.0
                             : static_cast<double>(score.found) / static_cast<double>(score.wanted);
}

Row row_of(std::string_view name, const audio::EventScore& score, double minutes) {
    return {std::string(name),
            fmt::format("{}/{}", score.found, score.wanted),
            fmt::format("{:.1f}", 100.0 * found_share(score)),
            fmt::format("{:.2f}", static_cast<double>(score.false_ones) / minutes),
            fmt::format("{:+.2f}", percentile(score.offsets, 0.5)),
            fmt::format("{:.2f}", percentile(score.delays, 0.5)),
            fmt::format("{:.2f}", percentile(score.delays, 0.95))};
}

// Kinds that music has, without "none".
template <typename Take>
void each_kind(const audio::FormScores& scores, const Take& take) {
    for (std::size_t i = 1; i < scores.size(); ++i) {
        take(music_event_name(static_cast<MusicEvent::Kind>(i)), scores[i]);
    }
    take(std::string_view("all"), total_of(scores));
}

std::array<std::pair<const char*, const audio::FormScores*>, 2> ways_of(const MusicReport& report) {
    return {{{"live", &report.live}, {"ahead", &report.ahead}}};
}

// A style's repeats, and those of all together.
template <typename Take>
void each_style(const MusicReport& report, const Take& take) {
    audio::RepeatScore all;
    for (const auto& [style, score] : report.repeats) {
        take(style, score);
        all += score;
    }
    take(std::string_view("all"), all);
}

Row row_of(std::string_view style, const audio::RepeatScore& score) {
    return {std::string(style),
            fmt::format("{}/{}", score.found, score.wanted),
            fmt::format("{:.1f}", 100.0 * score.recall()),
            fmt::format("{}/{}", score.right, score.told),
            fmt::format("{:.1f}", 100.0 * score.precision())};
}

}  // namespace

std::string to_text(const MusicReport& report) {
    std::string text = fmt::format("{:.1f} minutes of generated songs\n", report.minutes);
    for (const auto& [name, scores] : ways_of(report)) {
        std::vector<Row> rows = {{name, "found", "%", "false/min", "offset s", "delay s", "p95 s"}};
        each_kind(*scores, [&](std::string_view kind, const audio::EventScore& score) {
            rows.push_back(row_of(kind, score, report.minutes));
        });
        text += "\n" + text_table(rows);
    }
    std::vector<Row> rows = {{"bars that repeat", "found", "%", "right", "%"}};
    each_style(report, [&](std::string_view style, const audio::RepeatScore& score) {
        rows.push_back(row_of(style, score));
    });
    text += "\n" + text_table(rows);
    return text;
}

std::string to_json(const MusicReport& report) {
    Json document;
    document["format"] = "raks-eval-music";
    document["version"] = 1;
    document["minutes"] = report.minutes;
    for (const auto& [way, scores] : ways_of(report)) {
        each_kind(*scores, [&](std::string_view kind, const audio::EventScore& score) {
            document[way][std::string(kind)] = {
                {"wanted", score.wanted},
                {"found", score.found},
                {"false_a_minute", static_cast<double>(score.false_ones) / report.minutes},
                {"offset_median_s", percentile(score.offsets, 0.5)},
                {"delay_median_s", percentile(score.delays, 0.5)},
                {"delay_p95_s", percentile(score.delays, 0.95)}};
        });
    }
    each_style(report, [&](std::string_view style, const audio::RepeatScore& score) {
        document["repeats"][std::string(style)] = {{"wanted", score.wanted},
                                                   {"found", score.found},
                                                   {"told", score.told},
                                                   {"right", score.right}};
    });
    return document.text(2) + "\n";
}

}  // namespace raks::apps
