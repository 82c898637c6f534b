#include "audio/sync/joint_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/audio/sync/recordings.hpp"

namespace raks::audio {
namespace {

using test::dry_recorder;
using test::recording;
using test::white_noise;

TEST(JointAlignment, a_camera_joins_by_another_one_where_it_misses_the_reference) {
    const auto noise = white_noise(70.0, 1);
    // The first and the last have no moment in common.
    const std::vector<SyncTrack> tracks{recording(noise, dry_recorder(30.0, 0.0, 0.0), "a", 0),
                                        recording(noise, dry_recorder(30.0, 15.0, 40.0), "b", 1),
                                        recording(noise, dry_recorder(30.0, 31.0, -30.0), "c", 2)};
    std::size_t calls = 0;
    const auto joint = align_jointly(tracks, {}, [&](std::size_t done, std::size_t all) {
        ++calls;
        EXPECT_EQ(done, calls);
        EXPECT_EQ(all, 3U);
        return true;
    });
    EXPECT_EQ(calls, 3U);
    EXPECT_EQ(joint.reference, 0U);
    const auto& clocks = joint.clocks;
    ASSERT_TRUE(clocks[1] && clocks[2]);
    EXPECT_EQ(clocks[0]->through, 0U);
    EXPECT_EQ(clocks[1]->through, 0U);
    EXPECT_EQ(clocks[2]->through, 1U);
    EXPECT_NEAR(clocks[1]->line.offset, 15.0, 1e-4);
    EXPECT_NEAR(clocks[2]->line.offset, 31.0, 3e-4);
    EXPECT_NEAR(clocks[2]->line.drift_ppm, -30.0, 5.0);
    EXPECT_LE(clocks[2]->confidence, clocks[1]->confidence);
}

TEST(JointAlignment, the_song_is_a_track_whose_clock_tells_when_it_began) {
    const auto song = white_noise(60.0, 2);
    std::vector<SyncTrack> tracks{recording(song, dry_recorder(30.0, 12.0, 0.0), "a", 0),
                                  recording(song, dry_recorder(30.0, 10.5, 25.0), "b", 1)};
    tracks.push_back(*SyncTrack::prepare(song, SampleRate(test::kRecordingRate), "song.mp3"));
    for (const int threads : {1, 3}) {
        JointOptions options;
        options.threads = threads;
        options.song = 2;
        options.most_offset = 5.0;
        const auto clocks = align_jointly(tracks, options).clocks;
        ASSERT_TRUE(clocks[1] && clocks[2]);
        EXPECT_NEAR(clocks[1]->line.offset, -1.5, 1e-4);
        EXPECT_NEAR(clocks[2]->line.offset, -12.0, 1e-4);
        EXPECT_LT(clocks[1]->disagreement, 1e-3);
        EXPECT_TRUE(clocks[0]->hears_song && clocks[1]->hears_song);
    }
}

TEST(JointAlignment, who_hears_something_else_stays_apart_with_the_reason) {
    const auto noise = white_noise(40.0, 3);
    const std::vector<SyncTrack> tracks{
        recording(white_noise(40.0, 4), dry_recorder(20.0, 0.0, 0.0), "deaf", 0),
        recording(noise, dry_recorder(20.0, 3.0, 0.0), "b", 1),
        recording(noise, dry_recorder(20.0, 5.0, 0.0), "c", 2)};
    // The two that hear the same make the common clock.
    const auto joint = align_jointly(tracks, {});
    EXPECT_EQ(joint.reference, 1U);
    EXPECT_TRUE(joint.clocks[1] && joint.clocks[2]);
    ASSERT_FALSE(joint.clocks[0]);
    EXPECT_EQ(
        joint.clocks[0].error().message.find("deaf stays apart: b: nothing stands out that deaf"),
        0U)
        << joint.clocks[0].error().message;
    JointOptions by_deaf;
    by_deaf.reference = 0;
    const auto alone = align_jointly(tracks, by_deaf).clocks;
    ASSERT_TRUE(alone[0]);
    ASSERT_FALSE(alone[1]);
    EXPECT_EQ(alone[1].error().message.find("b: nothing stands out that deaf hears"), 0U)
        << alone[1].error().message;
}

TEST(JointAlignment, sound_that_comes_a_longer_way_is_corrected_where_it_is_known) {
    const auto noise = white_noise(40.0, 5);
    const std::vector<double> metres{2.0, 9.0, 5.0};
    std::vector<SyncTrack> tracks;
    for (std::size_t i = 0; i < metres.size(); ++i) {
        auto recorder = dry_recorder(25.0, 1.0 + static_cast<double>(i), 0.0);
        recorder.metres = metres[i];
        tracks.push_back(recording(noise, recorder, std::to_string(i), i));
    }
    tracks.push_back(*SyncTrack::prepare(noise, SampleRate(test::kRecordingRate), "song"));
    auto joint = align_jointly(tracks, {});
    const auto& clocks = joint.clocks;
    EXPECT_NEAR(clocks[1]->line.offset, 1.0 - 7.0 / kSpeedOfSound, 1e-4);
    const std::vector<std::optional<double>> distances{2.0, 9.0, std::nullopt, 0.0};
    correct_sound_way(joint, distances);
    EXPECT_NEAR(clocks[0]->line.offset, 0.0, 1e-12);
    EXPECT_NEAR(clocks[1]->line.offset, 1.0, 1e-4);
    EXPECT_NEAR(clocks[2]->line.offset, 2.0 - 3.0 / kSpeedOfSound, 1e-4);
    EXPECT_NEAR(clocks[3]->line.offset, -1.0, 1e-4);
}

}  // namespace
}  // namespace raks::audio
