// Posture weigher: how badly many postures fit what the cameras saw at one frame.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/simd_lanes.hpp"
#include "motion/capture/angles/body_links.hpp"
#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// What the loops read; motion/capture/angles/posture_tables.hpp.
struct PostureTables;

/// How a posture is compared with what was seen; c bounds what a single marker can say.
enum class Likelihood {
    /// Sum over markers and pictures of d^2 / (d^2 + c^2), d being the distance of a marker's
    /// projection from the nearest spot of its colour, in pixels; 1 where there is none. What is
    /// hidden needs no model: it costs the same in every posture.
    reprojection,
    /// Sum over markers and pictures of the mean over the other pictures of D^2 / (D^2 + c^2): D^2
    /// is the squared distance of the spot that is nearest to the projection from the epipolar line
    /// of the projection in the other picture, plus that of the other projection from the line of
    /// the spot (Canton-Ferrer, Casas and Pardas 2005). Pairs in which the projection is within 30
    /// pixels of the epipole do not count; 1 where there is no spot.
    epipolar,
};

/// Postures are weighed in blocks of so many.
inline constexpr std::size_t kPostureBlock = kLanes;

/// Changes of the variables of a model, for many postures at once: variable after variable, each
/// `stride` postures long. `stride` is a multiple of kPostureBlock.
struct PostureChanges {
    std::size_t stride = 0;
    std::vector<float> values;

    /// No change: of so many postures, rounded up to whole blocks.
    PostureChanges(std::size_t variables, std::size_t postures)
        : stride((postures + kPostureBlock - 1) / kPostureBlock * kPostureBlock),
          values(variables * stride) {}

    /// The changes of a variable.
    [[nodiscard]] float* of(std::size_t variable) noexcept {
        return values.data() + variable * stride;
    }
    /// The changes of a variable.
    [[nodiscard]] const float* of(std::size_t variable) const noexcept {
        return values.data() + variable * stride;
    }
};

/// Weighs postures that differ from a reference by changes of the variables, as
/// BodyModel::moved() takes them. Also the limits of joints cost: 50 times the square of what a
/// joint is beyond, radians. The same bits on any machine. Threads: any, once made.
class PostureWeigher {
 public:
    /// `marks` and what they are made from must outlive it. `bound`: c, pixels.
    PostureWeigher(const BodyModel& model,
                   const BodyLinks& links,
                   const FrameMarks& marks,
                   const BodyState& reference,
                   Likelihood likelihood,
                   double bound);

    /// The costs of the postures [first, first + kPostureBlock) by what tells of these joints;
    /// `first`: a multiple of kPostureBlock. About 2 us a posture of 18 markers and 6 pictures.
    void weigh(const JointGroup& group,
               const PostureChanges& changes,
               std::size_t first,
               float* costs) const;

 private:
    std::shared_ptr<const PostureTables> tables_;
};

}  // namespace raks::capture
