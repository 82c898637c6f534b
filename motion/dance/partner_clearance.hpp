// Partner clearance: the partner's body is in the way of arms and knees.
#pragma once

#include <array>

#include "base/realtime.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How far an arm must move; metres, world.
struct ArmWay {
    glm::vec3 wrist{};  ///< its hand
    glm::vec3 elbow{};  ///< its elbow
};
/// Both arms, by Side.
using ArmWays = std::array<ArmWay, 2>;

/// Moves both arms that far, as far as they reach. Threads: any. Real-time: yes.
void move_arms(const Skeleton& skeleton, const ArmWays& ways, Pose& pose) noexcept RAKS_NONBLOCKING;

/// What of a body is in the way of another one: of its arms trunk, neck and head, upper arms; of
/// its legs the legs.
class PartnerBody {
 public:
    /// `world`: of the pose.
    PartnerBody(const Girth& girth, const WorldPose& world) noexcept;

    /// How far the arms of `pose` must move until hands and forearms are 1 cm off that body's skin
    /// or more. It begins softly, some centimetres before. `lying`: by Side, how much that hand
    /// lies on the partner by the hold, [0, 1]: it may touch. Threads: any. Real-time: yes.
    [[nodiscard]] ArmWays ways_off(const Skeleton& skeleton,
                                   const std::array<float, 2>& lying,
                                   const Pose& pose) const noexcept RAKS_NONBLOCKING;

    /// Turns knees of `pose` aside, out of that body's legs, by the share [0, 1] of what is needed;
    /// hips and feet stay. `world`: of the pose. Threads: any. Real-time: yes.
    void turn_knees(const Skeleton& skeleton,
                    const WorldPose& world,
                    float share,
                    Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    struct Part {
        Capsule capsule;
        glm::vec3 middle{};   // of a ball around it
        float radius = 0.0F;  // of that ball
        bool is_arm = false;
    };
    struct Push;
    [[nodiscard]] Push push_of(const Part& part,
                               const Capsule& own,
                               float spare,
                               const glm::vec3& outward) const noexcept;
    void add_push(const Part& part,
                  const std::array<Capsule, 2>& arm,
                  float spare,
                  const glm::vec3& outward,
                  float share,
                  Push& sum) const noexcept;
    static bool is_near(const Part& part, const Capsule& own, float spare) noexcept;
    [[nodiscard]] float way_aside(const Part& part,
                                  const Capsule& own,
                                  bool is_thigh,
                                  const glm::vec3& aside) const noexcept;
    static Part part_of(const Capsule& capsule, bool is_arm) noexcept;

    std::array<Part, 6> parts_;
    std::array<Part, 4> legs_;  // of either side thigh and shin
    glm::vec3 middle_{};        // of the trunk
};

}  // namespace raks::motion
