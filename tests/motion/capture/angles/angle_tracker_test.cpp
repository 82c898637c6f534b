// A body is followed through points of a studio in which everything is known.
#include "motion/capture/angles/angle_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "motion/capture/angles/angle_errors.hpp"
#include "motion/capture/angles/first_posture.hpp"
#include "motion/capture/angles/unsure_joints.hpp"
#include "motion/capture/solving/frame_fit.hpp"
#include "motion/capture/tracking/track_errors.hpp"
#include "tests/motion/capture/angles/angle_scene.hpp"
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
        angles.body = BodyModel(BodyKind::paper);
        angles.fits_body = fits_body;
        return follow_by(angles, edits);
    }

    /// With the body of the options.
    [[nodiscard]] Expected<AngleStages> follow_by(AngleTrackerOptions angles,
                                                  const std::vector<Edit>& edits = {}) const {
        angles.filter.particles = 100;
        TrackerOptions options;
        options.frames_per_second = take.truth.frames_per_second;
        options.first_time = 0.0;
        options.check_order = false;
        return track_angles({rig, markers, take.seen, clocks, take.labels, edits}, options, angles);
    }

    bool fits_body = false;  ///< the mannequin's is known

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

TEST(AngleTracker, what_a_person_sets_is_seen) {
    AngleScene scene;
    scene.blind(10, 11);
    EXPECT_TRUE(scene.follow()->angles.is_lost[10]);
    std::vector<Edit> edits;
    for (const std::string& marker : scene.take.truth.markers) {
        const MarkerPlace& place = scene.take.truth.at(10, *scene.markers.index_of(marker));
        for (const std::size_t camera : {0U, 1U, 2U}) {
            const auto pixel = project(scene.rig.cameras[camera], place.place);
            ASSERT_TRUE(pixel);
            Edit set;
            set.marker = marker;
            set.camera = scene.rig.cameras[camera].name;
            set.first = set.last = 10;
            set.pixel = *pixel;
            edits.push_back(set);
        }
    }
    const auto followed = scene.follow({}, edits);
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_FALSE(followed->angles.is_lost[10]);
    EXPECT_EQ(followed->stages.smoothed.at(10, *scene.markers.index_of("head")).source,
              PlaceSource::seen);
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

TEST(AngleTracker, begins_without_labels) {
    AngleScene scene;
    scene.take.labels.clear();
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_EQ(scene.errors(*followed).lost, 0U);
    EXPECT_LT(scene.errors(*followed).mean, 0.009);
}

TEST(AngleTracker, says_in_one_line_that_there_are_neither_labels_nor_a_body) {
    AngleScene scene;
    scene.take.labels.clear();
    scene.blind(0, 30);
    const auto followed = scene.follow();
    ASSERT_FALSE(followed);
    EXPECT_EQ(followed.error().message,
              "no body is found in the first 10 s, and there are no labels: begin with arms held "
              "out to the sides, all markers in view, or run raks capture label");
}

TEST(FirstPosture, says_in_one_line_that_labels_are_not_on_the_body) {
    const raks::test::SeenPosture scene(MarkerColours::unique);
    const auto places = marker_places_of(scene.context(), scene.state);
    const auto begun_with = [&](const glm::dvec3& away) {
        TrackRunInput run;
        run.rig = &scene.rig;
        run.classes = scene.markers.classes();
        for (std::size_t marker = 0; marker < places.size(); ++marker) {
            const bool is_away = !is_of_trunk(scene.bones[marker]);
            const glm::dvec3 place = places[marker] + (is_away ? away : glm::dvec3(0.0));
            for (std::size_t camera = 0; camera < scene.rig.cameras.size(); ++camera) {
                const auto pixel = project(scene.rig.cameras[camera], place);
                run.said.push_back({0, camera, marker, *pixel, 0.0});
            }
        }
        return posture_by_labels(scene.context(), run);
    };
    const auto right = begun_with(glm::dvec3(0.0));
    ASSERT_TRUE(right && *right) << right.error().message;
    // Somebody else's arms and legs.
    const auto wrong = begun_with({0.9, 0.0, 0.0});
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("labelled markers are not on the body: they are 20 cm"),
              std::string::npos)
        << wrong.error().message;
}

TEST(AngleTracker, says_in_one_line_that_limits_exclude_the_first_posture) {
    AngleScene scene;
    std::vector<TurningJoint> joints = BodyModel(BodyKind::paper).joints();
    for (TurningJoint& joint : joints) {
        joint.highest = joint.name == "leftLowerArm" ? 0.1 : joint.highest;
        joint.usual_angle = joint.name == "leftLowerArm" ? 0.05 : joint.usual_angle;
    }
    AngleTrackerOptions options;
    options.body = BodyModel(joints);
    const auto followed = scene.follow_by(options);
    ASSERT_FALSE(followed);
    EXPECT_NE(followed.error().message.find(
                  "the limits exclude the first posture: joint leftLowerArm is at"),
              std::string::npos)
        << followed.error().message;
}

TEST(AngleTracker, says_in_one_line_that_one_camera_is_too_few) {
    AngleScene scene;
    scene.take.seen.films.resize(1);
    std::erase_if(scene.take.labels, [&](const MarkerLabel& label) {
        return label.camera != scene.take.seen.films[0].camera;
    });
    const auto followed = scene.follow();
    ASSERT_FALSE(followed);
    EXPECT_EQ(followed.error().message, "fewer than two films have pictures");
}

TEST(AngleTracker, finds_the_body_again_after_two_seconds_without_any_marker) {
    AngleScene scene({}, 3.4);
    scene.blind(20, 80);
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_TRUE(followed->angles.is_lost[50]);
    EXPECT_EQ(
        std::count(followed->angles.is_lost.begin() + 84, followed->angles.is_lost.end(), true), 0);
}

TEST(AngleTracker, a_camera_whose_clock_jumps_does_not_spoil_the_body) {
    AngleScene scene({}, 2.0);
    SeenFilm& film = scene.take.seen.films[1];
    for (std::size_t i = 20; i < film.pictures.size(); ++i) {
        film.pictures[i].time += 0.4;
    }
    const auto followed = scene.follow();
    ASSERT_TRUE(followed) << followed.error().message;
    EXPECT_EQ(scene.errors(*followed).lost, 0U);
    EXPECT_LT(scene.errors(*followed).mean, 0.02);
}

TEST(AngleTracker, fits_a_wrong_body_first) {
    AngleScene scene({}, 3.0);
    AngleTrackerOptions options;
    options.body_error = 0.05;
    const auto kept = scene.follow(options);
    scene.fits_body = true;
    const auto fitted = scene.follow(options);
    ASSERT_TRUE(fitted && kept);
    EXPECT_LT(scene.errors(*fitted).mean, 0.9 * scene.errors(*kept).mean);
}

TEST(AngleTracker, flags_joints_that_the_particles_do_not_tell) {
    AngleScene scene;
    AngleTrack track;
    const BodyModel model(BodyKind::paper);
    track.states.resize(30);
    track.is_lost.resize(30);
    track.deviations.assign(30, std::vector<double>(model.variables(), 0.05));
    const auto elbow =
        std::find_if(model.joints().begin(), model.joints().end(), [](const TurningJoint& joint) {
            return joint.name == "leftLowerArm";
        });
    for (std::size_t frame = 10; frame < 20; ++frame) {
        track.deviations[frame][elbow->first] = 0.5;
    }
    Tracks tracks;
    tracks.frames_per_second = 30.0;
    std::vector<motion::Bone> bones;
    for (const Marker& marker : scene.markers.markers) {
        bones.push_back(marker.bone);
    }
    flag_unsure_joints(track, model, bones, tracks);
    ASSERT_EQ(tracks.flags.size(), 1U);
    EXPECT_EQ(tracks.flags[0].doubt, Doubt::unsure);
    EXPECT_EQ(scene.markers.markers[tracks.flags[0].marker].name, "left_elbow");
    EXPECT_EQ(tracks.flags[0].first, 10U);
    EXPECT_EQ(tracks.flags[0].last, 19U);
    const auto sureness = joint_sureness(track, model);
    const auto index = static_cast<std::size_t>(elbow - model.joints().begin());
    EXPECT_NEAR(sureness[index].unsure, 1.0 / 3.0, 1e-9);
    EXPECT_NEAR(sureness[index].median, 0.05, 1e-9);
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
