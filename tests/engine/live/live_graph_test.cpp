// The graph on its own clock, without a device.
#include "engine/live/live_graph.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

class GraphOnItsOwnClock : public ::testing::Test {
 protected:
    void SetUp() override {
        audio::MusicPlan plan;
        plan.seconds = 60.0;
        const auto music = audio::generate(plan);
        ASSERT_TRUE(music) << music.error().message;
        const auto path = folder_ / "music.wav";
        ASSERT_TRUE(audio::write_wav(path, music->samples, music->channels, music->rate));
        repertoire_ = motion::Repertoire::of_one(installed::library_of("salsa"));
        auto player = audio::FilePlayer::start({path});
        ASSERT_TRUE(player) << player.error().message;
        auto graph = LiveGraph::play(std::move(*player),
                                     std::nullopt,
                                     {.models = installed::models(),
                                      .cast = cast(motion::Formation::solo),
                                      .latency_offset = std::chrono::milliseconds(70),
                                      .readers = {reader_.get()}});
        ASSERT_TRUE(graph) << graph.error().message;
        graph_ = std::move(*graph);
    }
    [[nodiscard]] Cast cast(motion::Formation formation) const {
        return motion::members_of(formation, {{motion::mannequin_skeleton(), repertoire_}}, 1);
    }
    static void wait_until(const std::function<bool()>& is_so) {
        while (!is_so()) {
            std::this_thread::yield();
        }
    }
    void pause() {
        wait_until([&] { return graph_->analysis().clock().is_running; });
        graph_->playback()->set_paused(true);
        wait_until([&] { return !graph_->analysis().clock().is_running; });
    }

    test::TemporaryFolder folder_;
    std::shared_ptr<const motion::Repertoire> repertoire_;
    std::unique_ptr<StageChannel> reader_ = std::make_unique<StageChannel>();
    std::unique_ptr<LiveGraph> graph_;
};

TEST_F(GraphOnItsOwnClock, a_registered_reader_sees_what_the_main_thread_sees) {
    wait_until([&] { return graph_->stage().music.hop >= 20; });
    wait_until([&] { return reader_->read().music.hop >= 20; });
    EXPECT_EQ(reader_->read().dancers, 1U);
}

TEST_F(GraphOnItsOwnClock, a_reader_on_another_thread_is_told_every_hop_and_when_it_is_heard) {
    graph_->set_latency_offset(std::chrono::milliseconds(40));
    static_cast<void>(graph_->watch(HostClock::now()));
    FeedHop told;
    const MusicState& state = told.music;
    for (HopIndex hop = 0; hop < 30; ++hop) {
        wait_until([&] { return graph_->feed()->take(told); });
        EXPECT_EQ(state.hop, hop);
    }
    pause();
    const HostTime here = graph_->heard_at(state.time);
    EXPECT_EQ(graph_->feed()->heard_line().heard_at(state.time), here);
    const std::shared_ptr<MusicFeed> feed = graph_->feed();
    graph_.reset();
    EXPECT_EQ(feed->heard_line().heard_at(state.time), here) << "it outlives the graph";
}

TEST_F(GraphOnItsOwnClock, other_dancers_take_over_while_it_plays) {
    wait_until([&] { return graph_->stage().music.hop >= 20; });
    ASSERT_TRUE(graph_->replace_dancers(cast(motion::Formation::unison)));
    wait_until([&] { return graph_->stage().dancers == 3; });
    const StageState& stage = graph_->stage();
    EXPECT_GE(stage.tracks[2].oldest_final(), 20);
    const auto refused = graph_->replace_dancers(Cast{});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "an ensemble has 1 to 32 dancers");
}

TEST_F(GraphOnItsOwnClock, the_latency_offset_shifts_what_is_shown_at_once) {
    using std::chrono::milliseconds;
    EXPECT_EQ(graph_->latency_offset(), Nanos(0)) << "there is no device to be late";
    pause();
    const HostTime seen = HostClock::now();
    const StreamTime before = graph_->moment_at(seen);
    graph_->set_latency_offset(milliseconds(25));
    EXPECT_EQ(graph_->moment_at(seen), before - milliseconds(25));
    EXPECT_EQ(graph_->heard_after(), milliseconds(25));
    graph_->set_latency_offset(milliseconds(-5));
    EXPECT_EQ(graph_->moment_at(seen), before + milliseconds(5));
}

TEST_F(GraphOnItsOwnClock, the_moment_seen_is_the_one_that_is_heard) {
    wait_until([&] { return graph_->analysis().clock().is_running; });
    graph_->set_latency_offset(std::chrono::milliseconds(300));
    const HostTime seen = HostClock::now();
    double difference = 1.0;
    double rate = 1.0;
    // Every block corrects the clock: both must be asked of the same line. One of them counts the
    // offset in stream time, the other in host time: they differ by the clock's rate.
    wait_until([&] {
        const HostTime line = graph_->analysis().clock().host_anchor;
        rate = graph_->analysis().clock().stream_per_host;
        difference = to_seconds(graph_->heard_at(graph_->moment_at(seen)) - seen);
        return graph_->analysis().clock().host_anchor == line;
    });
    EXPECT_NEAR(difference, 0.0, 1.1 * 0.3 * std::abs(rate - 1.0) + 1e-6);
}

TEST_F(GraphOnItsOwnClock, a_dance_that_is_heard_a_second_later_is_danced_only_when_it_is_due) {
    pause();
    graph_->set_latency_offset(std::chrono::seconds(1));
    static_cast<void>(graph_->watch(HostClock::now()));
    graph_->playback()->set_paused(false);
    const std::int64_t danced = graph_->stage().music.hop;
    wait_until([&] { return graph_->stage().music.hop >= danced + 30; });
    const StageState& stage = graph_->stage();
    const StreamTime moment = graph_->moment_at(HostClock::now());
    // 0.3 s ahead of what is heard, and never further back than a track reaches.
    EXPECT_LT(to_seconds(stage.music.time - moment), 0.45);
    EXPECT_GT(to_seconds(graph_->analysis().taken_until() - stage.music.time), 0.5);
    EXPECT_LE(time_of_hop(stage.track().oldest_final()), std::max(moment, StreamTime{}));
}

}  // namespace
}  // namespace raks::engine
