// The live graph and the offline driver wire the same parts: for the same file both must publish
// the same poses, hop by hop.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/random.hpp"
#include "engine/live/analysis_stage.hpp"
#include "engine/live/live_input.hpp"
#include "engine/live/motion_stage.hpp"
#include "engine/live/playback.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/offline/song_planner.hpp"
#include "engine/setup/dancers.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/realtime_guard.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

constexpr int kSeconds = 14;

class LiveEqualsOffline : public ::testing::Test {
 protected:
    void SetUp() override {
        audio::MusicPlan plan;
        plan.style = audio::Style::montuno;
        plan.tempo = {{0.0, 176.0}, {9.0, 176.0}, {9.0, 190.0}};
        plan.seconds = kSeconds;
        plan.rate = SampleRate(44'100);
        plan.silences = {{11.0, 13.0}};
        const auto music = audio::generate(plan);
        ASSERT_TRUE(music) << music.error().message;
        ASSERT_TRUE(audio::write_wav(path_, music->samples, music->channels, music->rate));
        auto library = installed::library_of("salsa");
        library_ = library;
    }

    [[nodiscard]] motion::Dancer dancer() const {
        motion::Dancer dancer;
        EXPECT_TRUE(dancer.prepare(library_, motion::mannequin_skeleton(), 1));
        return dancer;
    }
    [[nodiscard]] std::unique_ptr<Playback> playback(SampleRate device_rate) const {
        auto player = audio::FilePlayer::start({path_});
        EXPECT_TRUE(player);
        auto made = Playback::create(std::move(*player), installed::models());
        EXPECT_TRUE(made);
        EXPECT_TRUE((*made)->prepare(device_rate));
        return std::move(*made);
    }

    /// `plan`: of the song, or null.
    [[nodiscard]] std::vector<motion::Pose> danced_live(const PlanOfSong& plan) const;

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "music.wav";
    std::shared_ptr<const motion::DanceLibrary> library_;
};

class Record final : public OfflineDriver::Sink {
 public:
    Record() { poses.reserve(100 * kSeconds + 100); }  // called on a real-time path
    void on_hop(const PerformedHop& hop) override {
        poses.push_back(hop.track.at_hop(hop.music.hop));
    }
    std::vector<motion::Pose> poses;
};

/// `plan`: of the song, or null.
std::vector<motion::Pose> danced_offline(const std::filesystem::path& path,
                                         const std::shared_ptr<const motion::DanceLibrary>& library,
                                         const PlanOfSong& plan) {
    auto source = MusicSource::open(path);
    EXPECT_TRUE(source);
    const Cast cast = cast_of(library, motion::mannequin_skeleton(), 1);
    auto driver = plan ? OfflineDriver::create(source->rate(), plan, StreamTime{}, cast)
                       : OfflineDriver::create(source->rate(), installed::models(), cast);
    EXPECT_TRUE(driver);
    Record record;
    for (auto block = source->next(); !block.mono.empty(); block = source->next()) {
        driver->feed(block.mono, record);
    }
    return record.poses;
}

/// Calls the loudspeaker's callback with blocks of any size until the file is out; waits for
/// decoder and motion thread, never for the clock.
void play_out(Playback& playback) {
    const CounterRandom random(4);
    std::vector<float> block(2 * 2000);
    std::int64_t frame = 0;
    for (std::uint64_t i = 0; !playback.is_finished(); ++i) {
        playback.player().wait_until_ready(4096);
        const std::size_t frames = 1 + random.below(i, 2000);
        playback.on_output(std::span(block).first(2 * frames), 2, {frame, HostClock::now(), false});
        frame += static_cast<std::int64_t>(frames);
        while (playback.analysis().states().size() > AnalysisStage::kQueuedStates / 2) {
            std::this_thread::yield();
        }
    }
    while (playback.analysis().states().size() > 0) {
        std::this_thread::yield();
    }
}

std::vector<motion::Pose> LiveEqualsOffline::danced_live(const PlanOfSong& plan) const {
    EventQueue<DancedHop> record(4096);
    {
        const auto loudspeaker = playback(SampleRate(48'000));
        if (plan) {
            loudspeaker->analysis().planned().set_plan(plan, PlannedStates::Beginning::now);
        }
        MotionThread motion(dancer(), {loudspeaker->analysis().states(), {}, &record});
        play_out(*loudspeaker);
        // All but the hops that need sound after them.
        while (motion.danced_hops() < kSeconds * 100 - 5) {
            std::this_thread::yield();
        }
        EXPECT_EQ(loudspeaker->analysis().states().dropped(), 0U);
    }
    std::vector<motion::Pose> live;
    DancedHop hop;
    while (record.pop(hop)) {
        EXPECT_EQ(hop.hop, static_cast<HopIndex>(live.size()));
        live.push_back(hop.pose);
    }
    return live;
}

/// Of a song that is known, the last hops are danced only offline: live they need sound after them.
void expect_same_poses(const std::vector<motion::Pose>& live,
                       const std::vector<motion::Pose>& offline) {
    ASSERT_GT(live.size(), static_cast<std::size_t>(kSeconds * 100 - 10));
    ASSERT_LE(live.size(), offline.size());
    for (std::size_t i = 0; i < live.size(); ++i) {
        ASSERT_EQ(live[i].hips_position, offline[i].hips_position) << i;
        ASSERT_EQ(live[i].local_rotations, offline[i].local_rotations) << i;
    }
}

TEST_F(LiveEqualsOffline, hop_by_hop_the_same_poses) {
    const std::vector<motion::Pose> offline = danced_offline(path_, library_, nullptr);
    const std::vector<motion::Pose> live = danced_live(nullptr);
    EXPECT_EQ(live.size(), offline.size());
    expect_same_poses(live, offline);
}

TEST_F(LiveEqualsOffline, hop_by_hop_the_same_poses_to_a_song_that_is_known) {
    const auto plan = plan_song(path_, installed::models());
    ASSERT_TRUE(plan) << plan.error().message;
    const std::vector<motion::Pose> known = danced_offline(path_, library_, *plan);
    expect_same_poses(danced_live(*plan), known);
    // At once, and not when the stream's analysis is sure.
    EXPECT_NE(known[200].hips_position,
              danced_offline(path_, library_, nullptr)[200].hips_position);
}

TEST_F(LiveEqualsOffline, a_plan_keeps_the_real_time_rules_and_a_seek_stays_on_its_downbeats) {
    const auto plan = plan_song(path_, installed::models());
    ASSERT_TRUE(plan) << plan.error().message;
    const auto loudspeaker = playback(SampleRate(48'000));
    loudspeaker->analysis().planned().set_plan(*plan, PlannedStates::Beginning::now);
    std::vector<float> block(2 * 256);
    std::vector<MusicState> states;
    for (std::int64_t frame = 0; !loudspeaker->is_finished(); frame += 256) {
        loudspeaker->player().wait_until_ready(4096);
        test::RealtimeScope scope;
        loudspeaker->on_output(block, 2, {frame, HostClock::now(), false});
        ASSERT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        for (MusicState state; loudspeaker->analysis().states().pop(state);) {
            ASSERT_TRUE(state.ahead.is_known);
            states.push_back(state);
        }
        if (frame == 256 * 800) {
            loudspeaker->seek(1.7);
        }
    }
    int seeks = 0;
    for (std::size_t i = 1; i < states.size(); ++i) {
        const BeatGrid& before = states[i - 1].grid;
        const BeatGrid& now = states[i].grid;
        const StreamTime time = states[i].time;
        // Half a bar at most, and what was a downbeat is one.
        ASSERT_LT(std::abs((before.beats_at(time) - now.beats_at(time)).count()), 2.1) << i;
        ASSERT_NEAR(now.bar_position(before.bar_origin), 0.0, 1e-6) << i;
        seeks += states[i].ahead.begins != states[i - 1].ahead.begins ? 1 : 0;
    }
    EXPECT_EQ(seeks, 1) << "the song is at another place from there on";
}

TEST_F(LiveEqualsOffline, a_plan_that_comes_later_is_taken_over_on_a_bar_line) {
    const auto plan = plan_song(path_, installed::models());
    ASSERT_TRUE(plan) << plan.error().message;
    ASSERT_FALSE((*plan)->joins.empty());
    const auto loudspeaker = playback(SampleRate(44'100));
    loudspeaker->analysis().planned().set_plan(*plan, PlannedStates::Beginning::on_bar_line);
    std::vector<float> block(2 * 1024);
    std::optional<StreamTime> taken_over;
    while (!loudspeaker->is_finished()) {
        loudspeaker->player().wait_until_ready(4096);
        loudspeaker->on_output(block, 2, {0, HostClock::now(), false});
        for (MusicState state; loudspeaker->analysis().states().pop(state);) {
            if (state.ahead.is_known && !taken_over) {
                taken_over = state.time;
            }
            EXPECT_EQ(state.ahead.is_known, taken_over.has_value());
        }
    }
    ASSERT_TRUE(taken_over);
    EXPECT_LT(std::abs(to_seconds(*taken_over - (*plan)->joins.front())), 0.011);
}

TEST_F(LiveEqualsOffline, the_loudspeakers_callback_keeps_the_real_time_rules) {
    const auto loudspeaker = playback(SampleRate(48'000));
    std::vector<float> block(2 * 256);
    std::int64_t frame = 0;
    MusicState state;
    while (!loudspeaker->is_finished()) {
        loudspeaker->player().wait_until_ready(4096);
        test::RealtimeScope scope;
        loudspeaker->on_output(block, 2, {frame, HostClock::now(), false});
        ASSERT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        frame += 256;
        while (loudspeaker->analysis().states().pop(state)) {
        }
        if (frame == 256 * 200) {
            loudspeaker->set_paused(true);
        } else if (frame == 256 * 260) {
            loudspeaker->set_paused(false);
        } else if (frame == 256 * 400) {
            loudspeaker->set_volume(0.3F);
        }
    }
    EXPECT_EQ(loudspeaker->player().underruns(), 0U);
}

TEST_F(LiveEqualsOffline, a_pause_is_silent_and_stream_time_stands_still) {
    const auto loudspeaker = playback(SampleRate(44'100));
    std::vector<float> block(2 * 1024);
    const auto call = [&] {
        loudspeaker->player().wait_until_ready(4096);
        loudspeaker->on_output(block, 2, {0, HostClock::now(), false});
    };
    for (int i = 0; i < 50; ++i) {
        call();
    }
    loudspeaker->set_paused(true);
    call();
    call();
    const StreamTime stopped = loudspeaker->analysis().taken_until();
    call();
    EXPECT_EQ(loudspeaker->analysis().taken_until(), stopped);
    for (const float sample : block) {
        ASSERT_EQ(sample, 0.0F);
    }
    EXPECT_FALSE(loudspeaker->analysis().clock().is_running);
    loudspeaker->set_paused(false);
    call();
    EXPECT_GT(loudspeaker->analysis().taken_until(), stopped);
}

TEST(LiveInput, the_inputs_callback_keeps_the_real_time_rules) {
    auto listening = LiveInput::create(SampleRate(48'000), installed::models());
    ASSERT_TRUE(listening) << listening.error().message;
    const CounterRandom random(8);
    for (const int channels : {1, 2, 8}) {
        std::vector<float> block(static_cast<std::size_t>(256 * channels));
        for (std::uint64_t i = 0; i < 400; ++i) {
            for (std::size_t k = 0; k < block.size(); ++k) {
                block[k] = static_cast<float>(0.1 * random.normal(1000 * i + k));
            }
            test::RealtimeScope scope;
            (*listening)
                ->on_input(block,
                           channels,
                           {static_cast<std::int64_t>(256 * i), HostClock::now(), i % 90 == 7});
            ASSERT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
            MusicState state;
            while ((*listening)->analysis().states().pop(state)) {
            }
        }
    }
}

}  // namespace
}  // namespace raks::engine
