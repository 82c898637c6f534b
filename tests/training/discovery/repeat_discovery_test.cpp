#include "training/discovery/repeat_discovery.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::repeat_discovery_test {
namespace {

/// Music whose beats the dance keeps to, from second 0 of the clip on.
DancedMusic music_of(double beat, double first) {
    DancedMusic music;
    music.name = "song.mp3";
    music.duration = 60.0;
    for (int b = 0; first + beat * b < 60.0; ++b) {
        music.beats.push_back({first + beat * b, b % 4 + 1});
    }
    return music;
}

void expect_borders(const FoundRepeats& found, const test::SteppingDance& dance) {
    EXPECT_EQ(found.beats, 8);
    EXPECT_NEAR(found.tempo(), 60.0 / dance.beat, 4.0);
    ASSERT_EQ(found.repeats.size(), static_cast<std::size_t>(dance.repeats));
    for (int r = 0; r < dance.repeats; ++r) {
        const double start = found.repeats[static_cast<std::size_t>(r)].start;
        EXPECT_NEAR(start / dance.frames_per_second, dance.count_1(r), 0.5 * dance.beat) << r;
    }
}

TEST(RepeatDiscovery, finds_borders_from_the_feet_at_every_rate) {
    for (const double rate : {29.97, 60.0, 120.0}) {
        test::SteppingDance dance;
        dance.frames_per_second = rate;
        const auto found = find_repeats(test::stepping_clip(dance));
        ASSERT_TRUE(found) << found.error().message;
        expect_borders(*found, dance);
        EXPECT_TRUE(found->warnings.empty());
    }
}

TEST(RepeatDiscovery, the_follow_begins_with_the_other_foot) {
    test::SteppingDance dance;
    dance.is_mirrored = true;
    DiscoveryOptions options;
    options.role = DanceRole::follow;
    const auto found = find_repeats(test::stepping_clip(dance), options);
    ASSERT_TRUE(found) << found.error().message;
    expect_borders(*found, dance);
}

TEST(RepeatDiscovery, borders_lie_on_the_beats_of_the_music) {
    const test::SteppingDance dance;
    DiscoveryOptions options;
    options.music = music_of(dance.beat, dance.start);
    const auto found = find_repeats(test::stepping_clip(dance), options);
    ASSERT_TRUE(found) << found.error().message;
    expect_borders(*found, dance);
    for (const FoundRepeat& repeat : found->repeats) {
        const double beats = (repeat.start / dance.frames_per_second - dance.start) / dance.beat;
        EXPECT_NEAR(beats, std::round(beats), 1e-6);
    }
}

TEST(RepeatDiscovery, music_that_does_not_fit_is_said) {
    const test::SteppingDance dance;
    DiscoveryOptions options;
    options.music = music_of(dance.beat * 8.0 / 5.5, dance.start);
    const auto found = find_repeats(test::stepping_clip(dance), options);
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("5.5 beats of song.mp3: is it the song"),
              std::string::npos)
        << found.error().message;
}

TEST(RepeatDiscovery, what_cannot_be_searched_is_refused_in_one_line) {
    test::SteppingDance dance;
    TrainingClip clip = test::stepping_clip(dance);
    TrainingClip still = clip;
    std::fill(still.poses.begin(), still.poses.end(), clip.poses.front());
    std::fill(still.feet.begin(), still.feet.end(), clip.feet.front());
    EXPECT_EQ(find_repeats(still).error().message, "nothing moves in it");
    TrainingClip brief = clip;
    brief.poses = {clip.poses.begin() + 100, clip.poses.begin() + 130};
    brief.feet = {clip.feet.begin() + 100, clip.feet.begin() + 130};
    EXPECT_EQ(find_repeats(brief).error().message, "lasts 0.50 s, shorter than two beats");
    clip.poses[20].hips_position.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(find_repeats(clip).error().message, "the pose of frame 20 is not finite");
}

TEST(RepeatDiscovery, motion_that_does_not_repeat_is_said) {
    test::SteppingDance dance;
    dance.repeats = 1;
    dance.beat = 0.5;
    const TrainingClip clip = test::stepping_clip(dance);
    const auto found = find_repeats(clip);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->repeats.empty());
    EXPECT_EQ(found->none_because,
              "nothing in it repeats; --once learns it as a single phrase, raks train take beat by "
              "beat");
}

TEST(RepeatDiscovery, labels_say_which_are_worth_learning) {
    FoundRepeats found;
    found.beats = 8;
    found.repeats = {
        {10.2, 170.1, 0.0, true}, {170.1, 330.0, 0.69, true}, {330.0, 490.0, 0.9, false}};
    const auto labels = labels_of(found, "take", "basic", DanceRole::follow);
    ASSERT_EQ(labels.size(), 3U);
    EXPECT_EQ(labels[0].start, 10U);
    EXPECT_EQ(labels[0].end, labels[1].start);
    EXPECT_EQ(labels[0].confidence, 1.0);
    EXPECT_GE(labels[1].confidence, 0.9);
    EXPECT_LT(labels[2].confidence, 0.9);
    EXPECT_EQ(labels[2].role, DanceRole::follow);
}

}  // namespace
}  // namespace raks::motion::repeat_discovery_test
