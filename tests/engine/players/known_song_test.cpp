#include "engine/players/known_song.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

constexpr SampleRate kHeardRate(48'000);
constexpr std::int64_t kHeardBlock = 480;

class KnownSongTest : public ::testing::Test {
 protected:
    KnownSongTest() {
        audio::MusicPlan plan;
        plan.style = audio::Style::montuno;
        plan.tempo = {{0.0, 180.0}};
        plan.seconds = 30.0;
        plan.rate = kHeardRate;
        plan.channels = 1;
        const auto music = audio::generate(plan);
        EXPECT_TRUE(music);
        song_ = music->samples;
        EXPECT_TRUE(audio::write_wav(file_, song_, 1, kHeardRate));
    }
    /// Hears the sound from `from` seconds on, again and again, until something is news.
    KnownSong::Heard hear(const std::vector<float>& sound, double from) {
        const auto length = static_cast<std::int64_t>(sound.size());
        const std::int64_t first = std::lround(from * kHeardRate.hertz());
        std::int64_t at = first;
        for (;;) {
            const std::uint64_t dropped = known_.tap().dropped();
            known_.tap().put(kHeardRate.time_of(heard_),
                             kHeardRate,
                             std::span(sound).subspan(static_cast<std::size_t>(at), kHeardBlock),
                             1);
            if (auto news = known_.take()) {
                return *news;
            }
            // Where there is no room it is put again.
            if (known_.tap().dropped() == dropped) {
                heard_ += kHeardBlock;
                at = at + 2 * kHeardBlock > length ? first : at + kHeardBlock;
            } else {
                std::this_thread::yield();
            }
        }
    }
    /// Where the song is at the moment up to which sound was heard lies in a round from `from` on.
    void expect_place(const KnownSong::Heard& news, double from) const {
        ASSERT_NE(news.plan, nullptr);
        EXPECT_EQ(news.plan->states.size(), 3'000U);
        // A round is 30 - from seconds of the song: the place is right but for whole rounds.
        const double round = 30.0 - from;
        const double begun = to_seconds(news.shift) - from + heard_begun_;
        EXPECT_NEAR(std::remainder(begun, round), 0.0, 2e-3);
    }
    void begin() { heard_begun_ = to_seconds(kHeardRate.time_of(heard_)); }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "song.wav";
    std::vector<float> song_;
    KnownSong known_{installed::models()};
    std::int64_t heard_ = 4'800'000;  // samples of the stream
    double heard_begun_ = 0.0;        // seconds of it
};

TEST_F(KnownSongTest, is_found_in_what_is_heard_and_found_again_elsewhere_and_left) {
    known_.listen(file_, false);
    begin();
    expect_place(hear(song_, 6.0), 6.0);
    known_.listen(file_, false);  // it goes on elsewhere, as its player says
    EXPECT_EQ(hear(song_, 6.0).plan, nullptr) << "until it is found again";
    begin();
    expect_place(hear(song_, 18.0), 18.0);
    std::mt19937 generator(1);
    std::normal_distribution<float> normal(0.0F, 0.1F);
    std::vector<float> other(480'000);
    std::generate(other.begin(), other.end(), [&] { return normal(generator); });
    EXPECT_EQ(hear(other, 0.0).plan, nullptr) << "it does not sound any more";
}

TEST_F(KnownSongTest, is_left_alone_where_it_is_no_plain_file) {
    for (const std::filesystem::path& file : {folder_.path(),
                                              folder_ / "none",
                                              std::filesystem::path("/dev/zero"),
                                              std::filesystem::path()}) {
        known_.listen(file, true);
    }
    known_.listen(file_, false);
    begin();
    expect_place(hear(song_, 6.0), 6.0);
    known_.forget();
    EXPECT_EQ(hear(song_, 6.0).plan, nullptr);
}

}  // namespace
}  // namespace raks::engine
