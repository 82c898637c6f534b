#include "audio/io/file_player.hpp"
#include "audio/io/wav_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audio/io/downmix.hpp"
#include "base/random.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using test::drums;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FilePlayerTest : public test::SoundFilesTest {
 protected:
    std::filesystem::path make_wav(const std::string& name,
                                   double seconds,
                                   int rate,
                                   int channels) {
        const auto music = drums(seconds, rate, channels);
        const auto path = folder_ / name;
        EXPECT_TRUE(write_wav(path, music.samples, channels, music.rate));
        return path;
    }
};

/// The whole file as the player should give it.
std::vector<float> stereo_of(const std::filesystem::path& path) {
    auto reader = open_audio_file(path).value();
    const auto samples = test::read_rest(*reader);
    const auto channels = static_cast<std::size_t>(reader->info().channels);
    std::vector<float> stereo(2 * samples.size() / channels);
    downmix_to_stereo(samples, channels, stereo);
    return stereo;
}

/// One pull of `frames`, waited for; appends what came.
PulledAudio pull_some(FilePlayer& player, std::size_t frames, std::vector<float>& all) {
    player.wait_until_ready(frames);
    std::vector<float> block(2 * frames, 9.0F);
    const PulledAudio pulled = player.pull(block);
    all.insert(
        all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(2 * pulled.frames));
    for (std::size_t i = 2 * pulled.frames; i < block.size(); ++i) {
        EXPECT_EQ(block[i], 0.0F);
    }
    return pulled;
}

TEST_F(FilePlayerTest, a_file_comes_out_whole_in_any_blocks) {
    for (const int channels : {1, 2}) {
        const auto path = make_wav("a.wav", 2.0, 44'100, channels);
        auto player = FilePlayer::start({path}).value();
        const CounterRandom random(5);
        std::vector<float> all;
        std::int64_t position = 0;
        for (std::uint64_t i = 0;; ++i) {
            const PulledAudio pulled = pull_some(*player, 1 + random.below(i, 3000), all);
            if (pulled.is_ended) {
                break;
            }
            EXPECT_EQ(pulled.position, position);
            EXPECT_EQ(pulled.rate, SampleRate(44'100));
            EXPECT_EQ(pulled.is_jump, i == 0);
            position += static_cast<std::int64_t>(pulled.frames);
        }
        EXPECT_EQ(all, stereo_of(path));
        EXPECT_EQ(player->underruns(), 0U);
    }
}

TEST_F(FilePlayerTest, several_files_follow_each_other_each_at_its_own_rate) {
    const auto first = make_wav("a.wav", 0.5, 44'100, 2);
    const auto second = make_wav("b.wav", 0.3, 48'000, 1);
    auto player = FilePlayer::start({first, folder_ / "missing.mp3", second}).value();
    std::vector<float> all;
    std::vector<int> jumps_to;
    for (PulledAudio pulled; !pulled.is_ended;) {
        pulled = pull_some(*player, 700, all);
        if (pulled.is_jump) {
            jumps_to.push_back(pulled.track);
            EXPECT_EQ(pulled.rate.hertz(), pulled.track == 0 ? 44'100 : 48'000);
            EXPECT_EQ(pulled.position, 0);
        }
    }
    auto expected = stereo_of(first);
    const auto rest = stereo_of(second);
    expected.insert(expected.end(), rest.begin(), rest.end());
    EXPECT_EQ(all, expected);
    EXPECT_THAT(jumps_to, ElementsAre(0, 2));
    EXPECT_THAT(player->take_messages(), ElementsAre(HasSubstr("missing.mp3: cannot be opened")));
    EXPECT_EQ(player->underruns(), 0U);
}

TEST_F(FilePlayerTest, after_a_seek_only_the_new_place_is_heard) {
    const auto path = make_wav("a.wav", 4.0, 48'000, 2);
    const auto whole = stereo_of(path);
    auto player = FilePlayer::start({path}).value();
    std::vector<float> before;
    pull_some(*player, 4000, before);
    for (const double seconds : {3.0, 0.5, 2.25, 0.0}) {
        player->seek(0, seconds);
        EXPECT_TRUE(player->is_seeking());
        std::vector<float> after;
        PulledAudio first{};
        while (after.size() < 8000) {
            const PulledAudio pulled = pull_some(*player, 1000, after);
            first = first.frames == 0 ? pulled : first;
        }
        const auto frame = static_cast<std::int64_t>(seconds * 48'000);
        EXPECT_EQ(first.position, frame);
        EXPECT_TRUE(first.is_jump);
        EXPECT_FALSE(player->is_seeking());
        for (std::size_t i = 0; i < after.size(); ++i) {
            ASSERT_EQ(after[i], whole[2 * static_cast<std::size_t>(frame) + i]) << i;
        }
    }
    EXPECT_EQ(player->underruns(), 0U);
}

TEST_F(FilePlayerTest, after_the_end_a_seek_plays_on) {
    const auto path = make_wav("a.wav", 0.2, 48'000, 2);
    auto player = FilePlayer::start({path}).value();
    std::vector<float> all;
    while (!pull_some(*player, 512, all).is_ended) {
    }
    player->seek(0, 0.1);
    std::vector<float> again;
    while (!pull_some(*player, 512, again).is_ended) {
    }
    EXPECT_EQ(again.size(), all.size() / 2);
    player->seek(0, 99.0);  // behind the end
    std::vector<float> nothing;
    while (!pull_some(*player, 512, nothing).is_ended) {
    }
    EXPECT_TRUE(nothing.empty());
    EXPECT_FALSE(player->is_seeking());
}

TEST_F(FilePlayerTest, it_can_start_in_the_middle) {
    const auto path = make_wav("a.wav", 1.0, 48'000, 2);
    auto player = FilePlayer::start({path}, {.start_seconds = 0.75}).value();
    std::vector<float> all;
    EXPECT_EQ(pull_some(*player, 100, all).position, 36'000);
}

TEST_F(FilePlayerTest, too_little_decoded_is_counted_and_padded_with_zeros) {
    const auto path = make_wav("a.wav", 1.0, 48'000, 2);
    auto player = FilePlayer::start({path}, {.ahead_frames = 1024}).value();
    player->wait_until_ready(1024);
    player->stop();
    std::vector<float> block(2 * 3000, 9.0F);
    const PulledAudio pulled = player->pull(block);
    EXPECT_EQ(pulled.frames, 1024U);
    EXPECT_EQ(block[2 * 1024], 0.0F);
    EXPECT_EQ(player->underruns(), 1U);
    EXPECT_FALSE(pulled.is_ended);
}

TEST_F(FilePlayerTest, pull_allocates_locks_and_waits_for_nothing) {
    const auto path = make_wav("a.wav", 3.0, 48'000, 2);
    auto player = FilePlayer::start({path, path}).value();
    std::vector<float> block(2 * 256);
    bool is_ended = false;
    for (int i = 0; !is_ended; ++i) {
        if (i == 100) {
            player->seek(0, 2.5);
        }
        player->wait_until_ready(256);
        raks::test::RealtimeScope scope;
        is_ended = player->pull(block).is_ended;
        const auto counts = scope.stop();
        ASSERT_TRUE(counts.allocations + counts.frees + counts.locks + counts.throws == 0)
            << counts.describe();
    }
}

TEST_F(FilePlayerTest, a_first_file_that_cannot_be_played_is_an_error) {
    EXPECT_EQ(FilePlayer::start({}).error().message, "no file to play");
    EXPECT_THAT(FilePlayer::start({folder_ / "none.ogg"}).error().message,
                HasSubstr("none.ogg: cannot be opened"));
}

}  // namespace
}  // namespace raks::audio
