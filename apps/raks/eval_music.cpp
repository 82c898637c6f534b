// `raks eval music`: measures how well it is told what music does, on generated or annotated songs.
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/dances/known_dances.hpp"
#include "apps/raks/commands.hpp"
#include "apps/reports/eval_music_report.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/event_corpus.hpp"
#include "audio/evaluate/form_scores.hpp"
#include "audio/evaluate/repeat_scores.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"

#include <fmt/format.h>

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
// A stop begins with one chord that sounds for so many beats; only then is it heard as a stop.
constexpr double kChordBeats = 0.8;

// Keeps what is told.
class Told final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        newest = state.time;
        if (state.event.kind != MusicEvent::Kind::none) {
            events.push_back({state.event, state.time});
        }
    }
    std::vector<audio::ToldEvent> events;
    StreamTime newest{};
};

// What was told of a song live, and of the whole of it.
struct ToldBothWays {
    Told live;
    Told ahead;
    std::vector<MusicState> states;  // of the whole of it
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

// Gives a song to both ways, block by block: `next` returns an empty block at its end. Live,
// silence follows it.
template <typename Next>
Expected<ToldBothWays> listen(SampleRate rate,
                              const engine::AnalyzerModels& models,
                              const Next& next) {
    auto live = engine::make_analyzer(rate, models);
    auto song = engine::make_song_analyzer(rate, models);
    if (!live || !song) {
        return fail(live ? song.error() : live.error());
    }
    ToldBothWays told;
    for (std::span<const float> block = next(); !block.empty() && !stop_signal(); block = next()) {
        live->process(block, told.live);
        song->process(block);
    }
    live->process(std::vector<float>(static_cast<std::size_t>(kTail * rate.hertz())), told.live);
    told.states = song->finish().states;
    for (const MusicState& state : told.states) {
        told.ahead.on_state(state);
    }
    return told;
}

void score(const std::string& name,
           const std::vector<audio::TrueEvent>& truth,
           const ToldBothWays& told,
           const EvalMusicArguments& arguments,
           MusicReport& report) {
    SongFaults faults{name,
                      score_form(truth, told.live.events, report.live),
                      score_form(truth, told.ahead.events, report.ahead)};
    if (arguments.asks_for_each) {
        report.each.push_back(std::move(faults));
    }
}

// All generated songs.
Expected<MusicReport> listen_to_generated(const EvalMusicArguments& arguments,
                                          const engine::AnalyzerModels& models) {
    MusicReport report;
    for (const audio::Style style : kStyles) {
        report.repeats.emplace_back(audio::name_of(style), audio::RepeatScore{});
    }
    ProgressLine progress("listening");
    const int songs = arguments.songs * static_cast<int>(kStyles.size());
    for (int i = 0; i < songs && !stop_signal(); ++i) {
        const std::size_t of_style = static_cast<std::size_t>(i) % kStyles.size();
        const auto style = kStyles[of_style];
        const auto seed = static_cast<std::uint64_t>(arguments.seed) +
                          static_cast<std::uint64_t>(i) / kStyles.size();
        const auto music = song_of(style, seed, arguments.seconds);
        if (!music) {
            return fail(music.error());
        }
        std::span<const float> rest = music->samples;
        const auto told = listen(
            music->rate, models, [&rest] { return std::exchange(rest, std::span<const float>()); });
        if (!told) {
            return fail(told.error());
        }
        const Nanos beat = nanos_from_seconds(audio::usual_tempo(style).seconds_per_beat());
        score(fmt::format("{} {}", audio::name_of(style), seed),
              truth_of(*music, beat),
              *told,
              arguments,
              report);
        report.repeats[of_style].second += score_repeats(audio::true_bars(*music), told->states);
        report.minutes += arguments.seconds / 60.0;
        progress.show(static_cast<double>(i + 1) / songs);
    }
    return report;
}

// All songs of a folder.
Expected<MusicReport> listen_to_annotated(const EvalMusicArguments& arguments,
                                          const engine::AnalyzerModels& models) {
    const auto excerpts = audio::load_event_corpus(arguments.folder);
    if (!excerpts) {
        return fail(excerpts.error());
    }
    MusicReport report;
    report.songs = "annotated songs";
    ProgressLine progress("listening");
    for (std::size_t i = 0; i < excerpts->size() && !stop_signal(); ++i) {
        const audio::EventExcerpt& excerpt = (*excerpts)[i];
        auto source = engine::MusicSource::open(excerpt.audio);
        if (!source) {
            return fail(source.error());
        }
        const auto told = listen(source->rate(), models, [&source] { return source->next().mono; });
        if (!told) {
            return fail(told.error());
        }
        std::vector<audio::TrueEvent> truth;
        for (const MusicEvent& event : excerpt.events) {
            truth.push_back({event, nanos_from_seconds(arguments.tolerance)});
        }
        score(excerpt.name, truth, *told, arguments, report);
        report.minutes += to_seconds(source->given()) / 60.0;
        progress.show(static_cast<double>(i + 1) / static_cast<double>(excerpts->size()));
    }
    return report;
}

}  // namespace

ExitCode eval_music(const EvalMusicArguments& arguments) {
    const auto models = load_models_of_known_dances();
    if (!models) {
        return fail(models.error());
    }
    const auto report = arguments.folder.empty() ? listen_to_generated(arguments, *models)
                                                 : listen_to_annotated(arguments, *models);
    if (!report) {
        return fail(report.error());
    }
    if (stop_signal()) {
        return kExitDone;  // half a table would mislead
    }
    if (arguments.as_json) {
        print_json(to_json(*report));
    } else {
        print_text(to_text(*report));
    }
    return kExitDone;
}

}  // namespace raks::apps
