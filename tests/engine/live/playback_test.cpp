#include "engine/live/playback.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

constexpr int kHertz = 48'000;
constexpr std::size_t kFileSeconds = 4;
constexpr std::size_t kBlock = 1000;  // frames; no divisor of what is pulled at a time

/// A file whose every sample says which second it is in: 0.1, 0.2, 0.3, 0.4.
class PlaybackTest : public ::testing::Test {
 protected:
    void SetUp() override {
        std::vector<float> samples(kFileSeconds * kHertz);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const auto second = i / kHertz;
            samples[i] = 0.1F * static_cast<float>(second + 1);
        }
        ASSERT_TRUE(audio::write_wav(path_, samples, 1, SampleRate(kHertz)));
        auto player = audio::FilePlayer::start({path_});
        ASSERT_TRUE(player) << player.error().message;
        auto made = Playback::create(std::move(*player), installed::models());
        ASSERT_TRUE(made) << made.error().message;
        playback_ = std::move(*made);
        ASSERT_TRUE(playback_->prepare(SampleRate(kHertz)));
    }

    /// One callback when the decoder is ready; the left channel of what it gave.
    std::vector<float> call(std::size_t frames = kBlock) {
        playback_->player().wait_until_ready(frames);
        std::vector<float> block(2 * frames, 9.0F);
        playback_->on_output(block, 2, {0, HostClock::now(), false});
        MusicState state;
        while (playback_->analysis().states().pop(state)) {
        }
        std::vector<float> left;
        for (std::size_t i = 0; i < block.size(); i += 2) {
            left.push_back(block[i]);
        }
        return left;
    }
    /// What is played next: after a seek the callbacks that only drop what was decoded ahead are
    /// passed over. The last sample of the first block that is full.
    float next_sound() {
        for (int calls = 0; calls < 100; ++calls) {
            if (const float last = call().back(); last != 0.0F) {
                return last;
            }
        }
        return 0.0F;
    }
    /// Callbacks until the end; how many frames were not silent.
    std::size_t play_out() {
        std::size_t heard = 0;
        for (std::size_t calls = 0; !playback_->is_finished(); ++calls) {
            if (calls > 2 * kFileSeconds * kHertz / kBlock) {
                ADD_FAILURE() << "plays on and on";
                break;
            }
            const std::vector<float> left = call();
            heard += static_cast<std::size_t>(
                std::count_if(left.begin(), left.end(), [](float x) { return x != 0.0F; }));
        }
        return heard;
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "seconds.wav";
    std::unique_ptr<Playback> playback_;
};

/// What was analyzed already when the seek came is played.
constexpr std::size_t kPulled = 256;

/// 16 bits.
constexpr float kStep = 1.0F / 32'768.0F;

TEST_F(PlaybackTest, plays_every_frame_of_the_file_and_is_finished) {
    EXPECT_EQ(play_out(), kFileSeconds * kHertz);
    EXPECT_EQ(playback_->analysis().taken_until(), StreamTime(std::chrono::seconds(kFileSeconds)));
}

TEST_F(PlaybackTest, a_seek_goes_on_at_the_frame_and_stream_time_does_not_turn_back) {
    call();
    const StreamTime before = playback_->analysis().taken_until();
    playback_->seek(2.5);
    EXPECT_EQ(playback_->position_seconds(), 2.5);
    EXPECT_NEAR(next_sound(), 0.3F, kStep);
    EXPECT_NEAR(playback_->position_seconds(), 2.5, 0.03);
    const StreamTime between = playback_->analysis().taken_until();
    EXPECT_GT(between, before);
    playback_->seek(-10.0);
    EXPECT_EQ(playback_->position_seconds(), 0.0);
    EXPECT_NEAR(next_sound(), 0.1F, kStep);
    EXPECT_GT(playback_->analysis().taken_until(), between);
}

TEST_F(PlaybackTest, seeks_in_a_pause_add_up_and_are_heard_after_it) {
    call();
    playback_->set_paused(true);
    call();
    call();
    for (int i = 0; i < 3; ++i) {
        playback_->seek(playback_->position_seconds() + 1.0);
        call();
    }
    EXPECT_NEAR(playback_->position_seconds(), 3.0, 0.1);
    playback_->set_paused(false);
    EXPECT_NEAR(next_sound(), 0.4F, kStep);
}

TEST_F(PlaybackTest, a_seek_behind_the_end_finishes) {
    call();
    playback_->seek(100.0);
    EXPECT_LT(play_out(), kPulled);
    EXPECT_TRUE(playback_->is_finished());
}

TEST_F(PlaybackTest, a_seek_back_in_the_last_block_plays_on) {
    playback_->seek(static_cast<double>(kFileSeconds) - 0.01);
    const std::vector<float> last = call();
    EXPECT_EQ(last.back(), 0.0F) << "the file ends inside this block";
    ASSERT_FALSE(playback_->is_finished());
    playback_->seek(1.0);
    // Not waited for: at first nothing is decoded yet.
    std::vector<float> block(2 * kBlock);
    playback_->on_output(block, 2, {0, HostClock::now(), false});
    EXPECT_FALSE(playback_->is_finished());
    EXPECT_GE(play_out(), 3 * kHertz - kBlock);
}

TEST_F(PlaybackTest, plays_no_frame_behind_the_end_that_was_set) {
    playback_->set_end(1.2345);
    EXPECT_EQ(play_out(), 59'256U);
    EXPECT_EQ(playback_->analysis().taken_until(), SampleRate(kHertz).time_of(59'256));
}

TEST_F(PlaybackTest, a_seek_behind_the_end_that_was_set_finishes) {
    playback_->set_end(2.0);
    call();
    playback_->seek(3.0);
    EXPECT_LT(play_out(), kPulled);
}

TEST_F(PlaybackTest, another_device_goes_on_where_the_one_before_was_lost) {
    call();
    const StreamTime before = playback_->analysis().taken_until();
    playback_->stop_clock();
    EXPECT_FALSE(playback_->analysis().clock().is_running);
    ASSERT_TRUE(playback_->prepare(SampleRate(96'000)));
    const std::vector<float> first = call(2 * kBlock);
    EXPECT_LT(first.front(), 0.01F) << "fades in";
    EXPECT_NEAR(first.back(), 0.1F, 0.01F);
    EXPECT_TRUE(playback_->analysis().clock().is_running);
    EXPECT_NEAR(to_seconds(playback_->analysis().taken_until() - before), 1000.0 / 48'000, 0.008);
}

TEST_F(PlaybackTest, an_end_behind_the_file_changes_nothing) {
    playback_->set_end(1000.0);
    EXPECT_EQ(play_out(), kFileSeconds * kHertz);
}

TEST_F(PlaybackTest, what_is_paused_while_it_is_held_back_gives_nothing_when_it_is_let_go) {
    playback_->hold_back();
    static_cast<void>(call());
    playback_->set_paused(true);
    static_cast<void>(call());
    playback_->let_go();
    const std::vector<float> left = call();
    EXPECT_EQ(std::count(left.begin(), left.end(), 0.0F), static_cast<std::ptrdiff_t>(left.size()));
    EXPECT_EQ(playback_->analysis().taken_until(), StreamTime{});
    playback_->set_paused(false);
    EXPECT_NEAR(call().back(), 0.1F, 1e-4F) << "from the file's first frame on";
}

TEST_F(PlaybackTest, what_is_held_back_begins_whole_when_it_is_let_go) {
    playback_->hold_back();
    for (int i = 0; i < 3; ++i) {
        for (const float sample : call()) {
            ASSERT_EQ(sample, 0.0F);
        }
    }
    EXPECT_EQ(playback_->analysis().taken_until(), StreamTime{});
    EXPECT_FALSE(playback_->is_paused()) << "nobody asked for a pause";
    playback_->let_go();
    EXPECT_NEAR(call().front(), 0.1F, 1e-3F) << "the file's first sample, without a fade";
}

}  // namespace
}  // namespace raks::engine
