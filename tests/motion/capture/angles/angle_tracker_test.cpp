// A body is followed through points of a studio in which everything is known.
#include "motion/capture/angles/angle_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "motion/capture/angles/angle_errors.hpp"
#include "motion/capture/tracking/track_errors.hpp"
#include "tests/motion/capture/filmed_swing.hpp"

namespace raks::capture {
namespace {

/// A take of a second, at 30 frames a second.
struct AngleScene : raks::test::FilmedSwing {
    explicit AngleScene(const StudioOptions& options = {}, double seconds = 1.0, int cameras = 6)
        : FilmedSwing(seconds, options, MarkerColours::five, cameras) {}

    /// Takes away what all cameras saw in the pictures [first, last).
    void blind(std::size_t first, std::size_t last) {
        for (SeenFilm& film : take.seen.films) {
            for (std::size_t i = first; i < std::min(last, film.pictures.size()); ++i) {
                film.pictures[i].detections.clear();
            }
        }
    }

    [[nodiscard]] Expected<AngleStages> follow(AngleTrackerOptions angles = {},
                                               const std::vector<Edit>& edits = {}) const {
        angles.body = BodyKind::paper;
        angles.filter.particles = 100;
        TrackerOptions options;
        options.frames_per_second = take.truth.frames_per_second;
        options.first_time = 0.0;
        options.check_order = false;
        return track_angles({rig, markers, take.seen, clocks, take.labels, edits}, options, angles);
    }

    [[nodiscard]] AngleErrors errors(const AngleStages& followed) const {
        return angle_errors(
            followed.angles, BodyModel(BodyKind::paper), followed.shape, poses, 60.0);
    }
};

TEST(AngleTracker, follows_a_body) {
    const AngleScene scene;
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    const AngleErrors errors = scene.errors(*followed);
    EXPECT_EQ(errors.frames, 30U);
    EXPECT_EQ(errors.lost, 0U);
    EXPECT_LT(errors.mean, 0.007);
    // The twist of a straight limb is told by markers 5 cm beside it, at 7 mm of noise.
    EXPECT_LT(errors.angle(), 2.5);
    // The markers' places are measured where the postures have them, so they are as good as those
    // that are followed by themselves.
    const auto tracks = track_errors(followed->stages.smoothed, scene.take.truth);
    ASSERT_TRUE(tracks);
    EXPECT_LT(tracks->mean, 0.006);
    EXPECT_EQ(tracks->wrong, 0U);
}

// By themselves half of the markers are lost then: each needs three views to be found again.
TEST(AngleTracker, three_cameras_are_enough_for_five_colours) {
    const AngleScene scene({}, 2.0, 3);
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_EQ(scene.errors(*followed).lost, 0U);
    EXPECT_LT(scene.errors(*followed).mean, 0.02);
    const auto tracks = track_errors(followed->stages.smoothed, scene.take.truth);
    ASSERT_TRUE(tracks);
    EXPECT_LT(tracks->wrong_share(), 0.12);
}

TEST(AngleTracker, keeps_what_is_done_when_it_is_stopped) {
    const AngleScene scene;
    AngleTrackerOptions options;
    options.progress = [](double share) { return share < 0.3; };
    const auto followed = scene.follow(options);
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_FALSE(followed->angles.is_lost[5]);
    EXPECT_TRUE(followed->angles.is_lost[20]);
    EXPECT_EQ(followed->stages.smoothed.at(5, 0).source, PlaceSource::seen);
    EXPECT_EQ(followed->stages.smoothed.at(20, 0).source, PlaceSource::lost);
}

TEST(AngleTracker, a_hidden_marker_is_told_by_the_body) {
    const AngleScene scene;
    const auto head = scene.markers.index_of("head");
    Edit hide;
    hide.kind = EditKind::hide;
    hide.marker = "head";
    hide.first = 5;
    hide.last = 12;
    const auto followed = scene.follow({}, {hide});
    ASSERT_TRUE(followed) << followed.error().message;
    const MarkerPlace& place = followed->stages.smoothed.at(8, *head);
    EXPECT_EQ(place.source, PlaceSource::filled);
    EXPECT_EQ(place.views, 0);
    EXPECT_LT(glm::distance(place.place, scene.take.truth.at(8, *head).place), 0.02);
}

TEST(AngleTracker, is_lost_where_nothing_is_seen_and_says_so) {
    AngleScene scene;
    scene.blind(20, 30);
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_FALSE(followed->angles.is_lost[19]);
    EXPECT_TRUE(followed->angles.is_lost[20]);
    EXPECT_TRUE(followed->angles.is_lost[29]);
    const Tracks& tracks = followed->stages.smoothed;
    EXPECT_EQ(tracks.at(25, 0).source, PlaceSource::lost);
    EXPECT_TRUE(std::any_of(tracks.flags.begin(), tracks.flags.end(), [](const Flag& flag) {
        return flag.doubt == Doubt::lost && flag.first <= 25 && flag.last >= 25;
    }));
}

TEST(AngleTracker, finds_the_body_again_by_itself) {
    AngleScene scene({}, 2.0);
    scene.blind(20, 40);  // meanwhile the dancer turns by 1.7 radians
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_TRUE(followed->angles.is_lost[30]);
    AngleTrack after = followed->angles;
    after.first_time = after.time_of(42);
    after.states.erase(after.states.begin(), after.states.begin() + 42);
    after.is_lost.erase(after.is_lost.begin(), after.is_lost.begin() + 42);
    const AngleErrors errors =
        angle_errors(after, BodyModel(BodyKind::paper), followed->shape, scene.poses, 60.0);
    EXPECT_EQ(errors.frames, 18U);
    EXPECT_EQ(errors.lost, 0U);
    EXPECT_LT(errors.mean, 0.01);
}

TEST(AngleTracker, says_in_one_line_that_labels_are_too_few) {
    AngleScene scene;
    std::erase_if(scene.take.labels, [](const MarkerLabel& label) {
        return label.marker != "head" && label.marker != "left_wrist";
    });
    const auto followed = scene.follow();
    ASSERT_FALSE(followed);
    EXPECT_EQ(
        followed.error().message,
        "no moment has 3 markers of the trunk that are labelled in two cameras each; run raks "
        "capture label");
}

TEST(AngleTrack, reads_back_as_it_was_written) {
    const AngleScene scene;
    AngleTrackerOptions options;
    options.progress = [](double share) { return share < 0.3; };
    const auto followed = scene.follow(options);
    ASSERT_TRUE(followed);
    const BodyModel model(BodyKind::paper);
    const auto read = read_angles(angles_text(followed->angles, model), "x", model);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->states.size(), followed->angles.states.size());
    EXPECT_EQ(read->is_lost, followed->angles.is_lost);
    EXPECT_NEAR(read->frames_per_second, 30.0, 1e-9);
    for (std::size_t joint = 0; joint < model.joints().size(); ++joint) {
        EXPECT_LT(glm::distance(model.turn_of(read->states[5], joint),
                                model.turn_of(followed->angles.states[5], joint)),
                  1e-9);
    }
    // Where it is lost, the nearest posture before stands in.
    EXPECT_EQ(read->states[20].hips, read->states[19].hips);
}

TEST(AngleTrack, says_what_is_wrong_with_a_file) {
    const BodyModel model(BodyKind::paper);
    const std::string head = "frame,time,joint,x,y,z,deviation\n";
    const auto error_of = [&](const std::string& text) {
        const auto read = read_angles(text, "a.csv", model);
        return read ? std::string() : read.error().message;
    };
    EXPECT_EQ(error_of("x\n"),
              "a.csv: is not a table of angles: its first line must be "
              "frame,time,joint,x,y,z,deviation");
    EXPECT_EQ(error_of(head), "a.csv: needs two or more complete frames");
    EXPECT_EQ(error_of(head + "0,0,place,0,1,2\n"),
              "a.csv: line 2: has 6 cells, needs 7: frame,time,joint,x,y,z,deviation");
    EXPECT_EQ(error_of(head + "0,0,place,0,1e9,2,0\n"), "a.csv: line 2: x, y and z must be metres");
    EXPECT_EQ(error_of(head + "0,0,place,0,1,2,0\n0,0,hips,0,99,0,0\n"),
              "a.csv: line 3: x, y and z must be radians within three turns");
    EXPECT_EQ(error_of(head + "0,0,place,0,1,2,0\n0,0,spine,0,0,0,0\n"),
              "a.csv: line 3: has joint \"spine\" where \"hips\" should follow; is it of another "
              "body (raks capture track --method angles)?");
    EXPECT_EQ(error_of(head + "1,0,place,0,1,2,0\n"), "a.csv: line 2: frame 1 is out of order");
}

}  // namespace
}  // namespace raks::capture
