// The input of `live` on a clock of the test's own: blocks, gaps and another device.
#include "engine/live/live_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "engine/setup/told_genre.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

constexpr double kRecordBpm = 126.0;
constexpr Nanos kInputBlock = milliseconds(10);

/// A club record that goes on whoever listens: one minute of it.
audio::GeneratedMusic record_at(int rate) {
    audio::MusicPlan plan;
    plan.style = audio::Style::four_on_the_floor;
    plan.tempo = {{0.0, kRecordBpm}};
    plan.seconds = 60.0;
    plan.rate = SampleRate(rate);
    return audio::generate(plan).value();
}

class LiveInputTest : public ::testing::Test {
 protected:
    void SetUp() override {
        auto made = LiveInput::create(SampleRate(48'000), installed::models());
        ASSERT_TRUE(made) << made.error().message;
        input_ = std::move(*made);
    }

    /// A device at this rate hears the record from where it is now.
    void hear(const audio::GeneratedMusic& music, Nanos span) {
        const std::vector<float> mono = music.mono();
        for (const HostTime end = now_ + span; now_ < end;) {
            const auto at = static_cast<std::size_t>(music.rate.index_at(StreamTime(played())));
            now_ += kInputBlock;
            const auto to = static_cast<std::size_t>(music.rate.index_at(StreamTime(played())));
            test::RealtimeScope scope;
            input_->on_input(std::span(mono).subspan(at, to - at), 1, {0, now_, false});
            EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
            take_states();
        }
    }
    /// No device: our own clock calls.
    void miss(Nanos span) {
        const std::vector<float> silence(256);
        for (const HostTime end = now_ + span; now_ < end;) {
            now_ += Nanos(5'333'333);
            test::RealtimeScope scope;
            input_->gap().on_input(silence, 1, {0, now_, false});
            EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
            take_states();
        }
    }
    void take_states() {
        MusicState state;
        while (input_->analysis().states().pop(state)) {
            EXPECT_EQ(state.hop, hops_++) << "one state for every hop";
            gaps_ += state.is_discontinuity ? 1 : 0;
            last_ = state;
        }
    }
    [[nodiscard]] Nanos played() const { return now_ - start_; }
    /// How far stream time is behind the clock.
    [[nodiscard]] double behind_ms() const {
        return 1e3 * to_seconds(StreamTime(played()) - input_->analysis().taken_until());
    }
    /// Distance of the grid's nearest beat from the record's, in beats.
    [[nodiscard]] double off_beat() const {
        const double beats = to_seconds(last_.time) * kRecordBpm / 60.0;
        return std::remainder(last_.grid.beats_at(last_.time).count() - beats, 1.0);
    }

    const HostTime start_{std::chrono::seconds(1000)};
    HostTime now_ = start_;
    std::unique_ptr<LiveInput> input_;
    HopIndex hops_ = 0;
    int gaps_ = 0;
    MusicState last_;
};

TEST_F(LiveInputTest, the_grid_runs_on_without_a_device_and_locks_at_another_rate) {
    const audio::GeneratedMusic fine = record_at(48'000);
    hear(fine, milliseconds(10'000));
    ASSERT_NEAR(off_beat(), 0.0, 0.1);
    miss(milliseconds(1'700));
    EXPECT_NEAR(off_beat(), 0.0, 0.1) << "through the gap";
    EXPECT_FALSE(last_.is_silent);
    EXPECT_NEAR(behind_ms(), 0.0, 12.0);
    const int gaps_before = gaps_;
    ASSERT_TRUE(input_->resume(SampleRate(44'100)));
    hear(record_at(44'100), milliseconds(3'810));  // two bars
    EXPECT_EQ(gaps_, gaps_before + 1);
    EXPECT_NEAR(off_beat(), 0.0, 0.1);
    EXPECT_NEAR(behind_ms(), 0.0, 12.0);
    EXPECT_NEAR(last_.grid.tempo.bpm(), kRecordBpm, 1.0);
}

TEST_F(LiveInputTest, any_number_of_devices_leaves_stream_time_at_the_clock) {
    const audio::GeneratedMusic fine = record_at(48'000);
    const audio::GeneratedMusic coarse = record_at(22'050);
    for (int i = 0; i < 10; ++i) {
        hear(fine, milliseconds(500));
        miss(milliseconds(600));
        ASSERT_TRUE(input_->resume(coarse.rate));
        hear(coarse, milliseconds(500));
        miss(milliseconds(300));
        ASSERT_TRUE(input_->resume(fine.rate));
    }
    EXPECT_NEAR(behind_ms(), 0.0, 15.0);
    // Analyzed as far as the samples go: the analyzer's own count has not drifted from them.
    EXPECT_NEAR(to_seconds(input_->analysis().taken_until() - last_.time), 0.03, 0.03);
}

TEST_F(LiveInputTest, the_meter_falls_from_the_moment_that_no_sound_comes) {
    const AnalysisStage& stage = input_->analysis();
    hear(record_at(48'000), milliseconds(2'000));
    const float loud = stage.level_dbfs(HostClock::now());
    ASSERT_GT(loud, -40.0F);
    miss(milliseconds(1'000));  // of the eight seconds in which the grid runs on
    // 20 dB in 1.7 s, once a block is overdue.
    const HostTime now = HostClock::now();
    const float later = stage.level_dbfs(now + milliseconds(2'000));
    EXPECT_LT(later, loud - 18.0F);
    EXPECT_NEAR(stage.level_dbfs(now + milliseconds(3'700)), later - 20.0F, 0.1F);
    EXPECT_EQ(stage.level_dbfs(now + std::chrono::seconds(60)), -120.0F) << "no lower";
}

TEST_F(LiveInputTest, after_eight_seconds_without_a_device_there_is_silence) {
    hear(record_at(48'000), milliseconds(4'000));
    miss(milliseconds(7'500));
    EXPECT_FALSE(last_.is_silent);
    miss(milliseconds(3'000));
    EXPECT_TRUE(last_.is_silent);
    EXPECT_NEAR(behind_ms(), 0.0, 12.0);
}

TEST_F(LiveInputTest, a_process_that_was_stopped_skips_what_it_missed) {
    const audio::GeneratedMusic music = record_at(48'000);
    hear(music, milliseconds(6'000));
    now_ += milliseconds(2'500);
    hear(music, milliseconds(4'000));
    EXPECT_NEAR(behind_ms(), 0.0, 12.0);
    EXPECT_EQ(gaps_, 1);
    EXPECT_NEAR(off_beat(), 0.0, 0.1);
    EXPECT_NEAR(static_cast<double>(input_->lost_frames()), 2.5 * 48'000, 600.0);
}

TEST_F(LiveInputTest, a_computer_that_slept_has_a_gap) {
    const audio::GeneratedMusic music = record_at(48'000);
    hear(music, milliseconds(6'000));
    const HopIndex before = hops_;
    input_->note_sleep(milliseconds(3'000));
    hear(music, milliseconds(100));
    EXPECT_NEAR(static_cast<double>(hops_ - before), 310.0, 3.0);
    EXPECT_EQ(gaps_, 1);
}

TEST_F(LiveInputTest, a_rate_that_nobody_can_analyze_is_refused) {
    hear(record_at(48'000), milliseconds(500));
    const auto refused = input_->resume(SampleRate(4'000));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "sample rate is 4000 Hz, must be 8000 to 192000");
}

// What a player says of its song counts as what a file says of itself, from the next block on.
TEST_F(LiveInputTest, a_song_that_a_player_names_begins_with_what_is_told_of_it) {
    hear(record_at(48'000), std::chrono::seconds(2));
    audio::AudioTags tags;
    tags.genre = "Salsa";
    tags.bpm = 96.0;
    const AnalyzerModels told_models = told(installed::models(), tags, {});
    const SongNews begins{SongNews::Kind::begins, {told_models.genre_prior, told_models.told_bpm}};
    ASSERT_TRUE(input_->analysis().tell(begins));
    hear(record_at(48'000), milliseconds(100));
    EXPECT_EQ(gaps_, 1);
    EXPECT_EQ(installed::models().dances->name_of(last_.genre), "salsa");
    EXPECT_TRUE(last_.is_genre_told);
    ASSERT_TRUE(input_->analysis().tell({SongNews::Kind::told, {}}));
    hear(record_at(48'000), milliseconds(100));
    EXPECT_EQ(last_.genre, DanceId::none) << "another player, which says nothing";
    for (int i = 0; i < 16; ++i) {
        EXPECT_TRUE(input_->analysis().tell({SongNews::Kind::jump, {}}));
    }
    EXPECT_FALSE(input_->analysis().tell({SongNews::Kind::pause, {}})) << "bounded";
    hear(record_at(48'000), milliseconds(100));
    EXPECT_TRUE(input_->analysis().tell({SongNews::Kind::pause, {}}));
}

}  // namespace
}  // namespace raks::engine
