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

Row row_of(std::string_view name, const audio::EventScore& score, double minutes) {
    return {std::string(name),
            fmt::format("{}/{}", score.found, score.wanted),
            fmt::format("{:.1f}", 100.0 * score.recall()),
            fmt::format("{:.1f}", 100.0 * score.precision()),
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

std::string text_of(const std::vector<MusicEvent>& events) {
    std::string text;
    for (const MusicEvent& event : events) {
        text += fmt::format(" {} {:.2f}", music_event_name(event.kind), to_seconds(event.time));
    }
    return text.empty() ? " nothing" : text;
}

std::string text_of(std::string_view way, const audio::FormFaults& faults) {
    return fmt::format(
        "  {}: missed{}; wrong{}\n", way, text_of(faults.missed), text_of(faults.false_ones));
}

Json json_of(const std::vector<MusicEvent>& events) {
    Json list = Json::array();
    for (const MusicEvent& event : events) {
        list.push_back({{"event", music_event_name(event.kind)}, {"time", to_seconds(event.time)}});
    }
    return list;
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
    std::string text = fmt::format("{:.1f} minutes of {}\n", report.minutes, report.songs);
    for (const auto& [name, scores] : ways_of(report)) {
        std::vector<Row> rows = {
            {name, "found", "%", "right %", "false/min", "offset s", "delay s", "p95 s"}};
        each_kind(*scores, [&](std::string_view kind, const audio::EventScore& score) {
            rows.push_back(row_of(kind, score, report.minutes));
        });
        text += "\n" + text_table(rows);
    }
    for (const SongFaults& song : report.each) {
        text += fmt::format("\n{}\n", song.song) + text_of("live", song.live) +
                text_of("ahead", song.ahead);
    }
    if (report.repeats.empty()) {
        return text;
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
        Json& kinds = document[way];
        each_kind(
            *scores, [&kinds, &report](std::string_view kind, const audio::EventScore& score) {
                kinds[std::string(kind)] = {
                    {"wanted", score.wanted},
                    {"found", score.found},
                    {"right", score.precision()},
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
    for (const SongFaults& song : report.each) {
        document["songs"].push_back({{"song", song.song},
                                     {"live_missed", json_of(song.live.missed)},
                                     {"live_wrong", json_of(song.live.false_ones)},
                                     {"ahead_missed", json_of(song.ahead.missed)},
                                     {"ahead_wrong", json_of(song.ahead.false_ones)}});
    }
    return document.text(2) + "\n";
}

}  // namespace raks::apps
