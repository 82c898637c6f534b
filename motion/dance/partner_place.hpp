// Partner place: where the follow of a couple dances, seen from the lead.
#pragma once

#include <array>

#include "base/realtime.hpp"
#include "motion/figures/couple_form.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// Sizes at which the two of a couple are shown, against the bodies that their dances were solved
/// for.
struct CoupleSizes {
    float lead = 1.0F;    ///< > 0
    float follow = 1.0F;  ///< > 0

    /// The size of what lies between them.
    [[nodiscard]] float mean() const noexcept { return 0.5F * (lead + follow); }
};

/// How far the follow must move on the floor, metres, to be where a closed hold has her or, without
/// one (`frame` null or silent), as far from the lead as both dance, at the mean of their sizes.
/// Both poses as they are shown. Threads: any. Real-time: yes.
[[nodiscard]] glm::vec2 missing_way(const ClosedFrame* frame,
                                    const CoupleSizes& sizes,
                                    const Pose& lead,
                                    const Pose& follow) noexcept RAKS_NONBLOCKING;

/// Moves a dancer aside over time: the hips go smoothly, each foot only while it is in the air, so
/// that none slides. A value. Threads: one owner. Real-time: yes.
class PartnerPlace {
 public:
    /// One hop on. `way`: how far the danced pose should move, metres.
    void advance(const glm::vec2& way, const Pose& danced) noexcept RAKS_NONBLOCKING;
    /// The pose there. Hips go down where a leg is too short.
    void apply(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    glm::vec2 goal_{};  // `way`, filtered
    glm::vec2 speed_{};
    std::array<glm::vec2, 2> feet_{};  // how far each has moved
    std::array<float, 2> air_{};       // seconds for which each has been in the air
};

}  // namespace raks::motion
