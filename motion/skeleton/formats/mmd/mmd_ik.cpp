#include "motion/skeleton/formats/mmd/mmd_ik.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::motion {
namespace {

constexpr double kUnit = 0.08;                            // metres
constexpr double kReached = 1e-4 * kUnit;                 // metres
constexpr double kAligned = 1e-8;                         // squared sine below which nothing turns
constexpr double kKneeLeast = glm::pi<double>() / 360.0;  // radians, bent backward
constexpr double kKneeMost = glm::pi<double>();
constexpr std::size_t kMostLinks = 2;

// Mirrored at a limit, where that stays within the other one; else at the limit.
double limited_angle(double angle, bool is_mirrored) {
    if (angle < kKneeLeast) {
        const double mirrored = 2.0 * kKneeLeast - angle;
        return is_mirrored && mirrored <= kKneeMost ? mirrored : kKneeLeast;
    }
    if (angle > kKneeMost) {
        const double mirrored = 2.0 * kKneeMost - angle;
        return is_mirrored && mirrored >= kKneeLeast ? mirrored : kKneeMost;
    }
    return angle;
}

// The turn about x of a rotation that is one about x, then y, then z.
double angle_about_x(const glm::dquat& turn) {
    const glm::dmat3 m = glm::mat3_cast(turn);
    return std::atan2(m[1][2], m[2][2]);
}

// The links in the world.
class Chain {
 public:
    Chain(const glm::dquat& parent,
          const glm::dvec3& start,
          const MmdIkGoal& goal,
          std::span<MmdIkLink> links)
        : links_(links.first(std::min(links.size(), kMostLinks))), goal_(goal) {
        parents_[0] = parent;
        joints_[0] = start;
        for (MmdIkLink& link : links_) {
            link.solved = glm::dquat(1.0, 0.0, 0.0, 0.0);
        }
        place();
    }

    [[nodiscard]] bool is_reached() const {
        return glm::length(joints_[links_.size()] - goal_.place) < kReached;
    }

    // Turns one link toward the goal. `from_end`: 0 is the link next to the end.
    void turn_link(std::size_t from_end, bool is_first_half) {
        const std::size_t i = links_.size() - 1 - from_end;
        MmdIkLink& link = links_[i];
        const glm::dvec3 to_end = glm::normalize(joints_[links_.size()] - joints_[i]);
        const glm::dvec3 to_goal = glm::normalize(goal_.place - joints_[i]);
        const glm::dvec3 across = glm::cross(to_end, to_goal);
        // Also where a joint lies on the goal and there is no direction.
        if (!(glm::dot(across, across) >= kAligned)) {
            return;
        }
        glm::dvec3 axis = glm::normalize(glm::conjugate(parents_[i]) * across);
        if (link.is_knee && is_first_half) {
            axis = {axis.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0};
        }
        const double angle = std::min(goal_.largest_step * static_cast<double>(from_end + 1),
                                      std::acos(std::clamp(glm::dot(to_end, to_goal), -1.0, 1.0)));
        link.solved = glm::normalize(glm::angleAxis(angle, axis) * link.solved);
        if (link.is_knee) {
            const double bend = limited_angle(angle_about_x(link.turn()), is_first_half);
            link.solved = glm::normalize(glm::angleAxis(bend, glm::dvec3(1.0, 0.0, 0.0)) *
                                         glm::conjugate(link.keyed));
        }
        place();
    }

 private:
    // Forward kinematics.
    void place() {
        for (std::size_t i = 0; i < links_.size(); ++i) {
            parents_[i + 1] = parents_[i] * links_[i].turn();
            joints_[i + 1] = joints_[i] + parents_[i + 1] * links_[i].to_next;
        }
    }

    std::span<MmdIkLink> links_;
    const MmdIkGoal& goal_;
    std::array<glm::dquat, kMostLinks + 1> parents_{};  // of link i, and its own behind it
    std::array<glm::dvec3, kMostLinks + 1> joints_{};   // of link i; the last: the end
};

}  // namespace

void solve_mmd_ik(const glm::dquat& parent,
                  const glm::dvec3& start,
                  const MmdIkGoal& goal,
                  std::span<MmdIkLink> links) {
    Chain chain(parent, start, goal, links);
    for (int round = 0; round < goal.rounds && !chain.is_reached(); ++round) {
        for (std::size_t from_end = 0; from_end < links.size(); ++from_end) {
            chain.turn_link(from_end, round < goal.rounds / 2);
        }
    }
}

}  // namespace raks::motion
