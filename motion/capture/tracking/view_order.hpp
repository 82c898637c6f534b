// View order: whether each film is that of its camera, or films were exchanged or mirrored.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/tracking/frame_views.hpp"

namespace raks::capture {

/// Which film shows what which camera sees.
struct ViewOrder {
    std::vector<std::size_t> places;  ///< by camera of the films: the camera whose place it fits
    std::vector<bool> mirrored;       ///< likewise: it fits flipped from left to right
    /// By camera: share of its spots that lie on the epipolar line of a spot of the other cameras
    /// (of their colour, or label), as the films are named, and in this order; [0, 1].
    std::vector<double> agreement_as_named;
    std::vector<double> agreement;  ///< likewise

    /// The cameras that fit clearly better elsewhere or mirrored: half as many spots again and
    /// another tenth agree.
    [[nodiscard]] std::vector<std::size_t> wrong() const;
};

/// The order in which most spots agree, from up to 40 moments and all that a person said: films
/// change places in pairs, or are mirrored, as long as more agree. Cost: up to a second.
[[nodiscard]] ViewOrder find_view_order(const Rig& rig,
                                        FrameViews& views,
                                        std::size_t frame_count,
                                        const std::vector<SaidView>& said,
                                        double sigma);

/// Refuses films in a wrong order, in one line that says the right one, and labels whose median
/// distance from each other's epipolar lines is over 10 pixels in a pair of cameras (with 4 labels
/// or more in both).
[[nodiscard]] Expected<void> check_view_order(const Rig& rig,
                                              FrameViews& views,
                                              std::size_t frame_count,
                                              const std::vector<SaidView>& said,
                                              double sigma);

}  // namespace raks::capture
