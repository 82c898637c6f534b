// Sound in, steps out: where the feet land on music that the tracker hears, through the offline
// driver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/settings.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"
#include "tests/engine/installed.hpp"

namespace raks::engine {
namespace {

constexpr double kPieceSeconds = 45.0;
constexpr double kBlendIn = 4.0;   // seconds: after a wait for the bar
constexpr double kSettled = 10.0;  // seconds: tracked, started, blended in

class Poses final : public OfflineDriver::Sink {
 public:
    Poses() {
        all.reserve(static_cast<std::size_t>(100.0 * kPieceSeconds) + 100);
    }  // real-time path
    void on_hop(const PerformedHop& hop) override {
        all.push_back(hop.track.at_hop(hop.music.hop));
        if (hop.dancer.reanchors != reanchors) {
            reanchors = hop.dancer.reanchors;
            count_from = to_seconds(time_of_hop(hop.music.hop) - StreamTime{});
        }
    }
    std::vector<motion::Pose> all;
    double count_from = 0.0;  // seconds: the count of the dance lasts from there on
    std::uint32_t reanchors = 0;
};

Poses danced(const audio::GeneratedMusic& music) {
    auto library = installed::library_of("salsa");
    auto driver = OfflineDriver::create(
        music.rate, installed::models(), cast_of(library, motion::mannequin_skeleton(), 1));
    EXPECT_TRUE(driver) << driver.error().message;
    // One figure, whose learnt offsets are compared with.
    driver->command(motion::DancerCommand{motion::DancerCommand::Kind::lock_figure, {}, 1.0});
    Poses poses;
    driver->feed(music.mono(), poses);
    return poses;
}

/// Against the exact beats. Music does not say on which of its beats the figure's count 1 was
/// danced (a bar of 4 goes twice into 8 counts, and the bar may be misheard): the one at which most
/// of what is expected comes down.
motion::LandingReport landing_on(const audio::GeneratedMusic& music,
                                 const motion::FigureModel& figure) {
    const Poses poses = danced(music);
    const auto track = motion::body_track(motion::mannequin_skeleton(), poses.all, 100.0);
    // A bar that is found late is waited for.
    const double from = std::max(kSettled, poses.count_from + kBlendIn);
    std::vector<double> beats;
    for (const audio::ReferenceBeat& beat : music.beats) {
        if (to_seconds(beat.time) > from) {
            beats.push_back(to_seconds(beat.time));
        }
    }
    motion::LandingReport best;
    best.missing = beats.size();
    for (std::size_t first = 0; first < 8; ++first) {
        const auto report = motion::landing_errors(track, figure, std::span(beats).subspan(first));
        if (report.missing < best.missing) {
            best = report;
        }
    }
    return best;
}

/// Without the tenth of the landings that lie farthest off: a foot that hesitates on its way counts
/// as landed there by the rule of foot_events.hpp, up to 100 ms before it stands.
motion::LandingReport without_hesitations(motion::LandingReport report) {
    std::sort(report.landings.begin(), report.landings.end(), [](const auto& a, const auto& b) {
        return std::abs(a.error) < std::abs(b.error);
    });
    report.landings.resize(report.landings.size() - report.landings.size() / 10);
    motion::summarize(report);
    return report;
}

struct Song {
    audio::Style style;
    double bpm;
};

class OfflineLanding : public ::testing::TestWithParam<Song> {};

TEST_P(OfflineLanding, is_on_the_beat_of_steady_music) {
    const auto path = data_path("models/trained/salsa_basic_lead.json");
    ASSERT_TRUE(path) << path.error().message;
    const auto figure = motion::load_figure(*path);
    ASSERT_TRUE(figure) << figure.error().message;
    audio::MusicPlan plan;
    plan.style = GetParam().style;
    plan.tempo = {{0.0, GetParam().bpm}};
    plan.seconds = kPieceSeconds;
    const auto music = audio::generate(plan);
    ASSERT_TRUE(music) << music.error().message;
    const motion::LandingReport landing = without_hesitations(landing_on(*music, *figure));
    std::printf("%5.0f BPM: landing %+6.1f ms, sd %5.1f ms, n %zu, missing %zu\n",
                GetParam().bpm,
                1e3 * landing.mean,
                1e3 * landing.deviation,
                landing.landings.size(),
                landing.missing);
    EXPECT_GE(landing.landings.size(), 20U);
    EXPECT_LE(std::abs(landing.mean), 0.015);
    EXPECT_LE(landing.deviation, 0.025);
}

INSTANTIATE_TEST_SUITE_P(Songs,
                         OfflineLanding,
                         ::testing::Values(Song{audio::Style::drums, 125.0},
                                           Song{audio::Style::drums, 150.0},
                                           Song{audio::Style::drums, 184.0},
                                           Song{audio::Style::montuno, 160.0},
                                           Song{audio::Style::montuno, 184.0},
                                           Song{audio::Style::montuno, 200.0},
                                           Song{audio::Style::four_on_the_floor, 126.0}));

}  // namespace
}  // namespace raks::engine
