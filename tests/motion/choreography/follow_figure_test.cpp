// The follow's part of a written figure: as one with the lead, or his mirror image.
#include "motion/choreography/follow_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/file.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "tests/motion/choreography/small_dance.hpp"

namespace raks::motion {
namespace {

CoupleStyle opposite(double left, double ahead) {
    return {CoupleStyle::Follow::opposite, CoupleHold::closed, {left, ahead}};
}

TEST(FollowFigure, opposite_steps_back_with_the_other_foot_where_the_lead_goes_ahead) {
    const AuthoredFigure lead = dance_of(kSmallDance).figures[0];
    const AuthoredFigure follow = follow_of(lead, opposite(-8.0, 34.0));
    ASSERT_EQ(follow.steps.size(), 2U);
    EXPECT_EQ(follow.steps[0].foot, Side::right);
    EXPECT_NEAR(follow.steps[0].to->x, -16.0, 1e-9);
    EXPECT_NEAR(follow.steps[0].to->y, -6.0, 1e-9);
    EXPECT_EQ(follow.steps[0].on, FootLanding::ball) << "his heel leads, her ball";
    EXPECT_EQ(follow.steps[1].on, FootLanding::touch);
    EXPECT_EQ(follow.steps[1].weight, 0.2);
    // Both turn to the same side of the room, so that the frame turns as one.
    EXPECT_EQ(follow.tracks(Control::chest_yaw)[0].keys[0].value, 8.0);
    EXPECT_EQ(follow.tracks(Control::right_arm_front)[0].rest,
              lead.tracks(Control::left_arm_front)[0].rest);
}

TEST(FollowFigure, opposite_ends_a_half_turn_before_the_lead_again) {
    AuthoredFigure lead = dance_of(kSmallDance).figures[0];
    lead.travel = {10.0, 40.0};
    lead.turn = 180.0;
    const CoupleStyle couple = opposite(-8.0, 34.0);
    const AuthoredFigure follow = follow_of(lead, couple);
    EXPECT_EQ(follow.turn, 180.0);
    // In the lead's frame he ends at (10, 40), turned round; she before him: (10 + 8, 40 - 34).
    // Her frame begins at (-8, 34) and is turned round, too.
    EXPECT_NEAR(follow.travel.x, -(18.0 + 8.0), 1e-9);
    EXPECT_NEAR(follow.travel.y, 34.0 - 6.0, 1e-9);
}

TEST(FollowFigure, mirror_is_the_image_of_the_lead) {
    AuthoredFigure lead = dance_of(kSmallDance).figures[0];
    lead.travel = {10.0, 40.0};
    lead.turn = 90.0;
    const AuthoredFigure follow =
        follow_of(lead, {CoupleStyle::Follow::mirror, CoupleHold::none, {0.0, 90.0}});
    EXPECT_EQ(follow.travel, glm::dvec2(-10.0, 40.0));
    EXPECT_EQ(follow.turn, -90.0);
    EXPECT_EQ(follow.steps[0].foot, Side::right);
    EXPECT_EQ(follow.steps[0].to, glm::dvec2(-16.0, 6.0));
    EXPECT_EQ(follow.steps[0].on, FootLanding::heel);
    EXPECT_EQ(follow.tracks(Control::chest_yaw)[0].keys[0].value, -8.0);
}

TEST(FollowFigure, written_steps_come_before_those_made) {
    const std::string text =
        replaced("body.chest.yaw",
                 "follow_steps = [ { foot = \"l\", at = 1, to = [5, 5] } ]\nbody.chest.yaw");
    const AuthoredFigure follow = follow_of(dance_of(text).figures[0], opposite(0.0, 40.0));
    ASSERT_EQ(follow.steps.size(), 1U);
    EXPECT_EQ(follow.steps[0].to, glm::dvec2(5.0, 5.0));
}

TEST(FollowFigure, the_table_of_couples_is_read_and_its_faults_are_told) {
    const auto with = [](const std::string& couple) {
        return parse_authored_dance(replaced("[style]", "[couple]\n" + couple + "\n[style]"),
                                    "x.toml");
    };
    const auto dance = with("follow = \"mirror\"\nhold = \"closed\"\napart = [-8, 34]");
    ASSERT_TRUE(dance) << dance.error().message;
    ASSERT_TRUE(dance->couple);
    EXPECT_EQ(dance->couple->follow, CoupleStyle::Follow::mirror);
    EXPECT_EQ(dance->couple->hold, CoupleHold::closed);
    EXPECT_NEAR(dance->couple->form().apart->y, 0.34, 1e-12);
    EXPECT_FALSE(dance_of(kSmallDance).couple);
    for (const auto& [bad, said] : {std::pair("follow = \"miror\"", "mirror"),
                                    std::pair("hold = \"close\"", "closed"),
                                    std::pair("apart = [1]", "apart"),
                                    std::pair("aparts = [1, 2]", "apart")}) {
        const auto refused = with(bad);
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().message.find(said), std::string::npos) << refused.error().message;
    }
}

TEST(FollowFigure, of_the_shipped_dances_stay_before_the_lead) {
    std::size_t couples = 0;
    const auto files = list_folder(std::string(RAKS_SOURCE_DIR) + "/config/choreographies");
    ASSERT_TRUE(files) << files.error().message;
    for (const auto& path : *files) {
        const auto dance = load_authored_dance(path);
        ASSERT_TRUE(dance) << dance.error().message;
        if (!dance->couple || dance->couple->follow != CoupleStyle::Follow::opposite) {
            continue;
        }
        ++couples;
        for (const AuthoredFigure& figure : dance->figures) {
            EvaluationOptions how;
            how.written = how.tempo = dance->written;
            how.repeats = 2;
            how.noise = 0.0;
            const auto lead = evaluate_figure(figure, mannequin_skeleton(), how);
            const auto follow =
                evaluate_figure(follow_of(figure, *dance->couple), mannequin_skeleton(), how);
            const glm::dvec2 apart = 0.01 * dance->couple->apart;
            for (std::size_t i = 0; i < lead.poses.size(); ++i) {
                const glm::vec3& her = follow.poses[i].hips_position;
                // Her frame faces his from `apart`.
                const glm::vec2 place{static_cast<float>(apart.x) - her.x,
                                      static_cast<float>(apart.y) - her.z};
                const glm::vec3& his = lead.poses[i].hips_position;
                const double distance = glm::distance(place, glm::vec2(his.x, his.z));
                EXPECT_GT(distance, 0.33) << figure.name << " " << i;
                EXPECT_LT(distance, 0.65) << figure.name << " " << i;
            }
        }
    }
    EXPECT_GT(couples, 0U);
}

}  // namespace
}  // namespace raks::motion
