// Posture tables: the body, the cameras and what they saw at one frame, as plain numbers in single
// precision for the loops that weigh postures.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/capture/angles/body_links.hpp"
#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/angles/posture_weigher.hpp"
#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// A place or direction.
using TableVector = std::array<float, 3>;

/// A link with its turn in the reference posture.
struct TableLink {
    std::size_t parent = 0;
    std::size_t joint = 0;
    std::size_t first = 0;  ///< variable
    bool is_hinge = false;
    TableVector axis{};  ///< of a hinge, times the share
    float share = 1.0F;
    TableVector offset{};
    std::array<float, 4> turn{};  ///< of the reference: w, x, y, z
    float angle = 0.0F;           ///< of a hinge in the reference
    float lowest = 0.0F;
    float highest = 0.0F;
    std::array<float, 4> usual{1.0F, 0.0F, 0.0F, 0.0F};  ///< of a ball: w, x, y, z
    float least_w = -1.0F;    ///< of a ball: cosine of half of the greatest turn of a share
    float w_to_angle = 0.0F;  ///< radians of the whole turn to one of w, beyond that
};

/// A marker on its link.
struct TableMarker {
    std::size_t link = 0;
    TableVector place{};
};

/// World to picture, the first two rows times the focal length: three of a matrix, one of a move.
using TablePicture = std::array<float, 12>;

/// From one picture to another.
struct TablePair {
    std::array<float, 9> lines{};  ///< line in `to` of a place in `from`, row-major
    float epipole_x = 0.0F;        ///< in `to`
    float epipole_y = 0.0F;
};

/// a x + b y + c is the distance from a line.
struct TableLine {
    float a = 0.0F;
    float b = 0.0F;
    float c = 0.0F;
};

/// All that the loops read.
struct PostureTables {
    static constexpr std::size_t kMostPictures = 128;

    Likelihood likelihood = Likelihood::reprojection;
    float square_bound = 0.0F;
    TableVector hips{};
    std::vector<TableLink> links;
    std::vector<TableMarker> markers;
    std::vector<TablePicture> pictures;
    std::vector<MarkRange> ranges;  ///< by marker and picture
    std::vector<float> mark_x;
    std::vector<float> mark_y;
    std::vector<TablePair> pairs;  ///< by from and to
    std::vector<TableLine> lines;  ///< by mark and the picture it is drawn in
};

/// The tables of one frame, as PostureWeigher's constructor takes it. Precondition: no more than
/// kMostPictures pictures. Threads: any.
[[nodiscard]] PostureTables posture_tables(const BodyModel& model,
                                           const BodyLinks& links,
                                           const FrameMarks& marks,
                                           const BodyState& reference,
                                           Likelihood likelihood,
                                           double bound);

}  // namespace raks::capture
