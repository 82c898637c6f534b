// The scenes of Ofli 2008, section 7, from sound to steps: a mix of both dances, and one that slows
// down and speeds up, danced by joint angles and by joint positions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/dancers.hpp"
#include "engine/setup/settings.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/dances.hpp"

namespace raks::engine {
namespace {

constexpr SampleRate kRate(48'000);

std::vector<float> music(audio::Style style, std::vector<audio::TempoPoint> tempo, double seconds) {
    audio::MusicPlan plan;
    plan.style = style;
    plan.tempo = std::move(tempo);
    plan.seconds = seconds;
    plan.rate = kRate;
    plan.channels = 1;
    const auto made = audio::generate(plan);
    EXPECT_TRUE(made);
    return made ? made->mono() : std::vector<float>();
}

/// What was believed and danced at each hop.
class Seen final : public OfflineDriver::Sink {
 public:
    explicit Seen(double seconds) {
        hops.reserve(static_cast<std::size_t>(kHopsPerSecond * seconds) + 100);
    }
    void on_hop(const PerformedHop& hop) override { hops.push_back({hop.music, hop.dancer}); }

    struct Hop {
        MusicState music;
        motion::DancerStatus dancer;
    };
    [[nodiscard]] const Hop& at(double seconds) const {
        return hops[std::min(static_cast<std::size_t>(seconds * kHopsPerSecond), hops.size() - 1)];
    }
    /// How often another dance was taken up than the one before.
    [[nodiscard]] int changes() const {
        int count = 0;
        DanceId before = DanceId::none;
        for (const Hop& hop : hops) {
            if (hop.dancer.dance != DanceId::none && hop.dancer.dance != before) {
                count += before == DanceId::none ? 0 : 1;
                before = hop.dancer.dance;
            }
        }
        return count;
    }
    std::vector<Hop> hops;
};

/// By the joints' angles or positions.
class MusicScenes : public ::testing::TestWithParam<std::string> {
 protected:
    static Seen danced(const std::vector<float>& mono, const std::string& figures) {
        Settings settings;
        settings.dance = "auto";
        settings.fallback_dance = "keep";
        settings.figures = figures;
        auto dancers = Dancers::load(settings, installed::dances(), {motion::mannequin_skeleton()});
        EXPECT_TRUE(dancers) << dancers.error().message;
        EXPECT_TRUE(dancers->wait().empty());
        auto driver = OfflineDriver::create(kRate, installed::models(), dancers->cast());
        EXPECT_TRUE(driver) << driver.error().message;
        Seen seen(static_cast<double>(mono.size()) / kRate.hertz());
        driver->feed(mono, seen);
        return seen;
    }
};

TEST_P(MusicScenes, a_mix_of_salsa_and_belly_dance_is_danced_as_it_goes) {
    constexpr double kEach = 25.0;
    std::vector<float> mix;
    for (const auto& [style, bpm] : {std::pair{audio::Style::montuno, 180.0},
                                     {audio::Style::maqsum, 108.0},
                                     {audio::Style::montuno, 176.0}}) {
        const std::vector<float> piece = music(style, {{0.0, bpm}}, kEach);
        mix.insert(mix.end(), piece.begin(), piece.end());
    }
    const Seen seen = danced(mix, GetParam());
    const DanceId expected[] = {shipped::salsa, shipped::belly, shipped::salsa};
    for (int i = 0; i < 3; ++i) {
        // Recognised within 8 s; then the dance goes over within three bars (DanceChanges).
        const double start = kEach * i;
        EXPECT_EQ(seen.at(start + 8.0).music.genre, expected[i]) << "piece " << i;
        EXPECT_EQ(seen.at(start + 15.0).dancer.dance, expected[i]) << "piece " << i;
        EXPECT_EQ(seen.at(start + kEach - 0.1).dancer.dance, expected[i]) << "piece " << i;
    }
    EXPECT_EQ(seen.changes(), 2);
}

TEST_P(MusicScenes, a_salsa_a_tenth_slower_and_faster_stays_one_dance_at_the_musics_tempo) {
    const Seen seen =
        danced(music(audio::Style::montuno,
                     {{0.0, 180.0}, {14.0, 180.0}, {18.0, 162.0}, {26.0, 162.0}, {34.0, 198.0}},
                     42.0),
               GetParam());
    EXPECT_EQ(seen.changes(), 0);
    for (const auto& [seconds, bpm] : {std::pair{13.5, 180.0}, {25.5, 162.0}, {41.5, 198.0}}) {
        const motion::DancerStatus& dancer = seen.at(seconds).dancer;
        EXPECT_EQ(dancer.dance, shipped::salsa) << seconds << " s";
        EXPECT_NEAR(dancer.rate, dancer.octave * bpm / 60.0, 0.03 * bpm / 60.0) << seconds << " s";
    }
}

INSTANTIATE_TEST_SUITE_P(Figures,
                         MusicScenes,
                         ::testing::Values("angles", "positions"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace raks::engine
