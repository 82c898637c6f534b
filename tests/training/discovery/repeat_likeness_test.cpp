#include "training/discovery/repeat_likeness.hpp"

#include <gtest/gtest.h>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::repeat_likeness_test {
namespace {

std::vector<ClipRepeat> repeats_of(const TrainingClip& clip, const test::SteppingDance& dance) {
    std::vector<ClipRepeat> repeats;
    const double rate = clip.frames_per_second;
    for (int r = 0; r < dance.repeats; ++r) {
        repeats.push_back({&clip, {dance.count_1(r) * rate, 8.0 * dance.beat * rate}, 8});
    }
    return repeats;
}

TEST(RepeatLikeness, the_commonest_figure_is_alike_and_another_is_not) {
    test::SteppingDance dance;
    dance.raised = {1, 4};
    const TrainingClip clip = test::stepping_clip(dance);
    const RepeatLikeness likeness = compare_repeats(repeats_of(clip, dance));
    EXPECT_EQ(likeness.is_alike, (std::vector<bool>{true, false, true, true, false, true}));
    EXPECT_LT(likeness.distance[3], 0.2);
    EXPECT_GT(likeness.distance[1], 0.7);
}

TEST(RepeatLikeness, is_common_to_all_clips) {
    test::SteppingDance plain;
    test::SteppingDance other;
    other.raised = {0, 1, 2, 3};
    const TrainingClip first = test::stepping_clip(plain);
    const TrainingClip second = test::stepping_clip(other);
    std::vector<ClipRepeat> repeats = repeats_of(first, plain);
    const auto more = repeats_of(second, other);
    repeats.insert(repeats.end(), more.begin(), more.end());
    const RepeatLikeness likeness = compare_repeats(repeats);
    // Six of the first clip and two of the second; alone, the second would have chosen its four.
    EXPECT_EQ(std::count(likeness.is_alike.begin(), likeness.is_alike.end(), true), 8);
    EXPECT_TRUE(likeness.is_alike[11]);
    EXPECT_FALSE(likeness.is_alike[6]);
}

TEST(RepeatLikeness, repeats_of_another_length_are_not_alike) {
    const test::SteppingDance dance;
    const TrainingClip clip = test::stepping_clip(dance);
    std::vector<ClipRepeat> repeats = repeats_of(clip, dance);
    repeats[2].beats = 4;
    EXPECT_FALSE(compare_repeats(repeats).is_alike[2]);
}

}  // namespace
}  // namespace raks::motion::repeat_likeness_test
