#include "training/discovery/phrase_discovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::phrase_discovery_test {
namespace {

/// 16 beats without anything in front or behind.
test::SteppingDance two_repeats(double beat = 0.5) {
    test::SteppingDance dance;
    dance.beat = beat;
    dance.repeats = 2;
    dance.start = 0.0;
    dance.end = -1.0 / dance.frames_per_second;
    return dance;
}

bool says(const FoundRepeats& found, const std::string& words) {
    return std::any_of(found.warnings.begin(), found.warnings.end(), [&](const auto& line) {
        return line.find(words) != std::string::npos;
    });
}

TEST(PhraseDiscovery, all_of_a_clip_is_learnt) {
    for (const double beat : {0.4, 0.5, 0.6}) {
        const TrainingClip clip = test::stepping_clip(two_repeats(beat));
        const auto found = whole_phrase(clip);
        ASSERT_TRUE(found) << found.error().message;
        ASSERT_EQ(found->repeats.size(), 1U);
        EXPECT_EQ(found->repeats[0].start, 0.0);
        EXPECT_NEAR(found->repeats[0].end, static_cast<double>(clip.poses.size()), 1e-9);
        EXPECT_TRUE(found->repeats[0].is_good);
        ASSERT_FALSE(found->counts.empty());
        EXPECT_EQ(found->beats, found->counts[0].beats);
        EXPECT_TRUE(std::any_of(found->counts.begin(), found->counts.end(), [](const auto& count) {
            return count.beats == 16;
        })) << beat;
    }
}

// Of a long clip many counts are about one tempo, and more of them about a fast one.
TEST(PhraseDiscovery, the_way_that_is_taken_is_the_likeliest) {
    test::SteppingDance dance = two_repeats();
    dance.repeats = 10;
    const auto found = whole_phrase(test::stepping_clip(dance));
    ASSERT_TRUE(found) << found.error().message;
    double sum = 0.0;
    for (std::size_t i = 0; i < found->counts.size(); ++i) {
        sum += found->counts[i].probability;
        EXPECT_LE(found->counts[i].probability, found->counts[0].probability) << i;
    }
    EXPECT_LE(sum, 1.0 + 1e-9);
}

TEST(PhraseDiscovery, a_person_may_say_the_beats_or_the_tempo) {
    const TrainingClip clip = test::stepping_clip(two_repeats());
    DiscoveryOptions options;
    options.beats = 7;
    EXPECT_EQ(whole_phrase(clip, options)->beats, 7);
    EXPECT_TRUE(whole_phrase(clip, options)->counts.empty());
    options.beats = {};
    options.bpm = 60.0;
    EXPECT_EQ(whole_phrase(clip, options)->beats, 8);
    options.bpm = 116.0;
    const auto odd = whole_phrase(clip, options);
    EXPECT_EQ(odd->beats, 15);
    EXPECT_TRUE(says(*odd, "learnt as 15 beats at 112.5 BPM"));
}

TEST(PhraseDiscovery, a_rest_pose_in_front_is_left_out_and_said) {
    test::SteppingDance dance = two_repeats();
    TrainingClip clip = test::stepping_clip(dance);
    Pose t_pose;
    t_pose.hips_position = clip.poses[0].hips_position;
    clip.poses.insert(clip.poses.begin(), 30, t_pose);
    clip.feet.insert(clip.feet.begin(), 30, clip.feet[0]);
    const auto found = whole_phrase(clip);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->repeats[0].start, 30.0);
    EXPECT_TRUE(says(*found, "0.50 s of a rest pose"));
}

TEST(PhraseDiscovery, counts_are_the_beats_of_the_music) {
    const TrainingClip clip = test::stepping_clip(two_repeats());
    DancedMusic music;
    music.name = "song.mp3";
    music.duration = 60.0;
    for (int b = 0; b < 100; ++b) {
        music.beats.push_back({0.3 + 0.4 * b, b % 4 + 1});
    }
    DiscoveryOptions options;
    options.music = music;
    const auto found = whole_phrase(clip, options);
    ASSERT_TRUE(found) << found.error().message;
    // From 0.3 to 7.9 s of 8.
    EXPECT_EQ(found->beats, 19);
    EXPECT_NEAR(found->seconds, 0.4 * 19, 1e-9);
    EXPECT_TRUE(says(*found, "0.30 s before the first beat of song.mp3"));
}

TEST(PhraseDiscovery, a_long_phrase_has_parts_of_whole_bars_and_nothing_is_lost) {
    test::SteppingDance dance = two_repeats();
    dance.repeats = 12;
    DiscoveryOptions options;
    options.bpm = 120.0;
    auto found = whole_phrase(test::stepping_clip(dance), options);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->beats, 96);
    for (const int beats : {2, 64, 65, 96, 97, 128, 129, 961}) {
        for (const int bar : {2, 3, 4, 5, 7, 12}) {
            found->beats = beats;
            const auto parts = phrase_parts(*found, bar);
            EXPECT_EQ(parts.size() == 1, beats <= kMostFigureBeats);
            int sum = 0;
            double end = found->repeats[0].start;
            for (const FoundRepeats& part : parts) {
                ASSERT_EQ(part.repeats.size(), 1U);
                EXPECT_NEAR(part.repeats[0].start, end, 1e-6) << beats << " in bars of " << bar;
                EXPECT_NEAR(part.tempo(), found->tempo(), 1e-6);
                EXPECT_GE(part.beats, 1);
                EXPECT_LE(part.beats, kMostFigureBeats);
                EXPECT_TRUE(&part == &parts.back() || part.beats % bar == 0);
                end = part.repeats[0].end;
                sum += part.beats;
            }
            EXPECT_EQ(sum, beats);
            EXPECT_NEAR(end, found->repeats[0].end, 1e-6);
        }
    }
}

TEST(PhraseDiscovery, parts_of_a_phrase_begin_on_beats_of_its_music) {
    test::SteppingDance dance = two_repeats();
    dance.repeats = 12;
    DiscoveryOptions options;
    options.music = DancedMusic{};
    options.music->name = "song.mp3";
    options.music->duration = 60.0;
    // It gets slower all the time.
    for (double at = 0.0; at < 50.0; at += 0.4 + 0.004 * at) {
        options.music->beats.push_back({at, static_cast<int>(options.music->beats.size() % 4) + 1});
    }
    const auto found = whole_phrase(test::stepping_clip(dance), options);
    ASSERT_TRUE(found) << found.error().message;
    const auto parts = phrase_parts(*found, 4);
    ASSERT_EQ(parts.size(), 2U);
    const auto beat = static_cast<std::size_t>(parts[0].beats);
    EXPECT_NEAR(parts[1].repeats[0].start, 60.0 * options.music->beats[beat].seconds, 1e-6);
    EXPECT_GT(parts[0].tempo(), 1.05 * parts[1].tempo());
}

TEST(PhraseDiscovery, a_wrong_frame_rate_is_said) {
    TrainingClip clip = test::stepping_clip(two_repeats());
    clip.frames_per_second = 3'000.0;
    const auto found = whole_phrase(clip);
    EXPECT_FALSE(found);
    clip = test::stepping_clip(two_repeats());
    for (std::size_t i = 0; i < clip.poses.size(); ++i) {
        clip.poses[i].rotation(Bone::left_upper_arm) =
            glm::angleAxis(static_cast<float>(0.4 * static_cast<double>(i)), glm::vec3(0, 0, 1));
    }
    EXPECT_TRUE(says(*whole_phrase(clip), "faster than people's: is the frame rate right"));
}

TEST(PhraseDiscovery, phrases_of_one_dance_agree_on_their_octave) {
    FoundRepeats one;
    one.repeats = {{0.0, 480.0, 0.0, true}};
    one.beats = 16;
    one.seconds = 8.0;
    one.counts = {{16, 120.0, 0.9}};
    FoundRepeats other = one;
    FoundRepeats half = one;
    half.beats = 8;
    half.counts = {{8, 60.0, 0.7}, {16, 120.0, 0.3}};
    FoundRepeats sure = half;
    sure.counts = {{8, 60.0, 1.0}};
    agree_on_octaves({&one, &other, &half, &sure});
    EXPECT_EQ(half.beats, 16);
    EXPECT_EQ(half.counts[0].beats, 16);
    EXPECT_EQ(sure.beats, 8);
    EXPECT_EQ(one.beats, 16);
}

}  // namespace
}  // namespace raks::motion::phrase_discovery_test
