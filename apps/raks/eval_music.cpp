// `raks eval music`: measures how well it is told what music does, on generated songs.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "apps/dances/known_dances.hpp"
#include "apps/raks/commands.hpp"
#include "apps/reports/form_names.hpp"
#include "apps/reports/text_table.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/form_scores.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "base/statistics.hpp"
#include "engine/offline/last_hops.hpp"
#include "engine/setup/analyzer_setup.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

// All styles with a band; clicks have no form.
constexpr std::array kStyles = {audio::Style::drums,
                                audio::Style::montuno,
                                audio::Style::maqsum,
                                audio::Style::four_on_the_floor,
                                audio::Style::backbeat,
                                audio::Style::boom_bap,
                                audio::Style::oom_pah_pah};
// Silence after each song: its end is known when nothing comes.
constexpr double kTail = 4.0;
// A fade is over when it can no longer be heard, some time before its last sample.
constexpr Nanos kFadeTolerance = std::chrono::milliseconds(2500);
// Beats for which the one chord of a stop sounds: then it is a stop.
constexpr double kChordBeats = 0.8;

// The scores of one way of listening.
struct Listening {
    const char* name;
    audio::FormScores scores;
};

// Keeps what is told.
class Told final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        if (state.event.kind != MusicEvent::Kind::none) {
            events.push_back({state.event, state.time});
        }
    }
    std::vector<audio::ToldEvent> events;
};

// The events of a piece, each to be found within a beat.
std::vector<audio::TrueEvent> truth_of(const audio::GeneratedMusic& music, Nanos beat) {
    std::vector<audio::TrueEvent> truth;
    for (const MusicEvent& event : music.events) {
        audio::TrueEvent wanted{event, beat};
        for (const audio::PlayedSection& section : music.sections) {
            if (section.kind == audio::SectionKind::hit_stop && section.from == event.time) {
                wanted.event.time += nanos_from_seconds(kChordBeats * to_seconds(beat));
            }
            if (section.kind == audio::SectionKind::fade_out && section.to == event.time) {
                wanted.tolerance = kFadeTolerance;
            }
        }
        truth.push_back(wanted);
    }
    return truth;
}

Expected<audio::GeneratedMusic> song_of(audio::Style style, std::uint64_t seed, double seconds) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, audio::usual_tempo(style).bpm()}};
    plan.seconds = seconds;
    plan.channels = 1;
    plan.seed = seed;
    plan.first_beat_seconds = 0.5;
    plan.form = audio::song_form_of(plan);
    auto music = audio::generate(plan);
    if (music) {
        music->samples.resize(music->samples.size() +
                              static_cast<std::size_t>(kTail * plan.rate.hertz()));
    }
    return music;
}

// One song, live and known ahead.
Expected<void> listen(const audio::GeneratedMusic& music,
                      Nanos beat,
                      const engine::AnalyzerModels& models,
                      std::array<Listening, 2>& ways) {
    const std::vector<audio::TrueEvent> truth = truth_of(music, beat);
    auto live = engine::make_analyzer(music.rate, models);
    auto song = engine::make_song_analyzer(music.rate, models);
    if (!live || !song) {
        return fail(live ? song.error() : live.error());
    }
    Told heard;
    live->process(music.samples, heard);
    score_form(truth, heard.events, ways[0].scores);
    song->process(music.samples);
    Told known;
    for (const MusicState& state : song->finish().states) {
        known.on_state(state);
    }
    score_form(truth, known.events, ways[1].scores);
    return {};
}

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
        take(name_of(static_cast<MusicEvent::Kind>(i)), scores[i]);
    }
    take(std::string_view("all"), total_of(scores));
}

std::string text_of(const std::array<Listening, 2>& ways, double minutes) {
    std::string text = fmt::format("{:.1f} minutes of generated songs\n", minutes);
    for (const Listening& way : ways) {
        std::vector<Row> rows = {
            {way.name, "found", "%", "false/min", "offset s", "delay s", "p95 s"}};
        each_kind(way.scores, [&](std::string_view name, const audio::EventScore& score) {
            rows.push_back(row_of(name, score, minutes));
        });
        text += "\n" + text_table(rows);
    }
    return text;
}

std::string json_of(const std::array<Listening, 2>& ways, double minutes) {
    nlohmann::ordered_json document;
    document["format"] = "raks-eval-music";
    document["version"] = 1;
    document["minutes"] = minutes;
    for (const Listening& way : ways) {
        each_kind(way.scores, [&](std::string_view name, const audio::EventScore& score) {
            document[way.name][std::string(name)] = {
                {"wanted", score.wanted},
                {"found", score.found},
                {"false_a_minute", static_cast<double>(score.false_ones) / minutes},
                {"offset_median_s", percentile(score.offsets, 0.5)},
                {"delay_median_s", percentile(score.delays, 0.5)},
                {"delay_p95_s", percentile(score.delays, 0.95)}};
        });
    }
    return document.dump(2) + "\n";
}

}  // namespace

ExitCode eval_music(const EvalMusicArguments& arguments) {
    const auto models = load_models_of_known_dances();
    if (!models) {
        return fail(models.error());
    }
    std::array<Listening, 2> ways = {{{"live", {}}, {"ahead", {}}}};
    double minutes = 0.0;
    ProgressLine progress("listening");
    const int songs = arguments.songs * static_cast<int>(kStyles.size());
    for (int i = 0; i < songs && !stop_signal(); ++i) {
        const auto style = kStyles[static_cast<std::size_t>(i) % kStyles.size()];
        const auto seed = static_cast<std::uint64_t>(arguments.seed) +
                          static_cast<std::uint64_t>(i) / kStyles.size();
        const auto music = song_of(style, seed, arguments.seconds);
        if (!music) {
            return fail(music.error());
        }
        const Nanos beat = nanos_from_seconds(audio::usual_tempo(style).seconds_per_beat());
        if (auto heard = listen(*music, beat, *models, ways); !heard) {
            return fail(heard.error());
        }
        minutes += arguments.seconds / 60.0;
        progress.show(static_cast<double>(i + 1) / songs);
    }
    if (stop_signal()) {
        return kExitDone;  // half a table would mislead
    }
    if (arguments.as_json) {
        print_json(json_of(ways, minutes));
    } else {
        print_text(text_of(ways, minutes));
    }
    return kExitDone;
}

}  // namespace raks::apps
