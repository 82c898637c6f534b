// Solving bodies from markers whose truth is known: written dances, other bodies, markers that sit
// elsewhere, noise and gaps.
#include "motion/capture/solving/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "base/dice.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "tests/support/sanitized.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

namespace fs = std::filesystem;
using motion::Pose;

/// What is measured, and the truth behind it.
struct TrueDance {
    BodySize size;
    motion::Skeleton skeleton;
    std::vector<Pose> poses;
    MarkerSet markers = default_markers(MarkerColours::unique);
    Tracks tracks;
};

/// How a dance is measured.
struct Measuring {
    double noise = 0.005;          // metres
    double marker_shift = 0.012;   // metres, each axis
    double part_deviation = 0.03;  // of the logarithm
    double whole = 1.0;            // height / mannequin
    std::size_t frames = 240;
    std::size_t every = 1;                  // poses to a frame of the tracks
    glm::dquat turned{1.0, 0.0, 0.0, 0.0};  // about the vertical
    double spin = 0.0;                      // radians a second about the vertical
};

/// Poses of a written figure.
std::vector<Pose> written_poses(const std::string& file,
                                std::size_t figure,
                                const motion::Skeleton& skeleton,
                                std::size_t frames) {
    const auto dance = motion::load_authored_dance(fs::path(RAKS_SOURCE_DIR) / "tests" / "data" /
                                                   "choreography" / (file + ".toml"));
    EXPECT_TRUE(dance) << dance.error().message;
    motion::EvaluationOptions options;
    options.written = options.tempo = dance->written;
    options.repeats = 8;
    auto poses = motion::evaluate_figure(dance->figures[figure], skeleton, options).poses;
    poses.resize(std::min(frames, poses.size()));
    return poses;
}

void spin(double a_second, std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const double angle = a_second * static_cast<double>(i) / 60.0;
        const auto turn = glm::quat(turned_by({0.0, angle, 0.0}));
        poses[i].hips_position = turn * poses[i].hips_position;
        poses[i].local_rotations[0] = turn * poses[i].local_rotations[0];
    }
}

TrueDance measured(const std::string& file, std::size_t figure, const Measuring& how) {
    Dice dice(1, figure + 10);
    TrueDance dance;
    dance.size.whole = how.whole;
    for (double& part : dance.size.parts) {
        part = std::exp(dice.normal(how.part_deviation));
    }
    for (std::size_t i = 0; i < dance.markers.markers.size(); ++i) {
        dance.size.marker_shifts.emplace_back(dice.normal(how.marker_shift),
                                              dice.normal(how.marker_shift),
                                              dice.normal(how.marker_shift));
        dance.tracks.markers.push_back(dance.markers.markers[i].name);
    }
    dance.skeleton = skeleton_of(dance.size);
    dance.poses = written_poses(file, figure, dance.skeleton, how.frames);
    spin(how.spin, dance.poses);
    const BodyShape shape = shape_of(dance.size, dance.markers);
    dance.tracks.frames_per_second = 60.0 / static_cast<double>(how.every);
    for (std::size_t i = 0; i < dance.poses.size(); i += how.every) {
        const motion::WorldPose world = motion::world_pose(dance.skeleton, dance.poses[i]);
        for (std::size_t k = 0; k < shape.marker_places.size(); ++k) {
            const glm::dvec3 noise(
                dice.normal(how.noise), dice.normal(how.noise), dice.normal(how.noise));
            const glm::vec3 place =
                world.point(dance.markers.markers[k].bone, glm::vec3(shape.marker_places[k]));
            dance.tracks.places.push_back(
                {glm::dvec3(place) + noise, how.noise, 4, PlaceSource::seen});
        }
        ++dance.tracks.frame_count;
    }
    return dance;
}

/// How far a solved dance is from the truth, metres.
struct Distances {
    double joints = 0.0;         // mean of the 19, relative to the hips
    double feet = 0.0;           // mean of both ankles, in the world
    double planted = 0.0;        // 90th percentile of the toes' speed in contact, m/s
    double truly_planted = 0.0;  // that of the truth
    double jerk = 0.0;           // solved / true, root mean square
};

Distances distances(const TrueDance& truth, const SolvedDance& solved) {
    const std::size_t count = std::min(truth.poses.size(), solved.poses.size());
    const auto track = [count](const motion::Skeleton& skeleton, std::vector<Pose> poses) {
        poses.resize(count);
        return motion::body_track(skeleton, poses, 60.0);
    };
    const motion::BodyTrack is = track(truth.skeleton, truth.poses);
    const motion::BodyTrack got = track(solved.skeleton, solved.poses);
    Distances found;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < is.joints[i].size(); ++k) {
            found.joints += glm::distance(is.joints[i][k] - is.joints[i][motion::kHips],
                                          got.joints[i][k] - got.joints[i][motion::kHips]);
        }
        for (std::size_t side = 0; side < 2; ++side) {
            found.feet += glm::distance(is.feet[i][side].ankle, got.feet[i][side].ankle);
        }
    }
    found.joints /= static_cast<double>(count * motion::kBodyBones.size());
    found.feet /= static_cast<double>(count * 2);
    const auto planted_of = [](const motion::BodyTrack& body) {
        std::vector<double> speeds = motion::contacts_of(body, 0.0).toe_speeds;
        std::sort(speeds.begin(), speeds.end());
        return speeds.empty() ? 0.0 : speeds[speeds.size() * 9 / 10];
    };
    found.planted = planted_of(got);
    found.truly_planted = planted_of(is);
    found.jerk = motion::jerk_of(got).rms / motion::jerk_of(is).rms;
    return found;
}

TEST(Solve, finds_joints_feet_and_motion_of_another_body_with_markers_elsewhere) {
    struct Case {
        const char* dance;
        std::size_t figure;
        double whole;
    };
    for (const Case& at : {Case{"belly", 0, 1.0}, Case{"rock", 1, 1.08}, Case{"hiphop", 2, 0.92}}) {
        Measuring how;
        how.whole = at.whole;
        const TrueDance truth = measured(at.dance, at.figure, how);
        const auto solved =
            solve(truth.tracks, truth.markers, {.height = kMannequinHeight * at.whole});
        ASSERT_TRUE(solved) << solved.error().message;
        ASSERT_EQ(solved->poses.size(), truth.poses.size());
        const Distances away = distances(truth, *solved);
        EXPECT_LT(away.joints, 0.03) << at.dance;
        EXPECT_LT(away.feet, 0.03) << at.dance;
        EXPECT_LT(away.planted, 0.1 + away.truly_planted) << at.dance;
        EXPECT_GT(away.jerk, 0.5) << at.dance;
        EXPECT_LT(away.jerk, 1.3) << at.dance;
        EXPECT_NEAR(solved->size.whole, at.whole, 0.03) << at.dance;
        if (raks::test::kIsSanitized) {
            break;
        }
    }
}

TEST(Solve, finds_the_height_from_the_markers_alone) {
    if (raks::test::kIsSanitized) {
        GTEST_SKIP() << "another test does it under a sanitizer";
    }
    Measuring how;
    how.whole = 1.12;
    how.part_deviation = 0.0;
    how.marker_shift = 0.005;
    const TrueDance truth = measured("rock", 0, how);
    const auto solved = solve(truth.tracks, truth.markers);
    ASSERT_TRUE(solved) << solved.error().message;
    EXPECT_NEAR(solved->size.whole, 1.12, 0.05);
}

TEST(Solve, follows_a_dancer_who_spins_and_bridges_gaps) {
    if (raks::test::kIsSanitized) {
        GTEST_SKIP() << "another test does it under a sanitizer";
    }
    Measuring how;
    how.spin = 6.0;
    TrueDance truth = measured("waltz", 0, how);
    Dice dice(3, 3);
    for (std::size_t marker = 0; marker < truth.tracks.markers.size(); ++marker) {
        const auto from = static_cast<std::size_t>(dice.whole(20, 200));
        for (std::size_t frame = from; frame < from + 15; ++frame) {
            truth.tracks.at(frame, marker) = MarkerPlace{};
        }
    }
    const auto solved = solve(truth.tracks, truth.markers, {.height = kMannequinHeight});
    ASSERT_TRUE(solved) << solved.error().message;
    const Distances away = distances(truth, *solved);
    EXPECT_LT(away.joints, 0.025);
    EXPECT_LT(away.feet, 0.04);
}

TEST(Solve, ends_where_the_dancer_has_left) {
    Measuring how;
    how.frames = 60;
    TrueDance truth = measured("waltz", 0, how);
    for (std::size_t frame = 40; frame < truth.tracks.frame_count; ++frame) {
        for (std::size_t marker = 0; marker < truth.tracks.markers.size(); ++marker) {
            truth.tracks.at(frame, marker) = MarkerPlace{};
        }
    }
    const auto solved = solve(truth.tracks, truth.markers, {.height = kMannequinHeight});
    ASSERT_TRUE(solved) << solved.error().message;
    EXPECT_EQ(solved->poses.size(), 40U);
}

TEST(Solve, gives_the_rate_that_was_asked_for) {
    Measuring how;
    how.every = 2;
    how.frames = 120;
    const TrueDance truth = measured("house", 0, how);
    const auto solved = solve(truth.tracks, truth.markers, {.frames_per_second = 60.0});
    ASSERT_TRUE(solved) << solved.error().message;
    EXPECT_EQ(solved->frames_per_second, 60.0);
    EXPECT_EQ(solved->poses.size(), 119U);
    EXPECT_LT(distances(truth, *solved).joints, 0.025);
    const auto slow = solve(truth.tracks, truth.markers, {.frames_per_second = 25.0});
    ASSERT_TRUE(slow);
    EXPECT_EQ(slow->poses.size(), 50U);
}

TEST(Solve, of_the_papers_body_moves_only_its_joints) {
    const TrueDance truth = measured("rock", 0, {});
    const auto solved = solve(truth.tracks, truth.markers, {.body = BodyModel(BodyKind::paper)});
    ASSERT_TRUE(solved) << solved.error().message;
    for (const Pose& pose : solved->poses) {
        EXPECT_EQ(pose.rotation(motion::Bone::chest), motion::kNoRotation);
        EXPECT_EQ(pose.rotation(motion::Bone::left_foot), motion::kNoRotation);
    }
    EXPECT_LT(distances(truth, *solved).joints, 0.06);
}

TEST(Solve, tells_a_marker_that_leaves_the_body_and_does_not_follow_it) {
    if (raks::test::kIsSanitized) {
        GTEST_SKIP() << "another test does it under a sanitizer";
    }
    Measuring how;
    how.frames = 200;
    TrueDance truth = measured("rock", 0, how);
    const std::size_t wrist = *truth.markers.index_of("left_wrist");
    for (std::size_t frame = 80; frame < 110; ++frame) {
        truth.tracks.at(frame, wrist).place += glm::dvec3(0.0, 0.4, 0.0);
    }
    const auto solved = solve(truth.tracks, truth.markers, {.height = kMannequinHeight});
    ASSERT_TRUE(solved) << solved.error().message;
    ASSERT_EQ(solved->doubts.size(), 1U);
    EXPECT_NE(solved->doubts[0].what.find("left_wrist is up to"), std::string::npos);
    EXPECT_EQ(solved->doubts[0].first, 80U);
    EXPECT_EQ(solved->doubts[0].last, 109U);
    EXPECT_LT(distances(truth, *solved).joints, 0.025);
}

TEST(Solve, soles_are_not_under_the_floor) {
    if (raks::test::kIsSanitized) {
        GTEST_SKIP() << "another test does it under a sanitizer";
    }
    const TrueDance truth = measured("rock", 1, {});
    const auto solved = solve(truth.tracks, truth.markers);
    ASSERT_TRUE(solved);
    for (const Pose& pose : solved->poses) {
        const motion::WorldPose world = motion::world_pose(solved->skeleton, pose);
        for (const motion::Side side : motion::kSides) {
            EXPECT_GT(motion::toe_tip(solved->skeleton, world, side).y, -0.006F);
            EXPECT_GT(motion::foot_point(world, side, solved->skeleton.heel).y, -0.006F);
        }
    }
}

TEST(Solve, gives_the_same_bits_again) {
    Measuring how;
    how.frames = 60;
    const TrueDance truth = measured("belly", 1, how);
    const auto once = solve(truth.tracks, truth.markers);
    const auto again = solve(truth.tracks, truth.markers);
    ASSERT_TRUE(once && again);
    for (std::size_t i = 0; i < once->poses.size(); ++i) {
        EXPECT_EQ(once->poses[i].hips_position, again->poses[i].hips_position);
        EXPECT_EQ(once->poses[i].local_rotations, again->poses[i].local_rotations);
    }
    EXPECT_EQ(body_text(*once, truth.markers), body_text(*again, truth.markers));
}

TEST(Solve, refuses_what_is_no_dance_of_a_body) {
    Measuring how;
    how.frames = 30;
    const TrueDance good = measured("rock", 0, how);
    const auto error_of = [](const TrueDance& dance, const SolveOptions& options = {}) {
        const auto solved = solve(dance.tracks, dance.markers, options);
        EXPECT_FALSE(solved);
        return solved ? std::string() : solved.error().message;
    };
    TrueDance renamed = good;
    renamed.tracks.markers[3] = "tail";
    EXPECT_EQ(error_of(renamed),
              "the tracks have a marker \"tail\" that the marker set lacks; name it there");
    TrueDance large = good;
    for (MarkerPlace& place : large.tracks.places) {
        place.place *= 1000.0;
    }
    EXPECT_NE(error_of(large).find("are the cameras' places in metres?"), std::string::npos);
    for (const double factor : {2.0, 0.5, 1.3}) {
        TrueDance scaled = good;
        for (MarkerPlace& place : scaled.tracks.places) {
            place.place *= factor;
        }
        const std::string said = error_of(scaled, {.height = kMannequinHeight});
        const std::size_t at = said.find("in metres; ");
        ASSERT_NE(at, std::string::npos) << said;
        EXPECT_NEAR(std::stod(said.substr(at + 11)), 1.0 / factor, 0.1 / factor) << said;
    }
    TrueDance empty = good;
    std::fill(empty.tracks.places.begin(), empty.tracks.places.end(), MarkerPlace{});
    EXPECT_EQ(error_of(empty),
              "no frame shows 3 markers of the trunk at once (at most 0); track them again");
    TrueDance brief = good;
    brief.tracks.frame_count = 2;
    EXPECT_NE(error_of(brief).find("are too few"), std::string::npos);
    EXPECT_EQ(error_of(good, {.height = 17.1}), "a dancer is 0.8 to 2.5 m tall, not 17.1");
    EXPECT_EQ(error_of(good, {.frames_per_second = std::nan("")}),
              "frames a second are 1 to 1000, not nan");
}

}  // namespace
}  // namespace raks::capture
