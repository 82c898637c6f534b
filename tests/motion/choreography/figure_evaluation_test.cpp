// From a written figure to poses, against the reference poses of the 28 figures that the format
// was proven on (tests/data/choreography: CC0, made for Raks) and against what must hold for any.
#include "motion/choreography/figure_evaluation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "motion/choreography/figure_check.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/choreography/joint_limits.hpp"
#include "tests/motion/choreography/small_dance.hpp"
#include "tests/support/dances.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

const fs::path kReference = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "choreography";

EvaluationOptions exact(const AuthoredDance& dance, int repeats) {
    EvaluationOptions options;
    options.written = options.tempo = dance.written;
    options.repeats = repeats;
    options.noise = 0.0;
    return options;
}

WorldPose world_at(const EvaluatedFigure& evaluated, double beat) {
    const double frame = evaluated.frame_of(beat);
    const auto i = static_cast<std::size_t>(frame);
    const Pose pose = interpolate(evaluated.poses[i],
                                  evaluated.poses[std::min(i + 1, evaluated.poses.size() - 1)],
                                  static_cast<float>(frame - std::floor(frame)));
    return world_pose(mannequin_skeleton(), pose);
}

/// Squares of distances, gathered.
struct Distance {
    double sum = 0.0;
    int count = 0;
    [[nodiscard]] double rms() const { return std::sqrt(sum / std::max(1, count)); }
};

TEST(FigureEvaluation, lies_within_2_cm_of_the_reference_poses) {
    std::map<std::string, AuthoredDance> dances;
    std::map<std::string, EvaluatedFigure> figures;
    std::map<std::string, Distance> distances;
    Distance all;
    std::ifstream file(kReference / "poses.tsv");
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream row(line);
        std::string dance;
        std::string name;
        std::string joint;
        double beat = 0.0;
        glm::dvec3 place{};
        if (line[0] == '#' || line.rfind("dance\t", 0) == 0 ||
            !(row >> dance >> name >> beat >> joint >> place.x >> place.y >> place.z)) {
            continue;
        }
        // The reference adds the file's bends and turns to this one's mirrored ones.
        if (name == "hip_drop" && joint.find("Leg") == joint.npos && joint != "hips") {
            continue;
        }
        if (dances.count(dance) == 0) {
            auto read = load_authored_dance(kReference / (dance + ".toml"));
            ASSERT_TRUE(read) << read.error().message;
            dances[dance] = *read;
        }
        if (figures.count(name) == 0) {
            const AuthoredFigure* const figure = dances[dance].figure(name);
            ASSERT_NE(figure, nullptr) << name;
            figures[name] = evaluate_figure(*figure, mannequin_skeleton(), exact(dances[dance], 2));
        }
        const auto bone = std::find(kBoneNames.begin(), kBoneNames.end(), joint);
        ASSERT_NE(bone, kBoneNames.end());
        const EvaluatedFigure& evaluated = figures[name];
        const WorldPose world = world_at(evaluated, beat + evaluated.beats);
        const double away = glm::distance(
            glm::dvec3(world.positions[static_cast<std::size_t>(bone - kBoneNames.begin())]),
            place);
        distances[name].sum += away * away;
        ++distances[name].count;
        all.sum += away * away;
        ++all.count;
    }
    EXPECT_EQ(figures.size(), 28U);
    for (const auto& [name, distance] : distances) {
        EXPECT_LT(distance.rms(), name == "hip_drop" ? 0.035 : 0.022) << name;
    }
    EXPECT_LT(all.rms(), 0.0125);
}

TEST(FigureEvaluation, gives_the_same_bits_again_and_others_for_another_seed) {
    const AuthoredDance dance = dance_of(kSmallDance);
    EvaluationOptions options;
    options.repeats = 2;
    const auto once = evaluate_figure(dance.figures[0], mannequin_skeleton(), options);
    const auto again = evaluate_figure(dance.figures[0], mannequin_skeleton(), options);
    ASSERT_EQ(once.poses.size(), again.poses.size());
    for (std::size_t i = 0; i < once.poses.size(); ++i) {
        ASSERT_EQ(once.poses[i].hips_position, again.poses[i].hips_position);
        ASSERT_EQ(once.poses[i].local_rotations, again.poses[i].local_rotations);
    }
    options.seed = 2;
    const auto other = evaluate_figure(dance.figures[0], mannequin_skeleton(), options);
    const auto middle = once.poses.size() / 2;
    EXPECT_GT(glm::distance(once.poses[middle].hips_position, other.poses[middle].hips_position),
              1e-4F);
}

TEST(FigureEvaluation, a_foot_in_contact_stays_where_it_is) {
    const AuthoredDance dance = dance_of(kSmallDance);
    EvaluationOptions options;
    options.repeats = 3;
    const auto evaluated = evaluate_figure(dance.figures[0], mannequin_skeleton(), options);
    std::array<double, 2> furthest{};
    std::array<int, 2> contacts{};
    for (std::size_t i = 1; i < evaluated.poses.size(); ++i) {
        const WorldPose before = world_pose(mannequin_skeleton(), evaluated.poses[i - 1]);
        const WorldPose now = world_pose(mannequin_skeleton(), evaluated.poses[i]);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            if (evaluated.poses[i].foot_contact[s] && evaluated.poses[i - 1].foot_contact[s]) {
                const Bone toes = on_side(Bone::left_toes, side);
                furthest[s] = std::max(
                    furthest[s],
                    static_cast<double>(glm::distance(before.position(toes), now.position(toes))));
                ++contacts[s];
            }
        }
    }
    for (const std::size_t s : {0U, 1U}) {
        EXPECT_GT(contacts[s], 60);
        // The heel strike rolls the toes down over a quarter of a beat: at most 1 cm a frame.
        EXPECT_LT(furthest[s], s == 0 ? 0.01 : 0.001);
    }
}

TEST(FigureEvaluation, a_mirrored_repeat_is_the_other_side_of_the_first) {
    const AuthoredDance dance = dance_of(replaced("beats = 4\n", "beats = 4\nmirror = true\n"));
    AuthoredFigure figure = dance.figures[0];
    figure.style.asym = 0.0;
    figure.style.breath = 0.0;
    const auto evaluated = evaluate_figure(figure, mannequin_skeleton(), exact(dance, 4));
    for (double beat = 4.0; beat < 8.0; beat += 0.37) {
        const WorldPose left = world_at(evaluated, beat);
        const WorldPose right = world_at(evaluated, beat + 4.0);
        for (const Bone bone : {Bone::hips, Bone::head, Bone::left_hand, Bone::left_foot}) {
            const glm::vec3 other = right.position(mirrored(bone));
            const glm::vec3 place{-other.x, other.y, other.z};
            EXPECT_LT(glm::distance(left.position(bone), place), 2e-3F) << beat;
        }
    }
}

double range_of_hips(const EvaluatedFigure& evaluated) {
    double lowest = 9.0;
    double highest = 0.0;
    for (const Pose& pose : evaluated.poses) {
        const double height = static_cast<double>(pose.hips_position.y);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return highest - lowest;
}

TEST(FigureEvaluation, a_jump_is_as_high_as_its_time_in_the_air_allows) {
    auto dance = load_authored_dance(kReference / "rock.toml");
    ASSERT_TRUE(dance);
    const AuthoredFigure& pogo = *dance->figure("pogo");
    EvaluationOptions options = exact(*dance, 2);
    // 0.54 beat at 138 BPM: 9.81 t^2 / 8 = 6.8 cm, and the spring before and after it.
    const double usual = range_of_hips(evaluate_figure(pogo, mannequin_skeleton(), options));
    EXPECT_GT(usual, 0.09);
    EXPECT_LT(usual, 0.17);
    // Slower music does not make it a leap: the flight is 0.28 s at most.
    options.tempo = dance->slowest;
    const double slow = range_of_hips(evaluate_figure(pogo, mannequin_skeleton(), options));
    EXPECT_LT(slow, usual + 0.05);
}

TEST(FigureEvaluation, the_body_is_carried_by_the_foot_that_bears_it) {
    const AuthoredDance dance = dance_of(kSmallDance);
    const auto evaluated = evaluate_figure(dance.figures[0], mannequin_skeleton(), exact(dance, 2));
    // Left at beat 0 with all weight; before it right had 0.2.
    const glm::vec3 hips = world_at(evaluated, 5.3).position(Bone::hips);
    const glm::vec3 left = world_at(evaluated, 5.3).position(Bone::left_foot);
    const glm::vec3 right = world_at(evaluated, 5.3).position(Bone::right_foot);
    EXPECT_LT(std::abs(hips.x - left.x), 0.07F);
    EXPECT_GT(std::abs(hips.x - right.x), 0.2F);
}

TEST(MotionCheck, names_foot_beat_and_distance_of_what_cannot_be_reached) {
    const AuthoredDance dance = dance_of(replaced("to = [-16, 0]", "to = [-130, 0]"));
    const auto faults = faults_in_motion(dance, dance.figures[0], mannequin_skeleton());
    ASSERT_FALSE(faults.empty());
    EXPECT_NE(faults[0].find("x.toml: line 22: figure \"rock_step\": beat "), std::string::npos)
        << faults[0];
    EXPECT_NE(faults[0].find("foot cannot be reached: "), std::string::npos) << faults[0];
    EXPECT_NE(faults[0].find("cm too far"), std::string::npos) << faults[0];
}

TEST(MotionCheck, the_shipped_dances_can_be_danced_at_every_tempo) {
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies")) {
        const auto dance = load_authored_dance(entry.path());
        ASSERT_TRUE(dance) << dance.error().message;
        for (const AuthoredFigure& figure : dance->figures) {
            for (const std::string& fault :
                 faults_in_motion(*dance, figure, mannequin_skeleton())) {
                ADD_FAILURE() << fault;
            }
        }
    }
}

TEST(MotionFaults, a_hand_in_the_body_is_named_with_beat_and_depth) {
    // The left arm hangs along the thigh and turns in front of it, bent, so that the hand is in it.
    const AuthoredDance dance =
        dance_of(replaced("body.chest.yaw",
                          "body.arm.l.up = -88\nbody.arm.l.bend = 4\nbody.hip.roll = 14\n"
                          "body.arm.l.elbow = 0\nbody.chest.yaw"));
    const auto faults = faults_in_motion(dance, dance.figures[0], mannequin_skeleton());
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("figure \"rock_step\": beat "), std::string::npos) << faults[0];
    EXPECT_NE(faults[0].find(" hand goes "), std::string::npos) << faults[0];
    EXPECT_NE(faults[0].find(" cm into the "), std::string::npos) << faults[0];
}

TEST(MotionFaults, no_hand_of_a_shipped_figure_goes_through_the_body) {
    for (const auto& file : raks::test::written_dances()) {
        const auto dance = load_authored_dance(file);
        ASSERT_TRUE(dance) << dance.error().message;
        for (const AuthoredFigure& figure : dance->figures) {
            for (const std::string& fault :
                 faults_in_motion(*dance, figure, mannequin_skeleton())) {
                ADD_FAILURE() << fault;
            }
        }
    }
}

TEST(JointLimits, find_the_joint_that_is_furthest_out) {
    Pose pose;
    pose.rotation(Bone::left_lower_leg) = glm::angleAxis(0.5F, glm::vec3(1, 0, 0));
    pose.rotation(Bone::right_lower_leg) = pose.rotation(Bone::left_lower_leg);
    EXPECT_FALSE(worst_joint(pose));
    pose.rotation(Bone::neck) = glm::angleAxis(0.8F, glm::vec3(1, 0, 0));
    pose.rotation(Bone::head) = glm::angleAxis(0.8F, glm::vec3(1, 0, 0));
    const auto worst = worst_joint(pose);
    ASSERT_TRUE(worst);
    EXPECT_EQ(worst->joint, "neck");
    EXPECT_NEAR(worst->degrees, 1.6 * 180.0 / M_PI, 0.1);
    pose.rotation(Bone::left_lower_leg) = kNoRotation;  // a locked knee
    pose.rotation(Bone::neck) = kNoRotation;
    EXPECT_EQ(worst_joint(pose)->joint, "left knee");
}

}  // namespace
}  // namespace raks::motion
