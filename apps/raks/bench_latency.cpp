#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/raks/arrival_watch.hpp"
#include "apps/raks/bench.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/program.hpp"
#include "audio/io/devices.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/sleep_until.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/trials/loop_recorder.hpp"
#include "engine/trials/shown_landing.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Pictures at 60 a second, as a usual screen shows them.
constexpr Nanos kPictureTime = std::chrono::microseconds(16'667);
// Steady, so that an error is the program's and not the music's.
constexpr double kBpm = 180.0;
// Seconds of silence before the first beat: time to connect the loop, and the silence that
// audible_beats() needs.
constexpr double kLeadIn = 2.0;
// PacedClock's block, where no device says its own.
constexpr int kOwnClockBlock = 256;

// What every picture would have shown, and the ages that belong to it.
struct Watched {
    std::vector<double> music_age_ms;  // of the newest state, at the moment of drawing
    std::vector<double> pose_age_ms;   // how far the shown pose lies before the newest final one
    std::vector<double> late_ms;       // how late the picture was drawn
    std::vector<double> bpm;
    std::vector<BeatGrid> grids;
    std::vector<engine::ShownPicture> pictures;
    motion::FigureModel figure;  // that was danced
    motion::Skeleton skeleton;
};

// A person who taps five beats of the music as they are heard, and then holds its tempo.
class Tapper {
 public:
    explicit Tapper(const audio::GeneratedMusic& music) : music_(&music) {}
    void watch(engine::LiveGraph& graph, HostTime now) {
        constexpr std::size_t kFirst = 12;
        constexpr std::size_t kTaps = 5;
        while (taps_ < kTaps && kFirst + taps_ < music_->beats.size()) {
            const HostTime heard = graph.heard_at(music_->beats[kFirst + taps_].time);
            if (heard > now) {
                return;
            }
            static_cast<void>(graph.command(audio::AnalyzerCommand::Kind::tap, 0.0, heard));
            if (++taps_ == kTaps) {
                static_cast<void>(graph.command(audio::AnalyzerCommand::Kind::set_tempo, kBpm));
            }
        }
    }

 private:
    const audio::GeneratedMusic* music_;
    std::size_t taps_ = 0;
};

// Draws nothing, but takes clock, stage and moment as a window's loop does at each picture. Errors:
// the device has died.
Expected<Watched> watch(engine::LiveGraph& graph, double seconds, std::optional<Tapper> tapper) {
    Watched watched;
    watched.pictures.reserve(static_cast<std::size_t>(seconds / to_seconds(kPictureTime)) + 1);
    const HostTime start = HostClock::now();
    for (HostTime due = start; due < start + nanos_from_seconds(seconds) && !stop_signal();
         due += kPictureTime) {
        sleep_until(due);
        if (const auto lines = graph.watch(HostClock::now()); graph.has_lost_device()) {
            return fail(lines.empty() ? "the device is gone" : lines.front());
        }
        const engine::StageState& stage = graph.stage();
        const HostTime now = HostClock::now();
        if (tapper) {
            tapper->watch(graph, now);
        }
        const engine::ClockLine clock = graph.analysis().clock();
        // Before the first pose there is nothing to show.
        if (stage.track().is_empty() || !clock.is_running) {
            continue;
        }
        const StreamTime moment = graph.moment_at(now);
        watched.late_ms.push_back(1e3 * to_seconds(now - due));
        watched.music_age_ms.push_back(
            1e3 * to_seconds(graph.analysis().taken_until() - stage.music.time));
        watched.pose_age_ms.push_back(
            1e3 * to_seconds(time_of_hop(stage.track().newest_final()) - moment));
        watched.bpm.push_back(stage.music.grid.tempo.bpm());
        watched.grids.push_back(stage.music.grid);
        watched.pictures.push_back({now,
                                    moment,
                                    clock,
                                    stage.dancer.is_dancing,
                                    stage.dancer.octave,
                                    stage.dancer.reanchors,
                                    stage.track().at(moment)});
    }
    return watched;
}

// Music with sharp attacks, which the loop's recording is searched for.
Expected<audio::GeneratedMusic> music_for(const std::optional<audio::AudioDevice>& output,
                                          double seconds,
                                          audio::Style style) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, kBpm}};
    plan.seconds = kLeadIn + seconds + 2.0;
    plan.first_beat_seconds = kLeadIn;
    // At the device's own rate: nothing is resampled, so that the samples that come back are the
    // ones that were generated.
    const SampleRate rate(output ? static_cast<int>(std::lround(output->default_rate)) : 48'000);
    plan.rate = rate.is_supported() ? rate : plan.rate;
    return audio::generate(plan);
}

// Beats by which the tracker's bar lies after the music's, 0 to 3.
double bar_offset(const BeatGrid& grid, const audio::GeneratedMusic& music) {
    const double position = grid.bar_position(grid.beats_at(music.beats[0].time));
    return std::fmod(4.0 - std::round(position), 4.0);
}

// How late the grid's beats lie after the music's at each picture's moment, ms: the part of the
// landing error that comes from the tracker.
std::vector<double> grid_errors_ms(const Watched& watched, const audio::GeneratedMusic& music) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < watched.pictures.size(); ++i) {
        if (!watched.pictures[i].is_dancing) {
            continue;
        }
        const double beats =
            to_seconds(watched.pictures[i].moment - music.beats[0].time) * kBpm / 60.0;
        const double tracked = watched.grids[i].beats_at(watched.pictures[i].moment).count();
        // The nearest beat: which one it is, is bar_offset()'s question.
        const double ahead = std::remainder(tracked - beats, 1.0);
        errors.push_back(-1e3 * ahead * 60.0 / kBpm);
    }
    return errors;
}

// Sizes of the landing errors.
Spread absolute_errors_ms(const motion::LandingReport& landing) {
    std::vector<double> errors;
    for (const motion::Landing& one : landing.landings) {
        errors.push_back(1e3 * std::abs(one.error));
    }
    return spread_of(std::move(errors));
}

// Landings of the poses that were shown, against the beats as they were out.
void add_landing(const Watched& watched,
                 const engine::SoundLine& sound,
                 const audio::GeneratedMusic& music,
                 BenchReport& report) {
    const auto landing =
        engine::shown_landing(watched.pictures, sound, music, watched.figure, watched.skeleton);
    if (!landing) {
        report.notes.emplace_back("landing", "not measured: too little was danced");
        return;
    }
    report.notes.emplace_back(
        "landing",
        fmt::format("against the clicks that came back; count 1 on a downbeat of the music, the "
                    "half of the figure by its steps ({} missing; {} in the other half)",
                    landing->report.missing,
                    landing->other_half.missing));
    const motion::LandingReport& taken = landing->report;
    report.values.emplace_back("landings", static_cast<double>(taken.landings.size()));
    report.values.emplace_back("landings_missing", static_cast<double>(taken.missing));
    report.values.emplace_back("landings_unexpected", static_cast<double>(taken.unexpected));
    report.values.emplace_back("landing_mean_ms", 1e3 * taken.mean);
    report.values.emplace_back("landing_sd_ms", 1e3 * taken.deviation);
    report.spreads.emplace_back("landing_abs_ms", absolute_errors_ms(taken));
}

// All measurements that need the recorded sound; notes say why where they are not made.
void add_loop(const Watched& watched,
              const Expected<engine::LoopRecording>& recording,
              const audio::GeneratedMusic& music,
              const ArrivalWatch& arrivals,
              Nanos reported_latency,
              BenchReport& report) {
    // Fewer beats say too little.
    constexpr std::size_t kLeastBeats = 16;
    const auto not_measured = [&](const std::string& why) {
        for (const char* name : {"loop", "landing"}) {
            report.notes.emplace_back(name, "not measured: " + why);
        }
    };
    if (!recording) {
        not_measured(recording.error().message);
        return;
    }
    const std::vector<engine::AudibleBeat> audible = engine::audible_beats(*recording, music);
    if (audible.size() < kLeastBeats) {
        not_measured(fmt::format("only {} beats came back", audible.size()));
        return;
    }
    report.notes.emplace_back("loop", "JACK, our output ports to our input ports");
    const engine::SoundLine sound(audible, music);
    const Spread latency = spread_of(engine::loop_latencies_ms(audible, music, watched.pictures));
    report.values.emplace_back("beats_back", static_cast<double>(audible.size()));
    report.values.emplace_back("loop_latency_ms", latency.p50);
    // Positive: the sound came later than the device reports.
    report.values.emplace_back("loop_minus_reported_ms",
                               latency.p50 - 1e3 * to_seconds(reported_latency));
    report.spreads.emplace_back("loop_latency_ms_spread", latency);
    report.spreads.emplace_back("picture_lead_ms",
                                spread_of(engine::picture_leads_ms(watched.pictures, sound)));
    arrivals.add_to(report, audible, music);
    add_landing(watched, sound, music, report);
}

// Time that the device's thread spends in the callback, absolute and as a share of a block.
void add_callback(engine::LiveGraph& graph, BenchReport& report) {
    const audio::DeviceStream* const stream = graph.stream();
    const engine::TimingHistogram& times = graph.analysis().callback_times();
    const Spread callback{
        times.quantile_ms(0.5), times.quantile_ms(0.95), times.quantile_ms(0.99), times.max_ms()};
    const int block = stream != nullptr ? stream->block_frames() : kOwnClockBlock;
    const int rate = stream != nullptr ? stream->rate().hertz() : 48'000;
    report.notes.emplace_back("callback_scheduling",
                              stream != nullptr ? stream->scheduling() : "no device");
    report.values.emplace_back("block_frames", block);
    report.values.emplace_back("sample_rate_hz", rate);
    // 1 would mean that the callback takes as long as a block lasts.
    report.values.emplace_back("callback_p99_share", 1e-3 * callback.p99 * rate / block);
    report.spreads.emplace_back("callback_ms", callback);
}

// How old the analysis and the poses are when they are drawn.
void add_ages(const Watched& watched, const audio::GeneratedMusic& music, BenchReport& report) {
    report.spreads.emplace_back("music_age_ms", spread_of(watched.music_age_ms));
    report.spreads.emplace_back("pose_age_ms", spread_of(watched.pose_age_ms));
    report.spreads.emplace_back("picture_late_ms", spread_of(watched.late_ms));
    // The median: the tracker is still locking in the first seconds.
    report.values.emplace_back("bpm", spread_of(watched.bpm).p50);
    if (!watched.grids.empty()) {
        report.values.emplace_back("bar_offset_beats", bar_offset(watched.grids.back(), music));
    }
    report.spreads.emplace_back("grid_late_ms", spread_of(grid_errors_ms(watched, music)));
}

// What was lost on the way.
void add_counters(const engine::LiveCounters& counters, BenchReport& report) {
    report.values.emplace_back("dropped_states", static_cast<double>(counters.dropped_states));
    report.values.emplace_back("xruns", static_cast<double>(counters.xruns));
    report.values.emplace_back("underruns", static_cast<double>(counters.underruns));
}

// The recorder for this output. Errors: there is none, or it has no loop.
Expected<std::unique_ptr<engine::LoopRecorder>> recorder_for(
    const Expected<audio::AudioSystem>& system,
    const std::optional<audio::AudioDevice>& output,
    double seconds) {
    if (!output) {
        return fail("no loudspeaker");
    }
    return engine::LoopRecorder::start_beside(system->devices(), *output, seconds);
}

// None where no audio system runs: the bench then measures what needs no sound.
std::optional<audio::AudioDevice> loudspeaker(const Expected<audio::AudioSystem>& system) {
    if (!system) {
        return std::nullopt;
    }
    const auto choice = audio::choose_output(system->devices());
    return choice ? std::optional(choice->device) : std::nullopt;
}

// Only JACK's ports can be joined to a loop, so that it is measured on JACK where that runs.
Expected<audio::AudioSystem> system_with_loop() {
    auto jack = audio::AudioSystem::open(audio::AudioSystemKind::jack);
    return jack ? std::move(jack) : audio::AudioSystem::open();
}

// The dance that is wanted, or the first one that has figures: the landings of takes are not told
// one by one.
std::string dance_of_figures(const engine::DanceCatalogue& catalogue, const std::string& wanted) {
    const engine::CatalogueEntry* const entry = catalogue.find(wanted);
    if (entry != nullptr && entry->has_figures) {
        return wanted;
    }
    const auto& all = catalogue.entries();
    const auto first = std::find_if(all.begin(), all.end(), [](const engine::CatalogueEntry& each) {
        return each.has_figures;
    });
    return first == all.end() ? wanted : first->info.name;
}

}  // namespace

Expected<BenchReport> bench_latency(double seconds, bool is_held) {
    const auto system = system_with_loop();
    const std::optional<audio::AudioDevice> output = loudspeaker(system);
    // With the tempo held the clicks alone say where the beat is; drums show the tracker's own
    // errors.
    const auto music =
        music_for(output, seconds, is_held ? audio::Style::clicks : audio::Style::drums);
    if (!music) {
        return fail(music.error());
    }
    // Played from a file, as `raks play` does.
    const TemporaryMusic file(*music);
    if (!file.written()) {
        return fail(file.written().error());
    }
    engine::LiveGraphConfig config;
    engine::Settings settings;
    const auto setup = open_dances(settings);
    if (!setup) {
        return fail(setup.error());
    }
    const std::string dance =
        dance_of_figures(setup->catalogue, engine::dance_to_load(settings, setup->catalogue));
    // The figures' models are needed for their learnt landings, the library for dancing.
    engine::DanceForm form;
    form.material = engine::Material::written;
    const auto parts = setup->catalogue.read(dance, motion::DanceRole::lead, form);
    const auto library =
        engine::load_dance(setup->catalogue, dance, setup->skeleton, motion::DanceRole::lead, form);
    auto player = audio::FilePlayer::start({file.path()});
    if (!parts) {
        return fail(parts.error());
    }
    if (!library || !player) {
        return fail(!library ? library.error() : player.error());
    }
    config.models = setup->models;
    config.cast = engine::cast_of(*library, setup->skeleton, 1);
    // Others are told of the beats, too, as a show does.
    const auto arrivals = ArrivalWatch::open();
    if (!arrivals) {
        return fail(arrivals.error());
    }
    const auto outputs = engine::Outputs::open((*arrivals)->wishes());
    if (!outputs) {
        return fail(outputs.error());
    }
    // The first callback must not find an empty ring.
    (*player)->wait_until_ready(4096);
    // Room for the whole piece and some seconds of starting and ending.
    auto recorder = recorder_for(system, output, kLeadIn + seconds + 5.0);
    auto graph = engine::LiveGraph::play(std::move(*player), output, config);
    if (!graph) {
        return fail(graph.error());
    }
    // After the graph has started, as the loop connects its running output.
    auto loop = recorder ? (*recorder)->close_loop(*(*graph)->stream()) : fail(recorder.error());
    // One figure, whose learnt landings are compared with.
    if (!(*graph)->command(motion::DancerCommand::Kind::lock_figure, 1.0)) {
        return fail("the dancers take no commands");
    }
    (*outputs)->follow((*graph)->feed(), config.models.dances);
    auto watched =
        watch(**graph, kLeadIn + seconds, is_held ? std::optional(Tapper(*music)) : std::nullopt);
    if (!watched) {
        return fail(watched.error());
    }
    watched->figure = parts->figures.front();
    watched->skeleton = setup->skeleton;

    BenchReport report;
    report.notes.emplace_back("output", output ? output->name : "none: paced by the clock");
    add_callback(**graph, report);
    add_ages(*watched, *music, report);
    report.values.emplace_back("reported_output_latency_ms",
                               1e3 * to_seconds((*graph)->heard_after()));
    add_loop(*watched,
             loop ? (*recorder)->recording() : fail(loop.error()),
             *music,
             **arrivals,
             (*graph)->heard_after(),
             report);
    add_counters((*graph)->counters(), report);
    return report;
}

}  // namespace raks::apps
