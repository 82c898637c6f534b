// Joints that other programs found: OpenPose's files, tables, and names by a map.
#include "motion/capture/keypoints/foreign_keypoints.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raks::capture {
namespace {

ForeignFilm some_film() { return {"left", 640, 480, 25.0, {}}; }

// A person of 25 joints, each at (x, joint) with this likelihood.
std::string openpose_person(double x, double likelihood) {
    std::string numbers;
    for (int joint = 0; joint < 25; ++joint) {
        numbers += fmt::format("{}{},{},{}", joint > 0 ? "," : "", x, joint, likelihood);
    }
    return "{\"pose_keypoints_2d\":[" + numbers + "]}";
}

std::string openpose_file(const std::vector<std::string>& people) {
    return fmt::format("{{\"version\":1.3,\"people\":[{}]}}", fmt::join(people, ","));
}

std::string why_no_openpose(const std::string& text, const std::string& file = "a_7.json") {
    OpenPoseReader reader(some_film());
    const auto added = reader.add(text, file);
    return added ? "" : added.error().message;
}

std::string why_no_table(const std::string& text) {
    const auto read = read_foreign_table(text, "t.csv", some_film());
    return read ? "" : read.error().message;
}

TEST(OpenPose, follows_the_person_who_was_there_before) {
    OpenPoseReader reader(some_film());
    ASSERT_TRUE(reader.add(openpose_file({openpose_person(100, 0.4), openpose_person(400, 0.9)}),
                           "folder_1/dance_000000000010_keypoints.json"));
    // Their order is not that of the picture before.
    ASSERT_FALSE(reader.add(openpose_file({}), "dance_10.json"));
    ASSERT_TRUE(reader.add(openpose_file({openpose_person(410, 0.5), openpose_person(90, 0.9)}),
                           "dance_000000000011_keypoints.json"));
    ASSERT_TRUE(reader.add(openpose_file({}), "dance_000000000014_keypoints.json"));
    const KeypointFilm film = reader.take();
    ASSERT_EQ(film.pictures.size(), 3U);
    EXPECT_EQ(film.pictures[0].number, 10U);
    EXPECT_DOUBLE_EQ(film.pictures[0].time, 0.4);
    EXPECT_EQ(film.pictures[0].people, 2U);
    EXPECT_EQ(film.pictures[0][BodyPoint::left_wrist].pixel, glm::dvec2(400.0, 7.0));
    EXPECT_EQ(film.pictures[1][BodyPoint::left_wrist].pixel, glm::dvec2(410.0, 7.0));
    EXPECT_EQ(film.pictures[1][BodyPoint::right_heel].pixel, glm::dvec2(410.0, 24.0));
    EXPECT_EQ(film.pictures[1][BodyPoint::left_eye_inner].visibility, 0.0);
    EXPECT_EQ(film.pictures[2].score, 0.0);
    EXPECT_EQ(film.pictures[2].people, 0U);
}

TEST(OpenPose, a_bad_file_is_one_line) {
    EXPECT_EQ(
        why_no_openpose("{\"people\":[{\"pose_keypoints_2d\":[NaN,1,1]}]}"),
        "a_7.json: is no JSON, or cut off (NaN is none: joints that were not found are zeros)");
    EXPECT_EQ(why_no_openpose("[]"), "a_7.json: is not of OpenPose: it has no list \"people\"");
    EXPECT_EQ(why_no_openpose("{\"people\":[3]}"),
              "a_7.json: a person has no list pose_keypoints_2d");
    EXPECT_EQ(why_no_openpose("{\"people\":[{\"pose_keypoints_2d\":[1,2,\"x\"]}]}"),
              "a_7.json: pose_keypoints_2d must hold numbers alone");
    EXPECT_EQ(why_no_openpose("{\"people\":[{\"pose_keypoints_2d\":[1,2,3]}]}"),
              "a_7.json: pose_keypoints_2d has 3 numbers, must have 75 (25 joints) or 54 (18)");
    EXPECT_EQ(why_no_openpose(openpose_file({openpose_person(5, -0.25)})),
              "a_7.json: the likelihood of joint 0 is -0.25, must be 0 or more");
    EXPECT_EQ(why_no_openpose(openpose_file({openpose_person(1e9, 0.5)})),
              "a_7.json: joint 0 does not lie in a picture");
    EXPECT_EQ(why_no_openpose(openpose_file({}), "a.json"), "a.json: has no number in its name");
}

TEST(ForeignTable, columns_are_found_by_their_names) {
    const auto film = read_foreign_table(
        "frame;time;RWrist_x;RWrist_y;RWrist_conf;l_hip.x;l_hip.y;Neck_x;Neck_y\n"
        "4;0.2;10;20;0.5;100;200;1;1\n"
        "6;0.3;nan;20;0.5;101;201;1;1\n",
        "t.csv",
        some_film());
    ASSERT_TRUE(film) << film.error().message;
    ASSERT_EQ(film->pictures.size(), 2U);
    EXPECT_EQ(film->pictures[0].number, 4U);
    EXPECT_EQ(film->pictures[1].time, 0.3);
    EXPECT_EQ(film->pictures[0][BodyPoint::right_wrist], (Keypoint{{10.0, 20.0}, 0.5}));
    EXPECT_EQ(film->pictures[1][BodyPoint::right_wrist], Keypoint{});
    EXPECT_EQ(film->pictures[1][BodyPoint::left_hip], (Keypoint{{101.0, 201.0}, 1.0}));
}

TEST(ForeignTable, reads_what_deeplabcut_writes) {
    const auto film = read_foreign_table(
        "scorer,net,net,net,net,net,net\n"
        "bodyparts,left_knee,left_knee,left_knee,tail,tail,tail\n"
        "coords,x,y,likelihood,x,y,likelihood\n"
        "0,10.5,20.5,0.75,1,1,1\n"
        "1,11.5,21.5,0,1,1,1\n",
        "t.csv",
        some_film());
    ASSERT_TRUE(film) << film.error().message;
    ASSERT_EQ(film->pictures.size(), 2U);
    EXPECT_EQ(film->pictures[0][BodyPoint::left_knee], (Keypoint{{10.5, 20.5}, 0.75}));
    EXPECT_DOUBLE_EQ(film->pictures[1].time, 0.04);
    EXPECT_EQ(film->pictures[1].score, 0.0);
}

TEST(ForeignTable, shares_of_the_picture_become_pixels) {
    const auto film =
        read_foreign_table("nose_x,nose_y,nose_visibility\n0.5,0.25,1\n", "t.csv", some_film());
    ASSERT_TRUE(film) << film.error().message;
    EXPECT_EQ(film->pictures[0][BodyPoint::nose].pixel, glm::dvec2(319.5, 119.5));
}

TEST(ForeignTable, a_map_says_what_names_mean) {
    ForeignFilm film = some_film();
    const std::string table = "MD_1_x,MD_1_y\n10,20\n";
    EXPECT_EQ(why_no_table(table),
              "t.csv: line 1: has no joint that is known: what is \"MD_1\"? say it by a map (--map "
              "names.tsv: their name, a tab, left_wrist)");
    const auto names = read_point_names("# theirs\tours\nMD_1\tleft_ankle\n", "n.tsv");
    ASSERT_TRUE(names) << names.error().message;
    film.names = *names;
    const auto read = read_foreign_table(table, "t.csv", film);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->pictures[0][BodyPoint::left_ankle].pixel, glm::dvec2(10.0, 20.0));
    film.names.emplace_back("MD_2", BodyPoint::right_ankle);
    EXPECT_EQ(read_foreign_table(table, "t.csv", film).error().message,
              "t.csv: line 1: no column is called \"MD_2\", which the map (--map) names");
}

TEST(ForeignTable, a_bad_table_is_one_line) {
    EXPECT_EQ(why_no_table(""), "t.csv: is empty");
    EXPECT_EQ(
        why_no_table("a,b\n1,2\n"),
        "t.csv: line 1: is of an unknown layout; known: a head with NAME_x, NAME_y and NAME_v "
        "(or _score, _likelihood, _confidence), DeepLabCut, OpenPose's folder of JSON, "
        "keypoints of Raks");
    EXPECT_EQ(
        why_no_table("scorer,a,a\nx,y,z\n"),
        "t.csv: line 2: is of an unknown layout: behind scorer must follow rows bodyparts and "
        "coords");
    EXPECT_EQ(why_no_table("nose_x,nose_y,nose_v\n1,2,-0.5\n"),
              "t.csv: line 2: nose: its likelihood is -0.5, must be from 0 to 1");
    EXPECT_EQ(why_no_table("nose_x,nose_y,nose_v\n1,2\n"), "t.csv: line 2: has 2 cells, needs 3");
    EXPECT_EQ(why_no_table("nose_x,nose_y\n1,a\n"), "t.csv: line 2: nose: \"a\" is not a number");
    EXPECT_EQ(why_no_table("frame,nose_x,nose_y\n1,1,2\n1,1,2\n"),
              "t.csv: line 3: its picture or time does not come after the one before");
    EXPECT_EQ(why_no_table("nose_x,nose_y,Nose_x\n1,2,3\n"),
              "t.csv: line 1: nose is there twice: say by a map which column it is");
}

TEST(PointNames, words_in_any_order_and_case) {
    const PointNameMap none;
    EXPECT_EQ(body_point_meant("LBigToe", none), BodyPoint::left_foot_index);
    EXPECT_EQ(body_point_meant("shoulder_r", none), BodyPoint::right_shoulder);
    EXPECT_EQ(body_point_meant("Right Eye Inner", none), BodyPoint::right_eye_inner);
    EXPECT_EQ(body_point_meant("KneeLeft", none), BodyPoint::left_knee);
    EXPECT_EQ(body_point_meant("LEFT_ANKLE", none), BodyPoint::left_ankle);
    EXPECT_EQ(body_point_meant("RHJC", none), BodyPoint::right_hip);
    EXPECT_EQ(body_point_meant("lwrist", none), BodyPoint::left_wrist);
    EXPECT_FALSE(body_point_meant("RFAradius", none));
    EXPECT_FALSE(body_point_meant("Neck", none));
    EXPECT_FALSE(body_point_meant("wrist", none));
}

TEST(PointNames, a_bad_map_is_one_line) {
    const auto why = [](const char* text) {
        const auto read = read_point_names(text, "n.tsv");
        return read ? std::string() : read.error().message;
    };
    EXPECT_EQ(why("a\n"), "n.tsv: line 1: must be a name, a tab and the joint that it means");
    EXPECT_EQ(why("a\tleft_wrst\n"),
              "n.tsv: line 1: joint \"left_wrst\" is unknown; did you mean \"left_wrist\"?");
    EXPECT_EQ(why("a\tnose\nb\tnose\n"), "n.tsv: line 2: its name or its joint was there before");
}

}  // namespace
}  // namespace raks::capture
