// Figures of joint positions: what they are made of, how they are learnt and kept.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "motion/figures/figure_hmm.hpp"
#include "tests/motion/figures/small_figure.hpp"
#include "tests/support/text.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

FigureTrainingOptions position_options(int states = 16) {
    FigureTrainingOptions options = test::known_options(states);
    options.features = FigureFeatures::positions;
    return options;
}

const FigureModel& good_positions() {
    static const FigureModel model =
        test::learnt(test::known_dance(3), 3, position_options(4)).model;
    return model;
}

PartModel part_of_positions(Part which) {
    PartModel part;
    part.part = which;
    part.features = FigureFeatures::positions;
    for (const Bone bone : default_joints(which, part.features)) {
        part.joints.push_back({bone});
    }
    return part;
}

TEST(PositionFeatures, are_the_joints_places_seen_from_under_the_hips) {
    const TrainingClip clip = test::known_dance(1, 2.0);
    const Skeleton body = scaled(mannequin_skeleton(), 0.9F);
    const PartModel lower = part_of_positions(Part::lower);
    const FeatureTrack root = features_of(clip.poses, lower, 24, body);
    const std::vector<RootPlace> places = integrate_root(root, 24, {});
    for (const Part which : parts_of(FigureFeatures::positions)) {
        const PartModel part = part_of_positions(which);
        const FeatureTrack track = features_of(clip.poses, part, 24, body);
        ASSERT_EQ(track.columns, which == Part::lower ? 3U + 3U * 8U : 3U * 10U);
        for (std::size_t i = 0; i < clip.poses.size(); i += 7) {
            const WorldPose world = world_pose(body, clip.poses[i]);
            for (std::size_t j = 0; j < part.joints.size(); ++j) {
                const glm::dvec3 place = world_place(
                    track.row(i).subspan(part.root_features() + 3 * j, 3), places[i], 1.0);
                const glm::dvec3 expected(world.position(part.joints[j].bone));
                EXPECT_LT(glm::distance(place, expected), 1e-4) << i << ", joint " << j;
            }
        }
    }
}

TEST(PositionFeatures, do_not_know_where_the_dance_stands_nor_which_way_it_faces) {
    const TrainingClip clip = test::known_dance(1, 0.7);
    std::vector<Pose> elsewhere = clip.poses;
    const glm::quat turn = glm::angleAxis(2.1F, glm::vec3(0, 1, 0));
    for (Pose& pose : elsewhere) {
        pose.hips_position = turn * pose.hips_position + glm::vec3(3.0F, 0.0F, -2.0F);
        pose.rotation(Bone::hips) = turn * pose.rotation(Bone::hips);
    }
    for (const Part which : parts_of(FigureFeatures::positions)) {
        const FeatureTrack here = features_of(clip.poses, part_of_positions(which), 24);
        const FeatureTrack there = features_of(elsewhere, part_of_positions(which), 24);
        for (std::size_t i = 0; i < here.values.size(); ++i) {
            ASSERT_NEAR(here.values[i], there.values[i], 1e-4) << i;
        }
    }
}

TEST(PositionFigure, learns_the_known_dance) {
    const FigureModel model = test::learnt(test::known_dance(4, 0.25), 4, position_options()).model;
    const FigureModel angles =
        test::learnt(test::known_dance(4, 0.25), 4, test::known_options()).model;
    EXPECT_TRUE(validate(model));
    ASSERT_EQ(model.parts.size(), 2U);
    EXPECT_EQ(model.part(Part::upper).states.size(), 16U);
    EXPECT_EQ(&model.root_part(), &model.part(Part::lower));
    // What both kinds tell is the same.
    EXPECT_NEAR(model.net_turn, angles.net_turn, 1e-9);
    EXPECT_NEAR(model.net_displacement.x, angles.net_displacement.x, 1e-9);
    EXPECT_EQ(model.source_hips_height, angles.source_hips_height);
    EXPECT_EQ(model.contact, angles.contact);
    EXPECT_EQ(model.peak_toe_speed, angles.peak_toe_speed);
    // The left ankle swings under a knee that bends by 0.5 + 0.4 sin(phase): middle of state 4.
    const PartModel& lower = model.part(Part::lower);
    ASSERT_EQ(lower.joints[2].bone, Bone::left_foot);
    const double bend = 0.5 + 0.4 * std::sin(2.0 * M_PI * 4.5 / 16.0);
    const Skeleton body = source_body(model);
    const double shin = static_cast<double>(-body.offsets[index_of(Bone::left_foot)].y);
    const double knee = lower.states[4].mean[kTravelFeatures + 4];
    const double ankle = lower.states[4].mean[kTravelFeatures + 7];
    EXPECT_NEAR(knee - ankle, shin * std::cos(bend), 0.03);
    EXPECT_NEAR(lower.states[4].mean[1], 0.0, 0.05);  // forward: turns round in a quarter
    EXPECT_GT(lower.states[0].mean[1], 0.1);
}

TEST(PositionFigure, is_told_from_another_by_its_likelihood) {
    const FigureModel model = test::learnt(test::known_dance(3), 3, position_options()).model;
    const std::vector<FigureRepeat> repeats = test::known_repeats(2);
    const std::vector<TrainingClip> same = {test::known_dance(2)};
    std::vector<TrainingClip> other = same;
    for (Pose& pose : other[0].poses) {
        pose = mirrored(pose);
    }
    for (const Part part : parts_of(FigureFeatures::positions)) {
        const Expected<double> own = score_repeats(model, part, same, repeats, 10.0);
        const Expected<double> mirror = score_repeats(model, part, other, repeats, 10.0);
        ASSERT_TRUE(own && mirror);
        EXPECT_GT(*own, *mirror + 1.0);
    }
}

TEST(PositionFigure, one_repeat_and_joints_that_never_move_still_give_a_valid_model) {
    TrainingClip still = test::known_dance(1);
    EXPECT_TRUE(validate(test::learnt(still, 1, position_options()).model));
    for (Pose& pose : still.poses) {
        pose = still.poses[0];
    }
    EXPECT_TRUE(validate(test::learnt(still, 1, position_options()).model));
}

TEST(PositionFigureFile, reads_back_the_same_bits_and_says_its_version) {
    const std::string text = figure_text(good_positions());
    EXPECT_NE(text.find("\"version\": 2"), std::string::npos);
    EXPECT_NE(text.find("\"features\": \"positions\""), std::string::npos);
    const Expected<FigureModel> again = parse_figure(text, "known.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(figure_text(*again), text);
    EXPECT_EQ(again->part(Part::upper).states[2].mean,
              good_positions().part(Part::upper).states[2].mean);
}

TEST(PositionFigureFile, refuses_bad_files_in_one_line) {
    const std::string good = figure_text(good_positions());
    const auto replaced = [&](const std::string& from, const std::string& to) {
        return raks::test::replaced(good, from, to);
    };
    const struct {
        std::string text;
        std::string message;
    } table[] = {
        {replaced("\"positions\"", "\"colours\""),
         "x.json: features is \"colours\", which is unknown; train the figure again"},
        {replaced("\"positions\"", "\"angles\""),
         "x.json: parts has 2 entries, must have 3; train the figure again"},
        {replaced("\"upper\"", "\"torso\""), "x.json: parts[0].part must be upper of positions"},
        {replaced("\"chest\"", "\"tail\""),
         "x.json: parts[0].joints[1].bone is \"tail\", which is unknown; train the figure again"},
        {replaced("\"chest\"", "\"neck\""), "x.json: parts[0].joints[1] must be chest"},
        {replaced("\"mean\": [", "\"mean\": [1e9,"), "x.json: parts[0].states[0].mean has 31"},
        {replaced("\"variance\": [", "\"variance\": [-"),
         "x.json: parts[0].states[0].variance[0] is -"},
        {replaced("\"version\": 2", "\"version\": 3"), "x.json: version 3 is newer than 2"},
    };
    for (const auto& row : table) {
        const Expected<FigureModel> model = parse_figure(row.text, "x.json");
        ASSERT_FALSE(model) << row.message;
        EXPECT_EQ(model.error().message.substr(0, row.message.size()), row.message);
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    }
}

TEST(PositionFigureFile, survives_cuts_and_flipped_bytes) {
    test::expect_survives_damage(figure_text(good_positions()), 6);
}

}  // namespace
}  // namespace raks::motion
