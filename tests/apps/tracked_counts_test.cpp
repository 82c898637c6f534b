// Counts from the music danced to: what is tracked in a rendered salsa against its exact beats.
#include "apps/dances/tracked_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

motion::FigureLabel label_of(double from, double to, double fps) {
    motion::FigureLabel label;
    label.start = static_cast<std::size_t>(std::lround(from * fps));
    label.end = static_cast<std::size_t>(std::lround(to * fps));
    return label;
}

TEST(TrackedCounts, counts_of_a_salsa_lie_within_hundredths_of_a_beat) {
    constexpr double kFps = 60.0;
    audio::MusicPlan plan;
    plan.seconds = 36.0;
    plan.tempo = {{0.0, 176.0}};
    const auto music = audio::generate(plan);
    ASSERT_TRUE(music);
    const test::TemporaryFolder folder;
    const auto path = folder / "music.wav";
    ASSERT_TRUE(audio::write_wav(path, music->samples, music->channels, music->rate));
    Expected<TrackedCounts> heard = track_counts(path);
    ASSERT_TRUE(heard) << heard.error().message;
    EXPECT_NEAR(heard->music.duration, 36.0, 0.02);
    EXPECT_EQ(heard->warning, "");
    heard->music.offset = 1.5;  // the clip begins so late in the music
    double sum = 0.0;
    double square = 0.0;
    double count = 0.0;
    // Every figure from count 1, from the first one inside the clip on: also before the tracker is
    // sure.
    for (std::size_t b = 8; b + 8 < music->beats.size(); b += 8) {
        const auto seconds = [&](std::size_t beat) {
            return to_seconds(music->beats[beat].time) - heard->music.offset;
        };
        const auto counts = motion::counts_of(
            label_of(seconds(b) + 0.04, seconds(b + 8) - 0.03, kFps), heard->music, kFps);
        ASSERT_TRUE(counts) << counts.error().message;
        ASSERT_EQ(counts->frames.size(), 9U) << counts->left_out;
        const double beat = (seconds(b + 8) - seconds(b)) / 8.0;
        for (std::size_t k = 0; k <= 8; ++k) {
            const double error = (counts->frames[k] / kFps - seconds(b + k)) / beat;
            EXPECT_NEAR(error, 0.0, 0.08) << "beat " << b + k;
            sum += error;
            square += error * error;
            count += 1.0;
        }
    }
    ASSERT_GE(count, 60.0);
    const double mean = sum / count;
    RecordProperty("mean_beats", std::to_string(mean));
    RecordProperty("deviation_beats", std::to_string(std::sqrt(square / count - mean * mean)));
    EXPECT_NEAR(mean, 0.0, 0.03);
    EXPECT_LT(std::sqrt(square / count), 0.04);
}

TEST(TrackedCounts, silence_has_no_beats_and_a_bad_file_is_said) {
    const test::TemporaryFolder folder;
    const auto path = folder / "silence.wav";
    const std::vector<float> silence(48'000 * 4, 0.0F);
    ASSERT_TRUE(audio::write_wav(path, silence, 1, SampleRate(48'000)));
    const auto heard = track_counts(path);
    std::filesystem::remove(path);
    ASSERT_TRUE(heard) << heard.error().message;
    EXPECT_TRUE(heard->music.beats.empty());
    const auto missing = track_counts(path);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("silence.wav"), std::string::npos);
}

}  // namespace
}  // namespace raks::apps
