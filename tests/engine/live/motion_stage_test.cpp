#include "engine/live/motion_stage.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <utility>

#include "tests/engine/installed.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

/// A state whose fields are all made from its hop: a torn stage shows.
MusicState state_of(HopIndex hop) {
    MusicState state;
    state.hop = hop;
    state.time = time_of_hop(hop);
    state.level_dbfs = static_cast<float>(-hop % 97);
    state.loudness_lufs = static_cast<float>(-hop % 89);
    return state;
}

bool is_whole(const StageState& stage) {
    const MusicState expected = state_of(stage.music.hop);
    return stage.music.time == expected.time && stage.music.level_dbfs == expected.level_dbfs &&
           stage.music.loudness_lufs == expected.loudness_lufs;
}

TEST(MotionStage, publishes_the_newest_stage_to_every_reader) {
    EventQueue<MusicState> states(8);
    const auto first = std::make_unique<StageChannel>();
    const auto second = std::make_unique<StageChannel>();
    MotionStage motion(motion::Ensemble(), {states, {first.get(), second.get()}});
    ASSERT_TRUE(states.push(state_of(0)));
    motion.tick();
    EXPECT_EQ(first->read().music.hop, 0);
    ASSERT_TRUE(states.push(state_of(1)) && states.push(state_of(2)));
    motion.tick();
    ASSERT_TRUE(states.push(state_of(3)));
    motion.tick();
    EXPECT_EQ(second->read().music.hop, 3) << "a reader who looks seldom sees the newest, too";
    EXPECT_EQ(first->read().music.hop, 3);
    bool is_new = true;
    EXPECT_EQ(first->read(&is_new).music.hop, 3);
    EXPECT_FALSE(is_new);
}

TEST(MotionStage, shows_the_stage_to_a_feed_that_was_asked_for_it) {
    EventQueue<MusicState> states(8);
    MusicFeed feed;
    MotionStage motion(motion::Ensemble(), {.states = states, .readers = {}, .feed = &feed});
    ASSERT_TRUE(states.push(state_of(0)));
    motion.tick();
    EXPECT_EQ(feed.stage(), nullptr) << "nobody asked";
    feed.ask_for_stage();
    EXPECT_EQ(feed.stage(), nullptr) << "nobody has danced since";
    ASSERT_TRUE(states.push(state_of(1)));
    test::RealtimeScope scope;
    motion.tick();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    feed.ask_for_stage();
    ASSERT_NE(feed.stage(), nullptr) << "who asks twice loses nothing";
    EXPECT_EQ(feed.stage()->music.hop, 1);
    EXPECT_TRUE(is_whole(*feed.stage()));
}

TEST(MotionStage, shows_how_the_dancer_stands_before_the_music_begins) {
    EventQueue<MusicState> states(8);
    const auto channel = std::make_unique<StageChannel>();
    motion::Ensemble dancers;
    const Cast cast = installed::solo("salsa");
    ASSERT_TRUE(dancers.prepare(cast));
    MotionStage motion(std::move(dancers), {states, {channel.get()}});
    const motion::Pose before = channel->read().track().at(StreamTime{});
    ASSERT_TRUE(states.push(state_of(0)));
    motion.tick();
    const motion::Pose first = channel->read().track().at(StreamTime{});
    EXPECT_GT(before.hips_position.y, 0.5F) << "not in the floor";
    EXPECT_LT(glm::distance(before.hips_position, first.hips_position), 0.01F);
}

TEST(MotionStage, holds_back_the_newest_states_until_they_are_due) {
    EventQueue<MusicState> states(16);
    const auto reader = std::make_unique<StageChannel>();
    MotionStage motion(motion::Ensemble(), {states, {reader.get()}});
    for (HopIndex hop = 0; hop < 8; ++hop) {
        ASSERT_TRUE(states.push(state_of(hop)));
    }
    motion.hold_back(5);
    motion.tick();
    EXPECT_EQ(reader->read().music.hop, 2);
    motion.hold_back(1);
    motion.tick();
    EXPECT_EQ(reader->read().music.hop, 6) << "none is skipped: each was danced in order";
    EXPECT_EQ(motion.danced_hops(), 7);
}

/// Reads until the stage of hop `last` has come.
class ReadingThread {
 public:
    ReadingThread(StageChannel& channel, HopIndex last)
        : thread_([this, &channel, last] {
              while (newest_ < last) {
                  look(channel.read());
              }
          }) {}
    /// Whether every stage was whole and none older than the one before.
    [[nodiscard]] bool was_right_at_the_end() {
        thread_.join();
        return is_right_;
    }

 private:
    void look(const StageState& stage) {
        if (stage.published_at_ns == 0) {  // before the first
            std::this_thread::yield();
            return;
        }
        is_right_ = is_right_ && is_whole(stage) && stage.music.hop >= newest_;
        newest_ = stage.music.hop;
    }

    HopIndex newest_ = 0;
    bool is_right_ = true;
    std::thread thread_;  // last: it uses the others
};

TEST(MotionStage, readers_on_threads_of_their_own_do_not_disturb_one_another) {
    constexpr HopIndex kLast = 2'000;
    EventQueue<MusicState> states(64);
    const auto first = std::make_unique<StageChannel>();
    const auto second = std::make_unique<StageChannel>();
    MotionStage motion(motion::Ensemble(), {states, {first.get(), second.get()}});
    ReadingThread one(*first, kLast);
    ReadingThread two(*second, kLast);
    for (HopIndex hop = 0; hop <= kLast; ++hop) {
        EXPECT_TRUE(states.push(state_of(hop)));
        motion.tick();
    }
    EXPECT_TRUE(one.was_right_at_the_end());
    EXPECT_TRUE(two.was_right_at_the_end());
}

/// Solo and unison of the same dance, and a stage on which one of them dances.
class ReplacedDancers : public ::testing::Test {
 protected:
    static motion::Ensemble ensemble(motion::Formation formation) {
        static const auto repertoire = motion::Repertoire::of_one(installed::library_of("salsa"));
        motion::Ensemble result;
        EXPECT_TRUE(result.prepare(
            motion::members_of(formation, {{motion::mannequin_skeleton(), repertoire}}, 1)));
        return result;
    }
    void dance(HopIndex hops) {
        for (HopIndex end = hop_ + hops; hop_ < end; ++hop_) {
            ASSERT_TRUE(states_.push(state_of(hop_)));
            motion_.tick();
        }
    }

    EventQueue<MusicState> states_{8};
    std::unique_ptr<StageChannel> reader_ = std::make_unique<StageChannel>();
    MotionStage motion_{ensemble(motion::Formation::solo), {states_, {reader_.get()}}};
    HopIndex hop_ = 0;
};

TEST_F(ReplacedDancers, dance_from_the_next_tick_on_and_go_again) {
    ASSERT_NO_FATAL_FAILURE(dance(100));
    EXPECT_EQ(reader_->read().dancers, 1U);
    ASSERT_TRUE(motion_.replace(ensemble(motion::Formation::unison)));
    ASSERT_NO_FATAL_FAILURE(dance(1));
    const StageState& three = reader_->read();
    EXPECT_EQ(three.dancers, 3U);
    for (std::size_t i = 0; i < three.dancers; ++i) {
        EXPECT_EQ(three.tracks[i].oldest_final(), 100) << i;
        EXPECT_EQ(three.tracks[i].newest_final(), 100) << i;
    }
    ASSERT_NO_FATAL_FAILURE(dance(50));
    ASSERT_TRUE(motion_.replace(ensemble(motion::Formation::solo)));
    ASSERT_NO_FATAL_FAILURE(dance(20));
    EXPECT_EQ(reader_->read().dancers, 1U);
    EXPECT_EQ(reader_->read().track().newest_final(), 170);
}

TEST_F(ReplacedDancers, who_go_on_keep_the_tracks) {
    ASSERT_NO_FATAL_FAILURE(dance(100));
    const motion::Pose last = reader_->read().track().at_hop(99);
    ASSERT_TRUE(motion_.replace(ensemble(motion::Formation::solo), MotionStage::Entry::onward));
    ASSERT_TRUE(states_.push(state_of(hop_)));
    test::RealtimeScope scope;
    motion_.tick();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    const StageState& stage = reader_->read();
    EXPECT_LT(stage.track().oldest_final(), 99);
    EXPECT_EQ(stage.track().newest_final(), 100);
    EXPECT_LT(glm::distance(stage.track().at_hop(100).hips_position, last.hips_position), 0.01F);
}

TEST_F(ReplacedDancers, come_without_allocation_and_the_others_leave_without_being_freed) {
    ASSERT_NO_FATAL_FAILURE(dance(10));
    ASSERT_TRUE(motion_.replace(ensemble(motion::Formation::unison)));
    ASSERT_TRUE(motion_.replace(ensemble(motion::Formation::canon)));
    ASSERT_TRUE(states_.push(state_of(hop_)));
    test::RealtimeScope scope;
    motion_.tick();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(reader_->read().dancers, 3U);
}

TEST_F(ReplacedDancers, are_refused_when_too_many_wait) {
    int taken = 0;
    while (motion_.replace(motion::Ensemble())) {
        ASSERT_LT(++taken, 1000);
    }
    EXPECT_EQ(taken, 64);
    EXPECT_FALSE(motion_.command({}));
    motion_.tick();
    EXPECT_TRUE(motion_.command({}));
}

}  // namespace
}  // namespace raks::engine
