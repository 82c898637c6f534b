// What jumps in one camera is found and named with it; what a person corrects is done.
#include "motion/capture/markerless/followed_keypoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "motion/capture/markerless/keypoint_jumps.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// Eight seconds of a dance, seen by two cameras at right angles.
class FollowedJoints : public ::testing::Test {
 protected:
    static KeypointTake taken(const test::NetworkErrors& errors) {
        const Rig rig = test::ring({0.0, 90.0});
        const auto clocks = test::true_clocks(rig);
        auto take = keypoint_take(
            test::filmed(test::written_dance("rock", 1, 8.0), rig, clocks, errors), clocks, 30.0);
        EXPECT_TRUE(take) << take.error().message;
        return std::move(*take);
    }
    [[nodiscard]] FollowedKeypoints follow(const std::string& edits = {}) const {
        const auto read = read_edits(edits, "edits.jsonl");
        EXPECT_TRUE(read) << read.error().message;
        auto followed = follow_keypoints(rig_, take_, *read);
        EXPECT_TRUE(followed) << followed.error().message;
        return std::move(*followed);
    }
    [[nodiscard]] static std::vector<Flag> flags_of(const Tracks& tracks, Doubt doubt) {
        std::vector<Flag> flags;
        std::copy_if(tracks.flags.begin(),
                     tracks.flags.end(),
                     std::back_inserter(flags),
                     [doubt](const Flag& flag) { return flag.doubt == doubt; });
        return flags;
    }
    [[nodiscard]] static std::size_t index_of(const Tracks& tracks, BodyPoint point) {
        return static_cast<std::size_t>(
            std::find(tracks.markers.begin(), tracks.markers.end(), name_of(point)) -
            tracks.markers.begin());
    }
    // Moves a joint by so many usual errors in these frames.
    void move(std::size_t camera,
              BodyPoint point,
              std::size_t first,
              std::size_t last,
              const glm::dvec2& errors) {
        for (std::size_t frame = first; frame <= last; ++frame) {
            Keypoint& seen = take_.at(frame, camera)[static_cast<std::size_t>(point)];
            seen.pixel += errors * usual_error(take_, camera);
            seen.visibility = 0.9;
        }
    }

    Rig rig_ = test::ring({0.0, 90.0});
    KeypointTake take_ = taken({});
};

TEST_F(FollowedJoints, a_dance_that_is_seen_well_jumps_nowhere) {
    const Tracks tracks = follow().tracks;
    EXPECT_TRUE(flags_of(tracks, Doubt::jumped).empty());
    EXPECT_TRUE(flags_of(tracks, Doubt::person).empty());
}

TEST_F(FollowedJoints, a_joint_out_and_back_in_no_time_is_flagged_with_its_camera) {
    // Along the line on which the other camera has it: views alone cannot tell.
    move(1, BodyPoint::left_wrist, 100, 102, {9.0, 0.0});
    const Tracks tracks = follow().tracks;
    const auto flags = flags_of(tracks, Doubt::jumped);
    ASSERT_EQ(flags.size(), 1U);
    EXPECT_EQ(flags[0].marker, index_of(tracks, BodyPoint::left_wrist));
    EXPECT_EQ(flags[0].camera, rig_.cameras[1].name);
    EXPECT_EQ(flags[0].first, 100U);
    EXPECT_EQ(flags[0].last, 102U);
    EXPECT_EQ(tracks.at(101, flags[0].marker).source, PlaceSource::lost);
}

TEST_F(FollowedJoints, a_joint_that_is_elsewhere_for_longer_is_told_by_the_other_view) {
    move(0, BodyPoint::right_knee, 100, 112, {0.0, 12.0});
    const Tracks tracks = follow().tracks;
    const auto flags = flags_of(tracks, Doubt::jumped);
    ASSERT_EQ(flags.size(), 1U);
    EXPECT_EQ(flags[0].marker, index_of(tracks, BodyPoint::right_knee));
    EXPECT_EQ(flags[0].camera, rig_.cameras[0].name);
    EXPECT_NEAR(static_cast<double>(flags[0].first), 100.0, 2.0);
    EXPECT_NEAR(static_cast<double>(flags[0].last), 112.0, 2.0);
}

TEST_F(FollowedJoints, somebody_else_is_flagged_once_for_the_whole_body) {
    test::NetworkErrors errors;
    errors.stranger = {{3.0, 4.5}};
    take_ = taken(errors);
    const FollowedKeypoints followed = follow();
    const auto flags = flags_of(followed.tracks, Doubt::person);
    ASSERT_EQ(flags.size(), 1U);
    EXPECT_EQ(flags[0].camera, rig_.cameras[1].name);
    EXPECT_NEAR(static_cast<double>(flags[0].first), 90.0, 3.0);
    EXPECT_NEAR(static_cast<double>(flags[0].last), 134.0, 3.0);
    EXPECT_TRUE(flags_of(followed.tracks, Doubt::residual).empty()) << "one reason is enough";
    ASSERT_EQ(followed.lines.size(), 1U);
    EXPECT_EQ(followed.lines[0],
              "camera2: somebody else was followed for 1.5 s, which do not count");
}

TEST_F(FollowedJoints, exchanged_sides_are_flagged_with_their_camera) {
    test::NetworkErrors errors;
    errors.exchanged = {{3.0, 4.0}};
    take_ = taken(errors);
    const auto flags = flags_of(follow().tracks, Doubt::exchanged);
    ASSERT_FALSE(flags.empty());
    for (const Flag& flag : flags) {
        EXPECT_EQ(flag.camera, rig_.cameras[0].name);
    }
}

TEST_F(FollowedJoints, edits_are_done_to_what_is_shown) {
    const FollowedKeypoints before = follow();
    const FollowedKeypoints after = follow(
        R"({"edit": "exchange", "camera": "camera1", "limbs": "legs", "first": 50, "last": 59})"
        "\n"
        R"({"edit": "hide", "camera": "camera2", "first": 100, "last": 109})"
        "\n"
        R"({"edit": "hide", "camera": "camera1", "marker": "nose", "first": 150, "last": 160})"
        "\n"
        R"({"edit": "set", "frame": 200, "camera": "camera1", "marker": "nose", "u": 360, "v": 9})"
        "\n");
    EXPECT_EQ(after.shown.sights, before.shown.sights) << "edits are done after it";
    KeypointTake edited = before.shown;
    const auto edits = read_edits(
        R"({"edit": "exchange", "camera": "camera1", "limbs": "legs", "first": 50, "last": 59})",
        "e");
    apply_keypoint_edits(*edits, rig_, edited);
    EXPECT_EQ(edited.point(55, 0, BodyPoint::left_knee),
              before.shown.point(55, 0, BodyPoint::right_knee));
    EXPECT_EQ(edited.point(55, 0, BodyPoint::left_wrist),
              before.shown.point(55, 0, BodyPoint::left_wrist));
    EXPECT_EQ(edited.point(60, 0, BodyPoint::left_knee),
              before.shown.point(60, 0, BodyPoint::left_knee));
    const auto lost = [&](std::size_t frame, BodyPoint point) {
        return after.tracks.at(frame, index_of(after.tracks, point)).source == PlaceSource::lost;
    };
    EXPECT_TRUE(lost(105, BodyPoint::left_hip));
    EXPECT_TRUE(lost(155, BodyPoint::nose));
    EXPECT_FALSE(lost(155, BodyPoint::left_hip));
    // Exchanged once more it is as before.
    apply_keypoint_edits(*edits, rig_, edited);
    EXPECT_EQ(edited.sights, before.shown.sights);
}

TEST_F(FollowedJoints, a_repair_is_taken_back_by_exchanging_it) {
    test::NetworkErrors errors;
    errors.exchanged = {{3.0, 4.0}};
    take_ = taken(errors);
    KeypointTake edited = follow().shown;
    ASSERT_NE(edited.point(105, 0, BodyPoint::left_knee),
              take_.point(105, 0, BodyPoint::left_knee));
    apply_keypoint_edits(
        *read_edits(R"({"edit": "exchange", "camera": "camera1", "first": 105, "last": 105})", "e"),
        rig_,
        edited);
    EXPECT_EQ(edited.at(105, 0), take_.at(105, 0));
}

TEST_F(FollowedJoints, edits_of_markers_and_of_nothing_are_refused_in_one_line) {
    const auto why = [&](const char* line) {
        const auto edits = read_edits(line, "e");
        EXPECT_TRUE(edits) << line;
        const auto followed = follow_keypoints(rig_, take_, *edits);
        return followed ? std::string() : followed.error().message;
    };
    EXPECT_EQ(why(R"({"edit": "fill", "marker": "nose", "first": 1, "last": 2})"),
              "edit 1: swap and fill are for markers; without them there are set, hide and "
              "exchange");
    EXPECT_EQ(why(R"({"edit": "hide", "marker": "c7", "first": 1, "last": 2})"),
              "edit 1: \"c7\" is none of the joints that a network sees");
    EXPECT_EQ(why(R"({"edit": "exchange", "camera": "left", "first": 1, "last": 2})"),
              "edit 1: there is no camera \"left\"");
    EXPECT_NE(
        why(R"({"edit": "set", "frame": 1, "camera": "camera1", "marker": "nose", "u": 9999, "v": 1})"),
        "");
    EXPECT_EQ(why(R"({"edit": "hide", "camera": "camera1", "first": 9000, "last": 9001})"), "")
        << "frames that there are not are passed over";
}

}  // namespace
}  // namespace raks::capture
