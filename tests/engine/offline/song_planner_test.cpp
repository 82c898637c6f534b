#include "engine/offline/song_planner.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

class SongPlannerTest : public ::testing::Test {
 protected:
    /// A salsa with silence before and after it.
    [[nodiscard]] std::filesystem::path song(const std::string& name, double seconds) const {
        audio::MusicPlan plan;
        plan.style = audio::Style::montuno;
        plan.tempo = {{0.0, 180.0}};
        plan.seconds = seconds;
        plan.rate = SampleRate(44'100);
        plan.silences = {{0.0, 2.0}, {seconds - 4.0, seconds}};
        const auto music = audio::generate(plan);
        EXPECT_TRUE(music);
        EXPECT_TRUE(audio::write_wav(folder_ / name, music->samples, music->channels, music->rate));
        return folder_ / name;
    }
    test::TemporaryFolder folder_;
};

TEST_F(SongPlannerTest, plans_a_file_and_keeps_the_plan) {
    SongPlanner planner(installed::models());
    const auto file = song("a.wav", 12.0);
    EXPECT_EQ(planner.wait_for(file), nullptr) << "not begun";
    planner.prepare(file);
    const PlanOfSong plan = planner.wait_for(file);
    ASSERT_NE(plan, nullptr);
    EXPECT_EQ(plan->states.size(), 1'200U);
    planner.prepare(song("b.wav", 8.0));
    EXPECT_EQ(planner.look(file).plan, plan) << "the next one is planned beside it";
    planner.prepare(song("c.wav", 8.0));
    EXPECT_EQ(planner.look(file).plan, nullptr) << "two are kept";
}

TEST_F(SongPlannerTest, plans_anew_what_a_person_has_corrected_meanwhile) {
    AnalyzerModels models = installed::models();
    models.corrections = std::make_shared<KeptCorrections>(DanceCorrections());
    SongPlanner planner(models);
    const auto file = song("a.wav", 12.0);
    const auto next = song("b.wav", 8.0);
    planner.prepare(file);
    planner.prepare(next);
    const PlanOfSong heard = planner.wait_for(next);
    const PlanOfSong playing = planner.wait_for(file);
    ASSERT_TRUE(heard && playing);
    EXPECT_NE(heard->states.front().genre, shipped::waltz);
    planner.prepare(next);
    EXPECT_EQ(planner.look(next).plan, heard) << "nothing was said";
    const auto place = place_of_song(next);
    ASSERT_TRUE(models.corrections->keep({"waltz", "", place.parent_path(), place}));
    planner.prepare(next);
    const PlanOfSong corrected = planner.wait_for(next);
    ASSERT_TRUE(corrected);
    EXPECT_EQ(corrected->states.front().genre, shipped::waltz);
    EXPECT_EQ(planner.look(file).plan, playing) << "what plays goes on by its plan";
    std::filesystem::remove(DanceCorrections::path());
}

TEST_F(SongPlannerTest, a_file_that_cannot_be_read_has_no_plan) {
    SongPlanner planner(installed::models());
    planner.prepare(folder_ / "none.wav");
    EXPECT_EQ(planner.wait_for(folder_ / "none.wav"), nullptr);
    const auto plan = plan_song(folder_ / "none.wav", installed::models());
    ASSERT_FALSE(plan);
    EXPECT_NE(plan.error().message.find("none.wav"), std::string::npos);
}

TEST_F(SongPlannerTest, ends_early_when_told) {
    const auto plan = plan_song(song("a.wav", 12.0), installed::models(), {}, [] { return true; });
    ASSERT_TRUE(plan);
    EXPECT_EQ(*plan, nullptr);
}

// When the first dancer dances, and how.
class PoseWatch final : public OfflineDriver::Sink {
 public:
    void on_hop(const PerformedHop& hop) override {
        if (hop.dancer.is_dancing) {
            first = first < 0 ? hop.music.hop : first;
            last = hop.music.hop;
        }
    }
    HopIndex first = -1;
    HopIndex last = -1;
};

TEST_F(SongPlannerTest, the_dance_begins_with_the_first_bar_and_ends_with_the_music) {
    const auto file = song("a.wav", 24.0);
    const auto plan = plan_song(file, installed::models());
    ASSERT_TRUE(plan);
    auto driver =
        OfflineDriver::create(SampleRate(44'100), *plan, StreamTime{}, installed::solo("salsa"));
    ASSERT_TRUE(driver);
    PoseWatch watch;
    driver->feed(std::vector<float>(24 * 44'100), watch);
    driver->finish(watch);
    const Foresight& ahead = (*plan)->states.front().ahead;
    EXPECT_NEAR(to_seconds(time_of_hop(watch.first)), to_seconds(ahead.begins), 0.011);
    EXPECT_NEAR(to_seconds(time_of_hop(watch.first)), 2.0, 4.0 * 60.0 / 180.0 + 0.05);
    // The last posture is held for a while.
    EXPECT_GT(time_of_hop(watch.last), ahead.ends);
    EXPECT_LT(time_of_hop(watch.last), ahead.ends + std::chrono::milliseconds(2'500));
    EXPECT_NEAR(to_seconds(ahead.ends), 20.0, 4.0 * 60.0 / 180.0);
}

}  // namespace
}  // namespace raks::engine
