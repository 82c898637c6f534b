#include "audio/beat/beat_detector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "base/random.hpp"
#include "models/recurrent_network.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using Frame = NetworkInput::Frame;

/// Two songs, each with loud bands of its own that come and go with its beat.
std::vector<Frame> songs(std::size_t cut, std::size_t hops) {
    const CounterRandom random(3);
    std::vector<Frame> frames;
    std::uint64_t draw = 0;
    for (std::size_t hop = 0; hop < hops; ++hop) {
        const bool is_second = hop >= cut;
        const std::size_t period = is_second ? 43 : 55;
        Frame frame{};
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const bool is_loud = (i % 3 == 0) != is_second;
            const float beat = hop % period < 8 ? 0.5F : 0.0F;
            frame[i] =
                (is_loud ? 0.8F : -0.5F) + beat + 0.2F * static_cast<float>(random.normal(draw++));
        }
        frames.push_back(frame);
    }
    return frames;
}

/// The hops at which a change is told.
std::vector<std::size_t> changes_of(const std::vector<Frame>& frames) {
    SoundChange change;
    std::vector<std::size_t> told;
    for (std::size_t hop = 0; hop < frames.size(); ++hop) {
        const std::span<const float> inputs(frames[hop]);
        if (change.add(inputs.last<SoundChange::kBands>())) {
            told.push_back(hop);
        }
    }
    return told;
}

std::shared_ptr<const BeatNetwork> some_network() {
    auto network = std::make_shared<BeatNetwork>(8, 2, 2);
    const CounterRandom random(7);
    std::uint64_t draw = 0;
    for (float& parameter : network->parameters()) {
        parameter = static_cast<float>(0.4 * random.normal(draw++));
    }
    return network;
}

TEST(SoundChange, tells_a_cut_once_and_soon_and_nothing_in_a_steady_song) {
    constexpr std::size_t kCut = 1'500;
    const auto told = changes_of(songs(kCut, 4'000));
    ASSERT_EQ(told.size(), 1U);
    EXPECT_GE(told.front(), kCut);
    EXPECT_LE(told.front(), kCut + SoundChange::kWindow);
    EXPECT_TRUE(changes_of(songs(5'000, 5'000)).empty());
}

TEST(SoundChange, players_who_pause_or_come_in_are_no_change) {
    auto frames = songs(5'000, 4'000);
    for (std::size_t hop = 1'500; hop < 2'500; ++hop) {
        for (float& value : frames[hop]) {
            value -= 1.0F;
        }
    }
    EXPECT_TRUE(changes_of(frames).empty());
}

TEST(BeatDetector, goes_on_as_if_the_stream_had_begun_a_window_before_the_change) {
    constexpr std::size_t kCut = 1'500;
    const auto frames = songs(kCut, 2'200);
    const auto told = changes_of(frames);
    ASSERT_EQ(told.size(), 1U);
    const std::size_t begin = told.front() + 1 - SoundChange::kWindow;
    const auto network = some_network();
    BeatDetector songs_heard(network);
    BeatNetworkStream whole(network);
    BeatNetworkStream anew(network);
    for (std::size_t hop = 0; hop < frames.size(); ++hop) {
        const BeatEvidence evidence = songs_heard.next(frames[hop]);
        const BeatEvidence of_whole = whole.next(frames[hop]);
        const BeatEvidence of_anew = hop >= begin ? anew.next(frames[hop]) : BeatEvidence{};
        if (hop < told.front()) {
            EXPECT_EQ(evidence.beat, of_whole.beat) << hop;
            EXPECT_EQ(evidence.half, of_whole.half) << hop;
        } else if (hop >= told.front() + 10) {
            EXPECT_EQ(evidence.beat, of_anew.beat) << hop;
            EXPECT_EQ(evidence.downbeat, of_anew.downbeat) << hop;
        }
    }
}

TEST(BeatDetector, after_reset_it_is_as_new_and_nothing_is_allocated) {
    const auto frames = songs(900, 1'400);
    const auto network = some_network();
    BeatDetector listener(network);
    std::vector<float> first;
    first.reserve(frames.size());
    int differ = 0;
    raks::test::RealtimeScope scope;
    for (const Frame& frame : frames) {
        first.push_back(listener.next(frame).beat);
    }
    listener.reset();
    for (std::size_t hop = 0; hop < frames.size(); ++hop) {
        differ += listener.next(frames[hop]).beat != first[hop] ? 1 : 0;
    }
    EXPECT_EQ(differ, 0);
}

}  // namespace
}  // namespace raks::audio
