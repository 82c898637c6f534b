// `raks eval music`: measures how well it is told what music does, on generated songs.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "apps/dances/known_dances.hpp"
#include "apps/raks/commands.hpp"
#include "apps/reports/eval_music_report.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/form_scores.hpp"
#include "audio/evaluate/repeat_scores.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "engine/setup/analyzer_setup.hpp"

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
                      audio::RepeatScore& repeats,
                      MusicReport& report) {
    const std::vector<audio::TrueEvent> truth = truth_of(music, beat);
    auto live = engine::make_analyzer(music.rate, models);
    auto song = engine::make_song_analyzer(music.rate, models);
    if (!live || !song) {
        return fail(live ? song.error() : live.error());
    }
    Told heard;
    live->process(music.samples, heard);
    score_form(truth, heard.events, report.live);
    song->process(music.samples);
    Told known;
    const audio::SongPlan plan = song->finish();
    for (const MusicState& state : plan.states) {
        known.on_state(state);
    }
    score_form(truth, known.events, report.ahead);
    repeats += score_repeats(audio::true_bars(music), plan.states);
    return {};
}

}  // namespace

ExitCode eval_music(const EvalMusicArguments& arguments) {
    const auto models = load_models_of_known_dances();
    if (!models) {
        return fail(models.error());
    }
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
        const Nanos beat = nanos_from_seconds(audio::usual_tempo(style).seconds_per_beat());
        if (auto heard = listen(*music, beat, *models, report.repeats[of_style].second, report);
            !heard) {
            return fail(heard.error());
        }
        report.minutes += arguments.seconds / 60.0;
        progress.show(static_cast<double>(i + 1) / songs);
    }
    if (stop_signal()) {
        return kExitDone;  // half a table would mislead
    }
    if (arguments.as_json) {
        print_json(to_json(report));
    } else {
        print_text(to_text(report));
    }
    return kExitDone;
}

}  // namespace raks::apps
