// Side exchange: a network that takes left for right, found by views and time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// Joints that a network exchanges together.
enum class ExchangedLimbs : std::uint8_t { arms, legs };

/// A stretch in which a camera's network had left and right exchanged.
struct SideExchange {
    std::size_t camera = 0;
    ExchangedLimbs limbs = ExchangedLimbs::arms;
    std::size_t first = 0;  ///< frame of the take
    std::size_t last = 0;   ///< likewise, included
};

/// Finds where arms or legs are exchanged, and exchanges them back: of all ways to name the sides
/// in all cameras over the take the one is taken in which joints lie on one another's epipolar
/// lines and move little from frame to frame (Viterbi over up to six cameras; of more, the first
/// six). A network is rather believed: each exchanged frame costs something. `errors`: by camera,
/// usual_error(). Result: by first frame. Cost: frames x 4^cameras.
[[nodiscard]] std::vector<SideExchange> put_sides_right(const Rig& rig,
                                                        const std::vector<double>& errors,
                                                        KeypointTake& take);

/// Exchanges the sides of arms or legs of one camera in some frames, last included.
void exchange_sides(const SideExchange& stretch, KeypointTake& take);

/// Flags the ends of the limbs in these stretches as exchanged, with their camera. `names`: of the
/// cameras; `tracks`: of the same take.
void add_flags(const std::vector<SideExchange>& exchanges,
               const std::vector<std::string>& names,
               Tracks& tracks);

/// What was exchanged, a line a camera. `names`: of the cameras.
[[nodiscard]] std::vector<std::string> words_of(const std::vector<SideExchange>& exchanges,
                                                const std::vector<std::string>& names,
                                                const Tracks& tracks);

}  // namespace raks::capture
