#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "audio/io/audio_file.hpp"
#include "audio/io/devices.hpp"
#include "audio/synth/music_generator.hpp"
#include "engine/cli/bench.hpp"
#include "engine/cli/signals.hpp"
#include "engine/dance_files.hpp"
#include "engine/live_graph.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

#include <fmt/format.h>

namespace raks::cli {
namespace {

constexpr Nanos kPictureTime = std::chrono::microseconds(16'667);

/// A music file that is removed at the end.
class TemporaryMusic {
 public:
    explicit TemporaryMusic(const audio::GeneratedMusic& music)
        : path_(std::filesystem::temp_directory_path() /
                fmt::format("raks-bench-{}.wav", HostClock::now().time_since_epoch().count())) {
        written_ = audio::write_wav(path_, music.samples, music.channels, music.rate);
    }
    ~TemporaryMusic() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryMusic(const TemporaryMusic&) = delete;
    TemporaryMusic& operator=(const TemporaryMusic&) = delete;

    [[nodiscard]] const Expected<void>& written() const { return written_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
    Expected<void> written_;
};

void sleep_until(HostTime time) {
    timespec until{};
    until.tv_sec = time.time_since_epoch().count() / 1'000'000'000;
    until.tv_nsec = time.time_since_epoch().count() % 1'000'000'000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

/// What every displayed picture would have shown.
struct Watched {
    std::vector<double> music_age_ms;  // of the newest state, at the moment of drawing
    std::vector<double> pose_age_ms;   // how far the shown pose lies before the newest final one
    std::vector<double> bpm;
    std::vector<motion::Pose> shown;  // one every kPictureTime
    StreamTime first_moment{};        // of the first shown pose
    StreamTime count_1{};             // a moment that is count 1
};

Watched watch(engine::LiveGraph& graph, double seconds) {
    Watched watched;
    const HostTime start = HostClock::now();
    for (HostTime due = start; due < start + nanos_from_seconds(seconds) && !stop_signal();
         due += kPictureTime) {
        sleep_until(due);
        const engine::StageState& stage = graph.stage();
        const HostTime now = HostClock::now();
        if (stage.track.is_empty() || !graph.analysis().clock().is_running) {
            continue;
        }
        const StreamTime moment = graph.moment_at(now);
        watched.music_age_ms.push_back(
            1e3 * to_seconds(graph.analysis().taken_until() - stage.music.time));
        watched.pose_age_ms.push_back(1e3 *
                                      to_seconds(time_of_hop(stage.track.newest_final()) - moment));
        watched.bpm.push_back(stage.music.grid.tempo.bpm());
        if (watched.shown.empty()) {
            watched.first_moment = moment;
        }
        watched.shown.push_back(stage.track.at(moment));
        if (stage.dancer.is_dancing) {
            const BeatGrid& grid = stage.music.grid;
            watched.count_1 = grid.time_of(grid.beats_at(stage.music.time) -
                                           Beats(stage.dancer.phase / stage.dancer.octave));
        }
    }
    return watched;
}

/// The steps of the displayed poses against the beats in the samples that were sent out.
void add_landing(const Watched& watched, const audio::GeneratedMusic& music, BenchReport& report) {
    const auto path = engine::data_path("models/trained/salsa_basic_lead.json");
    if (!path) {
        return;
    }
    const auto figure = motion::load_figure(*path);
    if (!figure || watched.shown.size() < 600) {
        return;
    }
    // The first count 1 whose beat lies behind the start and blend-in of the dance.
    constexpr double kBlendIn = 4.0;
    const auto nearest =
        std::min_element(music.beats.begin(), music.beats.end(), [&](const auto& a, const auto& b) {
            return std::abs((a.time - watched.count_1).count()) <
                   std::abs((b.time - watched.count_1).count());
        });
    const auto first = static_cast<std::size_t>(nearest - music.beats.begin()) % 8;
    std::vector<double> counts;
    for (std::size_t beat = first; beat < music.beats.size(); ++beat) {
        const double time = to_seconds(music.beats[beat].time - watched.first_moment);
        if (!counts.empty() || (time > kBlendIn && beat % 8 == first)) {
            counts.push_back(time);
        }
    }
    const double rate = 1.0 / to_seconds(Nanos(kPictureTime));
    const motion::LandingReport landing = motion::landing_errors(
        motion::body_track(motion::mannequin_skeleton(), watched.shown, rate), *figure, counts);
    report.values.emplace_back("landings", static_cast<double>(landing.landings.size()));
    report.values.emplace_back("landing_mean_ms", 1e3 * landing.mean);
    report.values.emplace_back("landing_sd_ms", 1e3 * landing.deviation);
}

}  // namespace

Expected<BenchReport> bench_latency(double seconds) {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.tempo = {{0.0, 180.0}};
    plan.seconds = seconds + 2.0;
    const auto music = audio::generate(plan);
    if (!music) {
        return fail(music.error());
    }
    const TemporaryMusic file(*music);
    if (!file.written()) {
        return fail(file.written().error());
    }
    const auto library = engine::load_dance("salsa");
    if (!library) {
        return fail(library.error());
    }
    const auto system = audio::AudioSystem::open();
    std::optional<audio::AudioDevice> output;
    if (system) {
        if (const auto choice = audio::choose_output(system->devices())) {
            output = choice->device;
        }
    }
    auto player = audio::FilePlayer::start({file.path()});
    if (!player) {
        return fail(player.error());
    }
    engine::LiveGraphConfig config;
    config.library = *library;
    auto graph = engine::LiveGraph::play(std::move(*player), output, config);
    if (!graph) {
        return fail(graph.error());
    }
    const Watched watched = watch(**graph, seconds);

    BenchReport report;
    report.notes.emplace_back("output", output ? output->name : "none: paced by the clock");
    const engine::TimingHistogram& callback = (*graph)->analysis().callback_times();
    report.spreads.emplace_back("callback_ms",
                                Spread{callback.quantile_ms(0.5),
                                       callback.quantile_ms(0.95),
                                       callback.quantile_ms(0.99),
                                       callback.max_ms()});
    report.spreads.emplace_back("music_age_ms", spread_of(watched.music_age_ms));
    report.spreads.emplace_back("pose_age_ms", spread_of(watched.pose_age_ms));
    report.values.emplace_back("bpm", spread_of(watched.bpm).p50);
    report.values.emplace_back("reported_output_latency_ms",
                               1e3 * to_seconds((*graph)->output_latency()));
    add_landing(watched, *music, report);
    const engine::LiveCounters counters = (*graph)->counters();
    report.values.emplace_back("dropped_states", static_cast<double>(counters.dropped_states));
    report.values.emplace_back("xruns", static_cast<double>(counters.xruns));
    report.values.emplace_back("underruns", static_cast<double>(counters.underruns));
    return report;
}

}  // namespace raks::cli
