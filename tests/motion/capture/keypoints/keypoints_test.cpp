// Keypoints as a table: what was written reads back, and what is wrong is said in one line.
#include "motion/capture/keypoints/keypoints.hpp"

#include <gtest/gtest.h>

#include <string>

#include "motion/capture/keypoints/keypoint_doubts.hpp"

namespace raks::capture {
namespace {

// A film of 100 x 200 in which somebody stands upright; every joint is sure.
KeypointFilm some_keypoints(std::size_t pictures) {
    KeypointFilm film{"left phone", 100, 200, "full", {}};
    for (std::size_t i = 0; i < pictures; ++i) {
        KeypointPicture picture;
        picture.number = 2 * i;
        picture.time = 1.0 / 3.0 + static_cast<double>(i) / 30.0;
        picture.score = 0.75;
        for (std::size_t point = 0; point < kBodyPoints; ++point) {
            picture.points[point] = {{40.25, 5.5 * static_cast<double>(point)}, 0.875};
        }
        film.pictures.push_back(picture);
    }
    return film;
}

std::string why_no_keypoints(const std::string& text) {
    const auto read = read_keypoints(text, "k.csv");
    return read ? "" : read.error().message;
}

TEST(Keypoints, read_back_to_the_same_values) {
    KeypointFilm film = some_keypoints(3);
    film.pictures[1].people = 2;
    film.pictures[1].background = BackgroundPlace{{-12.5, 3.25}, 1.03125};
    film.pictures[2] = {6, 0.7, 0.0, 0, {}, {}};
    const auto read = read_keypoints(keypoints_text(film), "k.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, film);
}

TEST(Keypoints, a_table_without_the_background_reads_too) {
    std::string text = keypoints_text(some_keypoints(2));
    const auto cut = [&text](const std::string& piece) {
        for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece)) {
            text.erase(at, piece.size() - 1);
        }
    };
    cut(",background_x,background_y,background_size\n");
    cut(",,,\n");
    const auto read = read_keypoints(text, "k.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, some_keypoints(2));
}

TEST(Keypoints, every_joint_has_a_name_of_its_own) {
    for (std::size_t i = 0; i < kBodyPoints; ++i) {
        const auto point = static_cast<BodyPoint>(i);
        EXPECT_EQ(body_point_named(name_of(point)), point);
    }
    EXPECT_FALSE(body_point_named("left_tail"));
}

TEST(Keypoints, a_bad_table_is_one_line) {
    const std::string good = keypoints_text(some_keypoints(2));
    EXPECT_EQ(
        why_no_keypoints("a,b\n"),
        "k.csv: is not a table of keypoints: its first line must begin with # raks-keypoints");
    EXPECT_EQ(why_no_keypoints("# raks-keypoints 2 1 1 full left\n"),
              "k.csv: is of version 2, this program reads version 1");
    EXPECT_EQ(why_no_keypoints("# raks-keypoints 1 0 1 full left\n"),
              "k.csv: line 1 must be # raks-keypoints 1 WIDTH HEIGHT NETWORK CAMERA");
    EXPECT_EQ(
        why_no_keypoints("# raks-keypoints 1 9 9 full left\npicture,time\n"),
        "k.csv: line 2 must be picture,time,score,people,nose_x,nose_y,... with the 33 joints "
        "of BlazePose");
    const std::size_t last = good.rfind(",0.875");
    EXPECT_EQ(why_no_keypoints(good.substr(0, last)), "k.csv: line 4: has 102 cells, needs 106");
    EXPECT_EQ(why_no_keypoints(good.substr(0, last) + ",nan,,,\n"),
              "k.csv: line 4: its visibility of right_foot_index must be a number from 0 to 1");
    EXPECT_EQ(why_no_keypoints(good.substr(0, last) + ",-0.5,,,\n"),
              "k.csv: line 4: its visibility of right_foot_index must be a number from 0 to 1");
    EXPECT_EQ(why_no_keypoints(good.substr(0, good.size() - 4) + ",1,2,0\n"),
              "k.csv: line 4: its background_size must be a number from 0.01 to 100");
    EXPECT_EQ(why_no_keypoints(good + good.substr(good.rfind("\n2,") + 1)),
              "k.csv: line 5: its picture or time does not come after the one before");
}

TEST(KeypointDoubts, a_dance_needs_somebody_whole) {
    KeypointFilm film = some_keypoints(10);
    EXPECT_EQ(why_no_dance(keypoint_shares(film)), "");
    EXPECT_TRUE(keypoint_doubts(keypoint_shares(film)).empty());
    // From the side one leg hides the other.
    KeypointFilm side = film;
    for (KeypointPicture& picture : side.pictures) {
        picture[BodyPoint::left_knee].visibility = 0.1;
        picture[BodyPoint::left_ankle].visibility = 0.1;
    }
    EXPECT_EQ(why_no_dance(keypoint_shares(side)), "");
    // Behind a desk.
    for (KeypointPicture& picture : side.pictures) {
        picture[BodyPoint::right_ankle].visibility = 0.1;
    }
    EXPECT_EQ(
        why_no_dance(keypoint_shares(side)),
        "no whole body is visible (hips, knees and ankles in 0 % of its 10 pictures): film the "
        "dancer from head to feet");
    // Feet below the picture's edge.
    KeypointFilm cut = film;
    cut.height = 140;
    EXPECT_NE(why_no_dance(keypoint_shares(cut)).find("no whole body is visible"),
              std::string::npos);
    for (KeypointPicture& picture : film.pictures) {
        picture = {picture.number, picture.time, 0.0, 0, {}};
    }
    EXPECT_EQ(why_no_dance(keypoint_shares(film)),
              "nobody is visible in 100 % of its 10 pictures: film one dancer, whole, in light");
}

TEST(KeypointDoubts, several_people_are_said) {
    KeypointFilm film = some_keypoints(10);
    film.pictures[3].people = 1;
    film.pictures[6].people = 2;
    const auto doubts = keypoint_doubts(keypoint_shares(film));
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0].substr(0, 42), "several people are visible in 1 of 2 pictu");
}

}  // namespace
}  // namespace raks::capture
