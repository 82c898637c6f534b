// Which frames of a clip a film shows.
#include "engine/show/clip_film.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace raks::engine {
namespace {

TEST(FilmedFrames, are_all_frames_at_the_clips_own_rate) {
    const FilmedFrames filmed = filmed_frames(5, 29.97);
    EXPECT_EQ(filmed.frames, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_DOUBLE_EQ(filmed.pictures_per_second, 29.97);
}

TEST(FilmedFrames, of_a_fast_clip_are_a_whole_part_of_it) {
    for (const auto& [rate, pictures, step] : {std::tuple{60.0, 60.0, 1U},
                                               std::tuple{100.0, 50.0, 2U},
                                               std::tuple{120.0, 60.0, 2U},
                                               std::tuple{1000.0, 1000.0 / 17.0, 17U}}) {
        const FilmedFrames filmed = filmed_frames(100, rate);
        EXPECT_NEAR(filmed.pictures_per_second, pictures, 1e-9);
        EXPECT_EQ(filmed.frames[1], step) << rate;
    }
}

TEST(FilmedFrames, play_slower_faster_and_backward) {
    EXPECT_EQ(filmed_frames(3, 25.0, 0.5).frames, (std::vector<std::size_t>{0, 0, 1, 1, 2, 2}));
    EXPECT_EQ(filmed_frames(5, 25.0, 2.0).frames, (std::vector<std::size_t>{0, 2, 4}));
    EXPECT_EQ(filmed_frames(3, 25.0, -1.0).frames, (std::vector<std::size_t>{2, 1, 0}));
    EXPECT_EQ(filmed_frames(1, 25.0, -1.0).frames, (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace raks::engine
