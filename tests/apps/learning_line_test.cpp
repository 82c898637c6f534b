#include "apps/raks_capture/learning_line.hpp"

#include <gtest/gtest.h>

#include "motion/skeleton/formats/bvh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

class LearningLine : public ::testing::Test {
 protected:
    /// A clip of a figure that is danced so many times, a little different each time.
    [[nodiscard]] fs::path stepping(int repeats) const {
        motion::test::SteppingDance dance;
        dance.repeats = repeats;
        const motion::TrainingClip clip = motion::test::stepping_clip(dance);
        fs::path file = folder_ / "dance.bvh";
        EXPECT_TRUE(motion::write_bvh(
            file, motion::mannequin_skeleton(), clip.poses, clip.frames_per_second));
        return file;
    }
    /// The beats that such a clip is danced to.
    [[nodiscard]] static motion::DancedMusic beats() {
        motion::DancedMusic music;
        music.duration = 60.0;
        const double beat = motion::test::SteppingDance{}.beat;
        // Its third beat is the first count.
        music.offset = 3.0 * beat - motion::test::SteppingDance{}.start;
        for (int i = 0; i * beat < music.duration; ++i) {
            music.beats.push_back({i * beat, 1 + i % 4});
        }
        return music;
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(LearningLine, a_figure_that_is_repeated_is_learnt_as_one) {
    EXPECT_EQ(what_can_be_learnt(stepping(5), std::nullopt), Learnable::figure);
    EXPECT_EQ(what_can_be_learnt(folder_ / "dance.bvh", beats()), Learnable::figure);
}

TEST_F(LearningLine, what_does_not_repeat_is_a_take) {
    EXPECT_EQ(what_can_be_learnt(stepping(1), std::nullopt), Learnable::take);
    EXPECT_EQ(what_can_be_learnt(folder_ / "dance.bvh", beats()), Learnable::take);
    EXPECT_EQ(what_can_be_learnt(folder_ / "missing.bvh", std::nullopt), Learnable::take);
}

TEST_F(LearningLine, names_the_song_and_where_the_dance_begins_in_it) {
    FilmedSong song;
    song.file = "my song's.mp3";
    song.music.offset = 1.78;
    EXPECT_EQ(learning_line("a/dance.bvh", song, Learnable::take),
              "raks train take a/dance.bvh --music 'my song'\\''s.mp3' --offset 1.7800 -o mine");
    EXPECT_EQ(learning_line("a/dance.bvh", song, Learnable::figure),
              "raks train figure a/dance.bvh --music 'my song'\\''s.mp3' --offset 1.7800 -o mine");
    EXPECT_EQ(learning_line("dance.bvh", std::nullopt, Learnable::take),
              "raks train figure dance.bvh --once -o mine");
}

}  // namespace
}  // namespace raks::apps
