#include "motion/dance/figure_sides.hpp"

#include <cmath>

#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {
namespace {

// Beats before count 1 in which the foot of the first step is in the air.
constexpr double kFreeFrom = -0.40;
constexpr double kFreeTo = -0.10;
constexpr int kFreeSamples = 13;
// Of the samples, that one foot is longer in the air than the other to be the one that leads.
constexpr double kSurelyFree = 0.4;

}  // namespace

FloorMove stance_before(const FigurePassage& passage, const Skeleton& skeleton) {
    Pose pose;
    passage.at(-FigurePassage::kMargin, pose);
    const WorldPose world = world_body(skeleton, pose);
    FloorMove stance;
    glm::dvec2 facing{0.0, 0.0};
    for (const Side side : kSides) {
        const glm::vec3 ball = foot_point(world, side, skeleton.ball);
        stance.offset += 0.5 * glm::dvec2(ball.x, ball.z);
        const double heading =
            heading_of(glm::dquat(world.rotation(on_side(Bone::left_foot, side))));
        facing += glm::dvec2(std::sin(heading), std::cos(heading));
    }
    stance.heading = std::atan2(facing.x, facing.y);
    return stance;
}

FigureSides sides_of(const FigurePassage& passage,
                     const FloorMove& stance,
                     const Skeleton& skeleton) {
    FigureSides sides;
    std::array<double, 2> free{};
    for (int i = 0; i < kFreeSamples; ++i) {
        Pose pose;
        passage.at(kFreeFrom + (kFreeTo - kFreeFrom) * i / (kFreeSamples - 1), pose);
        for (std::size_t s = 0; s < free.size(); ++s) {
            free[s] += pose.foot_contact[s] ? 0.0 : 1.0 / kFreeSamples;
        }
    }
    if (std::abs(free[0] - free[1]) > kSurelyFree) {
        sides.leads = free[0] > free[1] ? Side::left : Side::right;
    }
    FloorMove own = stance_before(passage, skeleton);
    own.heading = -own.heading;
    own.offset.x = -own.offset.x;
    sides.mirrored_place = stance * inverse(own);
    return sides;
}

}  // namespace raks::motion
