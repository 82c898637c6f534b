#include "motion/skeleton/body/stance_finder.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

/// Horizontal direction across the hip sockets.
glm::dvec3 ahead_of(const PosedBody& body, const glm::dquat& upright, std::size_t frame) {
    const glm::dvec3 across = upright * (body.place(frame, Bone::left_upper_leg) -
                                         body.place(frame, Bone::right_upper_leg));
    return {-across.z, 0.0, across.x};
}

/// Votes for and against a way.
struct Votes {
    std::size_t all = 0;
    std::size_t ahead = 0;

    // Vectors shorter than `least` say nothing.
    void add(const glm::dvec3& vector, const glm::dvec3& way, double least) {
        if (glm::length(vector) > least) {
            ++all;
            ahead += glm::dot(vector, way) > 0.0 ? 1U : 0U;
        }
    }
};

}  // namespace

FoundStance find_stance(const PosedBody& body, const glm::dquat& upright, double height) {
    FoundStance found;
    std::vector<double> tips;
    std::vector<double> lower;
    Votes votes;
    for (std::size_t i = 0; i < body.frames(); ++i) {
        const glm::dvec3 way = ahead_of(body, upright, i);
        for (const Side side : kSides) {
            const glm::dvec3 tip = upright * body.toe_tip(i, side);
            const glm::dvec3 hip = upright * body.place(i, on_side(Bone::left_upper_leg, side));
            const glm::dvec3 knee = upright * body.place(i, on_side(Bone::left_lower_leg, side));
            const glm::dvec3 ankle = upright * body.place(i, on_side(Bone::left_foot, side));
            tips.push_back(tip.y);
            votes.add(tip - ankle, way, 0.05 * height);
            votes.add(knee - 0.5 * (hip + ankle), way, 0.03 * height);
        }
        lower.push_back(std::min(tips[2 * i], tips[2 * i + 1]));
    }
    constexpr double kFloorShare = 0.05;
    found.floor = lower_percentile(tips, kFloorShare);
    const double near = 0.05 * height;
    const auto on_floor = std::count_if(
        lower.begin(), lower.end(), [&](double low) { return std::abs(low - found.floor) < near; });
    found.floor_confidence = static_cast<double>(on_floor) / static_cast<double>(lower.size());
    const glm::dvec3 first = ahead_of(body, upright, 0);
    found.facing = std::atan2(first.x, first.z) * 180.0 / glm::pi<double>();
    found.facing_confidence =
        votes.all == 0 ? 0.0 : static_cast<double>(votes.ahead) / static_cast<double>(votes.all);
    return found;
}

}  // namespace raks::motion
