#include "audio/sync/track_alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "tests/audio/sync/recordings.hpp"

namespace raks::audio {
namespace {

using test::dry_recorder;
using test::recording;
using test::salsa;
using test::white_noise;

// The largest difference of two lines over a take, in milliseconds.
double milliseconds_apart(const ClockLine& a, const ClockLine& b, double seconds) {
    return 1e3 * std::max(std::abs(a.at(0.0) - b.at(0.0)), std::abs(a.at(seconds) - b.at(seconds)));
}

// What became of trials in rooms.
struct Trials {
    int told = 0;
    double mean_ms = 0.0;
    double worst_ms = 0.0;
    double worst_ppm = 0.0;
};

// Two recorders hear 40 s of salsa, each in a place of its own in a room of 0.5 s: 10 dB of
// signal to noise, clocks up to 50 ppm and 1.5 s apart.
Trials listen_in_rooms(int trials, double direct_to_reverberant_db) {
    constexpr double kSeconds = 40.0;
    Trials result;
    for (int trial = 0; trial < trials; ++trial) {
        const auto number = static_cast<std::uint64_t>(trial);
        const auto music = salsa(kSeconds + 2.0, number + 1);
        Dice dice(13, number);
        RoomRecorder first;
        first.direct_to_reverberant_db = direct_to_reverberant_db;
        RoomRecorder second = first;
        second.offset = dice.uniform(0.2, 1.5);
        second.drift_ppm = dice.uniform(-50.0, 50.0);
        const auto found = align_tracks(recording(music, first, "one", 2 * number),
                                        recording(music, second, "two", 2 * number + 1));
        if (found) {
            const ClockLine truth{second.offset, second.drift_ppm};
            const double off = milliseconds_apart(found->line, truth, kSeconds);
            result.told += 1;
            result.mean_ms += off;
            result.worst_ms = std::max(result.worst_ms, off);
            result.worst_ppm =
                std::max(result.worst_ppm, std::abs(found->line.drift_ppm - truth.drift_ppm));
        }
    }
    result.mean_ms /= std::max(result.told, 1);
    std::printf("%+.0f dB: %d of %d told; mean %.4f, worst %.4f ms; drift within %.2f ppm\n",
                direct_to_reverberant_db,
                result.told,
                trials,
                result.mean_ms,
                result.worst_ms,
                result.worst_ppm);
    return result;
}

// RAKS_SYNC_TRIALS: as many instead.
int trials_or(int usual) {
    const char* const wanted = std::getenv("RAKS_SYNC_TRIALS");
    return wanted == nullptr ? usual : std::atoi(wanted);
}

TEST(TrackAlignment, music_in_a_room_tells_offset_and_drift) {
    const int count = trials_or(12);
    const Trials trials = listen_in_rooms(count, 0.0);
    EXPECT_EQ(trials.told, count);
    EXPECT_LE(trials.worst_ms, 0.5);
    EXPECT_LE(trials.worst_ppm, 5.0);
}

TEST(TrackAlignment, where_echoes_drown_the_music_it_is_told_or_refused_but_never_wrong) {
    const int count = trials_or(6);
    const Trials trials = listen_in_rooms(count, -6.0);
    EXPECT_GE(trials.told, count / 2);
    EXPECT_LE(trials.worst_ms, 0.5);
    EXPECT_LE(trials.worst_ppm, 5.0);
}

TEST(TrackAlignment, clocks_are_told_whichever_track_is_longer_and_however_they_overlap) {
    const auto noise = white_noise(70.0, 1);
    struct Case {
        double seconds, offset, drift;
    };
    // The reference hears 20 to 50 s.
    for (const Case& one : {Case{30.0, 20.0, 0.0},
                            Case{15.0, 30.5, 480.0},
                            Case{70.0, 0.0, -480.0},
                            Case{35.0, 0.0, 120.0},
                            Case{30.0, 35.0, -30.0}}) {
        const auto reference = recording(noise, dry_recorder(30.0, 20.0, 0.0), "one", 0);
        const auto track =
            recording(noise, dry_recorder(one.seconds, one.offset, one.drift), "two", 1);
        const auto found = align_tracks(reference, track);
        ASSERT_TRUE(found) << found.error().message;
        const ClockLine truth{one.offset - 20.0, one.drift};
        EXPECT_LE(milliseconds_apart(found->line, truth, one.seconds), 0.05);
        const auto turned = align_tracks(track, reference);
        ASSERT_TRUE(turned) << turned.error().message;
        EXPECT_LE(milliseconds_apart(turned->line.inverse(), truth, one.seconds), 0.05);
    }
}

TEST(TrackAlignment, drift_of_a_film_at_another_speed_is_said) {
    const auto noise = white_noise(40.0, 2);
    const auto reference = recording(noise, dry_recorder(30.0, 0.0, 0.0), "one", 0);
    for (const double drift : {-1'000.0, 600.0, 1'001.0}) {
        const auto found =
            align_tracks(reference, recording(noise, dry_recorder(30.0, 0.3, drift), "two", 1));
        ASSERT_FALSE(found);
        EXPECT_NE(found.error().message.find("two: its clock drifts by"), std::string::npos)
            << found.error().message;
        EXPECT_NE(found.error().message.find("another speed"), std::string::npos);
    }
}

TEST(TrackAlignment, other_sound_is_not_aligned) {
    const auto reference = recording(white_noise(30.0, 3), dry_recorder(30.0, 0.0, 0.0), "one", 0);
    const auto other = recording(salsa(30.0, 3), dry_recorder(30.0, 0.0, 0.0), "two", 1);
    const auto found = align_tracks(reference, other);
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("two: nothing stands out that one hears"),
              std::string::npos)
        << found.error().message;
}

TEST(TrackAlignment, too_short_a_common_stretch_is_said) {
    const auto noise = white_noise(40.0, 4);
    const auto reference = recording(noise, dry_recorder(20.0, 0.0, 0.0), "one", 0);
    const auto found =
        align_tracks(reference, recording(noise, dry_recorder(20.0, 11.0, 0.0), "two", 1));
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("of 5 s, and 4 are needed"), std::string::npos)
        << found.error().message;
}

TEST(TrackAlignment, music_that_repeats_itself_is_not_guessed_unless_the_offset_is_bounded) {
    // The same 4 s over and over.
    const auto loop = white_noise(4.0, 5);
    std::vector<float> music;
    for (int i = 0; i < 12; ++i) {
        music.insert(music.end(), loop.begin(), loop.end());
    }
    const auto reference = recording(music, dry_recorder(40.0, 0.0, 0.0), "one", 0);
    const auto track = recording(music, dry_recorder(40.0, 1.25, 20.0), "two", 1);
    const auto found = align_tracks(reference, track);
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("nearly equally well"), std::string::npos)
        << found.error().message;
    const auto bounded = align_tracks(reference, track, 1.9);
    ASSERT_TRUE(bounded) << bounded.error().message;
    EXPECT_NEAR(bounded->line.offset, 1.25, 1e-4);
}

TEST(TrackAlignment, a_recording_that_was_cut_contradicts_itself) {
    const auto noise = white_noise(60.0, 6);
    const auto reference = recording(noise, dry_recorder(50.0, 0.0, 0.0), "one", 0);
    for (const double jump : {0.04, 3.0}) {
        auto first = noise;
        // From 25 s on the recorder is ahead by the sound that it lost.
        const auto at = first.begin() + 25 * test::kRecordingRate;
        first.erase(at, at + static_cast<std::ptrdiff_t>(jump * test::kRecordingRate));
        const auto found =
            align_tracks(reference, recording(first, dry_recorder(45.0, 0.5, 0.0), "two", 1));
        ASSERT_FALSE(found);
        EXPECT_NE(found.error().message.find("was one of them cut"), std::string::npos)
            << found.error().message;
    }
}

TEST(SyncTrack, silence_short_tracks_and_odd_rates_are_refused_by_name) {
    const std::vector<float> silence(16'000 * 10, 0.25F);
    const auto silent = SyncTrack::prepare(silence, SampleRate(16'000), "left.mp4");
    ASSERT_FALSE(silent);
    EXPECT_NE(silent.error().message.find("left.mp4: its sound is silent"), std::string::npos);
    const auto short_one = SyncTrack::prepare(white_noise(4.9, 1), SampleRate(16'000), "left.mp4");
    ASSERT_FALSE(short_one);
    EXPECT_NE(short_one.error().message.find("left.mp4: 4.9 s of sound are too short"),
              std::string::npos);
    EXPECT_FALSE(SyncTrack::prepare(silence, SampleRate(4'000), "left.mp4"));
    EXPECT_FALSE(SyncTrack::prepare({}, SampleRate(16'000), "left.mp4"));
}

TEST(SyncTrack, what_is_not_finite_counts_as_silence_and_rates_may_differ) {
    auto noise = white_noise(25.0, 7);
    const auto reference = recording(noise, dry_recorder(20.0, 0.0, 0.0), "one", 0);
    // Each sample three times: a recording at 48 kHz of the same, a sample late.
    std::vector<float> fast;
    for (const float sample : noise) {
        fast.insert(fast.end(), 3, sample);
    }
    fast[48'000] = std::numeric_limits<float>::quiet_NaN();
    fast[96'000] = std::numeric_limits<float>::infinity();
    const auto track = SyncTrack::prepare(fast, SampleRate(48'000), "two");
    ASSERT_TRUE(track);
    EXPECT_NEAR(track->seconds(), 25.0, 1e-3);
    const auto found = align_tracks(reference, *track);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->line.offset, 0.0, 1e-4);
    EXPECT_NEAR(found->line.drift_ppm, 0.0, 1.0);
}

}  // namespace
}  // namespace raks::audio
