// A camera that is moved while it films is found, and what it sees after that does not count.
#include "motion/capture/tracking/camera_moves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "motion/capture/camera/rotation.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"
#include "motion/capture/tracking/track_errors.hpp"
#include "tests/motion/capture/filmed_swing.hpp"
#include "tests/support/mangled.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;

/// How a camera is moved.
struct Move {
    std::size_t camera = 2;
    double from = 3.0;  ///< seconds
    double to = 1e9;    ///< seconds
    double turn = 0.0;  ///< radians, to the side
    double away = 0.0;  ///< metres, to the side
};

/// A dance of six seconds that `move`'s camera films from another place in between.
test::FilmedSwing moved_scene(const Move& move,
                              const StudioOptions& options,
                              MarkerColours colours) {
    test::FilmedSwing scene(6.0, options, colours);
    Rig other = scene.rig;
    Camera& camera = other.cameras[move.camera];
    camera.rotation = rotation_of({0.0, move.turn, 0.0}) * camera.rotation;
    camera.translation = rotation_of({0.0, move.turn, 0.0}) * camera.translation;
    camera.translation.x += move.away;
    const StudioTake elsewhere = test::film_swing(scene.poses, other, scene.markers, options);
    auto& pictures = scene.take.seen.films[move.camera].pictures;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (pictures[i].time >= move.from && pictures[i].time < move.to) {
            pictures[i] = elsewhere.seen.films[move.camera].pictures[i];
        }
    }
    return scene;
}

TEST(CameraMoves, a_camera_that_was_moved_is_named_with_its_moment_and_counts_no_more) {
    for (const auto colours : {MarkerColours::unique, MarkerColours::five}) {
        for (const Move& move : {Move{.turn = 1.0 * kDegree},
                                 Move{.turn = -8.0 * kDegree},
                                 Move{.away = 0.05},
                                 Move{.camera = 5, .from = 2.0, .away = 0.6}}) {
            const auto scene = moved_scene(move, {}, colours);
            const auto stages = scene.track();
            ASSERT_TRUE(stages) << stages.error().message;
            ASSERT_EQ(stages->moves.size(), 1U) << move.turn << " " << move.away;
            const CameraMove& found = stages->moves.front();
            EXPECT_EQ(found.camera, scene.rig.cameras[move.camera].name);
            EXPECT_NEAR(stages->smoothed.time_of(found.first), move.from, 0.5);
            EXPECT_EQ(found.last + 1, stages->smoothed.frame_count);
            const TrackErrors errors = *track_errors(stages->smoothed, scene.take.truth);
            EXPECT_LT(errors.mean, 0.008);
            EXPECT_LE(errors.wrong_share(), colours == MarkerColours::unique ? 0.005 : 0.05);
        }
    }
}

TEST(CameraMoves, a_camera_that_comes_back_counts_again) {
    const auto scene =
        moved_scene({.from = 2.0, .to = 4.0, .turn = 4.0 * kDegree}, {}, MarkerColours::unique);
    const auto stages = scene.track();
    ASSERT_TRUE(stages);
    ASSERT_EQ(stages->moves.size(), 1U);
    EXPECT_NEAR(stages->smoothed.time_of(stages->moves[0].first), 2.0, 0.5);
    EXPECT_NEAR(stages->smoothed.time_of(stages->moves[0].last), 4.0, 0.5);
    EXPECT_NE(words_of_move(stages->moves[0], stages->smoothed).find("from 2."), std::string::npos)
        << words_of_move(stages->moves[0], stages->smoothed);
}

TEST(CameraMoves, two_cameras_that_were_moved_are_both_found) {
    auto scene = moved_scene({.camera = 0, .from = 2.0, .away = 0.3}, {}, MarkerColours::unique);
    const auto other =
        moved_scene({.camera = 3, .from = 4.0, .turn = 3 * kDegree}, {}, MarkerColours::unique);
    scene.take.seen.films[3] = other.take.seen.films[3];
    const auto stages = scene.track();
    ASSERT_TRUE(stages);
    std::vector<std::string> names;
    for (const CameraMove& move : stages->moves) {
        names.push_back(move.camera);
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names,
              (std::vector<std::string>{scene.rig.cameras[0].name, scene.rig.cameras[3].name}));
}

TEST(CameraMoves, none_is_accused_in_clean_and_in_hard_scenes) {
    for (const auto colours : {MarkerColours::unique, MarkerColours::five}) {
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            const test::FilmedSwing clean(6.0, {.seed = seed}, colours);
            EXPECT_TRUE(clean.track()->moves.empty());
            const test::FilmedSwing hard(
                6.0,
                {.noise = 1.5, .drop = 0.3, .clutter = 6, .clock_error = 0.005, .seed = seed},
                colours);
            EXPECT_TRUE(hard.track()->moves.empty());
        }
    }
}

TEST(CameraMoves, tables_read_back_and_say_what_is_wrong) {
    const std::vector<CameraMove> moves = {{"left", 90, 359, 12.25}, {"right", 0, 0, 0.1}};
    const auto read = read_moves(moves_text(moves), "moved.tsv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, moves);
    const std::string head = "camera\tfirst\tlast\toffset\n";
    const auto why = [](const std::string& text) { return read_moves(text, "m").error().message; };
    EXPECT_NE(why("camera,first").find("first line"), std::string::npos);
    EXPECT_NE(why(head + "left\t9\t3\t1\n").find("line 2"), std::string::npos);
    EXPECT_NE(why(head + "left\t9\t12\tnan\n").find("line 2"), std::string::npos);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        static_cast<void>(read_moves(test::mangled(moves_text(moves), {.seed = seed}), "m"));
    }
}

}  // namespace
}  // namespace raks::capture
