// The hold over time: taken and let go without a jerk, as the figure says.
#include "motion/dance/hand_hold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// Facing the other, arms half lifted.
Pose dancer(float ahead, float heading) {
    Pose pose;
    pose.hips_position = {0.0F, mannequin_skeleton().hips_height(), ahead};
    pose.rotation(Bone::hips) = glm::angleAxis(heading, glm::vec3(0, 1, 0));
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            glm::angleAxis(-sign * 1.2F, glm::vec3(0, 0, 1));
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            glm::angleAxis(-sign * 1.0F, glm::vec3(0, 1, 0));
    }
    return pose;
}

struct Shown {
    std::vector<float> held;      // firmness of his left hand with her right one, by hop
    std::vector<float> apart;     // between these palms; metres
    std::vector<glm::vec3> hand;  // his left wrist
};

/// `hops` hops of a figure of 8 beats at 3 beats a second that holds from beat 1 to 4, over and
/// over; from `torn` on she is out of reach.
Shown danced(HopIndex hops, HopIndex torn) {
    const std::vector<HeldHands> holds = {{Side::left, Side::right, 1.0, 4.0}};
    HandHold hold;
    hold.prepare(mannequin_skeleton(), mannequin_skeleton());
    const auto lead = std::make_unique<PoseTrack>();
    const auto follow = std::make_unique<PoseTrack>();
    const auto partner_at = [&](HopIndex hop) {
        return dancer(hop < torn ? 0.75F : 3.0F, 3.14159265F);
    };
    Shown shown;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        lead->append_final(hop, dancer(0.0F, 0.0F));
        follow->append_final(hop, partner_at(hop));
        for (int ahead = 1; ahead <= PoseTrack::kPredictedPoses; ++ahead) {
            lead->set_predicted(ahead, dancer(0.0F, 0.0F));
            follow->set_predicted(ahead, partner_at(hop + ahead));
        }
        const double beat = std::fmod(0.03 * static_cast<double>(hop), 8.0);
        hold.advance({CoupleHold::hands, {}, holds, beat, 8.0, 3.0}, *lead, *follow);
        shown.held.push_back(hold.held()[index_of(Grip::left_right)]);
        const WorldPose one = world_pose(mannequin_skeleton(), lead->at_hop(hop));
        const WorldPose two = world_pose(mannequin_skeleton(), follow->at_hop(hop));
        shown.apart.push_back(glm::distance(palm_of(one, Side::left), palm_of(two, Side::right)));
        shown.hand.push_back(one.position(Bone::left_hand));
    }
    return shown;
}

TEST(HandHold, takes_and_lets_go_as_the_figure_says) {
    const Shown shown = danced(260, 1000);
    EXPECT_LT(shown.held[10], 0.05F);
    EXPECT_GT(shown.held[110], 0.97F) << "beat 3.3";
    EXPECT_LT(shown.apart[110], 0.04F);
    EXPECT_LT(shown.held[200], 0.05F) << "beat 6";
    EXPECT_GT(shown.apart[200], 0.1F);
}

TEST(HandHold, is_without_a_jerk_even_where_they_are_torn_apart) {
    const Shown shown = danced(260, 100);
    EXPECT_GT(shown.held[90], 0.6F);
    EXPECT_LT(shown.held[180], 0.05F);
    float most = 0.0F;
    for (std::size_t i = 3; i < 100; ++i) {
        const glm::vec3 jerk = (shown.hand[i] - 3.0F * shown.hand[i - 1] +
                                3.0F * shown.hand[i - 2] - shown.hand[i - 3]) /
                               1e-6F;
        most = std::max(most, glm::length(jerk));
    }
    EXPECT_LT(most, 3000.0F) << "m/s^3, raw";
}

TEST(HandHold, lets_go_where_they_stand) {
    HandHold hold;
    hold.prepare(mannequin_skeleton(), mannequin_skeleton());
    const auto lead = std::make_unique<PoseTrack>();
    const auto follow = std::make_unique<PoseTrack>();
    for (HopIndex hop = 0; hop < 300; ++hop) {
        lead->append_final(hop, dancer(0.0F, 0.0F));
        follow->append_final(hop, dancer(0.48F, 3.14159265F));
        HoldMoment moment;
        moment.hold = hop < 150 ? CoupleHold::closed : CoupleHold::none;
        hold.advance(moment, *lead, *follow);
        if (hop == 149) {
            EXPECT_GT(hold.held()[index_of(laid(0, Side::right))], 0.97F);
        }
    }
    for (const float weight : hold.held()) {
        EXPECT_LT(weight, 0.01F);
    }
}

}  // namespace
}  // namespace raks::motion
