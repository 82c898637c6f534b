#include "motion/choreography/hand_timing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

using Moves = std::vector<glm::dvec3>;  // displacements by frame, metres

// Index of a bone among the track's joints.
std::size_t index_in_body(Bone bone) {
    return static_cast<std::size_t>(std::find(kBodyBones.begin(), kBodyBones.end(), bone) -
                                    kBodyBones.begin());
}

/// Displacements of a joint from frame to frame, without their mean (the drift).
Moves moves_of(const BodyTrack& track, Bone bone) {
    const std::size_t joint = index_in_body(bone);
    Moves moves;
    glm::dvec3 drift(0.0);
    for (std::size_t i = 1; i < track.frames(); ++i) {
        moves.push_back(track.joints[i][joint] - track.joints[i - 1][joint]);
        drift += moves.back();
    }
    for (glm::dvec3& move : moves) {
        move -= drift / static_cast<double>(moves.size());
    }
    return moves;
}

/// Adds the cross-correlation of head and hand to `likeness`, by shift from -reach to reach frames;
/// adds the product of both norms to `most`, the correlation that equal motion would have.
void add_likeness(const Moves& head,
                  const Moves& hand,
                  std::ptrdiff_t reach,
                  std::vector<double>& likeness,
                  double& most) {
    // Only frames for which every shift exists, so that all shifts sum equally many terms.
    const auto end = static_cast<std::ptrdiff_t>(head.size()) - reach;
    double head_square = 0.0;
    double hand_square = 0.0;
    for (std::ptrdiff_t i = reach; i < end; ++i) {
        const glm::dvec3& at_head = head[static_cast<std::size_t>(i)];
        for (std::ptrdiff_t shift = -reach; shift <= reach; ++shift) {
            likeness[static_cast<std::size_t>(shift + reach)] +=
                glm::dot(at_head, hand[static_cast<std::size_t>(i + shift)]);
        }
        const glm::dvec3& at_hand = hand[static_cast<std::size_t>(i)];
        head_square += glm::dot(at_head, at_head);
        hand_square += glm::dot(at_hand, at_hand);
    }
    most += std::sqrt(head_square * hand_square);
}

/// Centroid of the part around the peak that exceeds kNearlyAsHigh of it, weighted by the excess.
/// (The exact peak of a flat curve is set by noise.)
double middle_of_peak(const std::vector<double>& likeness) {
    constexpr double kNearlyAsHigh = 0.8;
    const auto peak = std::max_element(likeness.begin(), likeness.end());
    const double least = kNearlyAsHigh * *peak;
    auto from = peak;
    while (from != likeness.begin() && *(from - 1) > least) {
        --from;
    }
    double weights = 0.0;
    double sum = 0.0;
    for (auto at = from; at != likeness.end() && *at > least; ++at) {
        weights += *at - least;
        sum += (*at - least) * static_cast<double>(at - likeness.begin());
    }
    return weights > 0.0 ? sum / weights : static_cast<double>(peak - likeness.begin());
}

}  // namespace

HandTiming hand_timing(const BodyTrack& track, double frames_a_beat) {
    const auto reach = static_cast<std::ptrdiff_t>(0.5 * frames_a_beat);
    const Moves head = moves_of(track, Bone::head);
    std::vector<double> likeness(static_cast<std::size_t>(2 * reach + 1), 0.0);
    double most = 0.0;
    for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
        add_likeness(head, moves_of(track, hand), reach, likeness, most);
    }
    const double best = *std::max_element(likeness.begin(), likeness.end());
    if (!(best > 0.0)) {
        return {};  // head or hands stand still, or correlate negatively at every shift
    }
    return {(middle_of_peak(likeness) - static_cast<double>(reach)) / frames_a_beat, best / most};
}

}  // namespace raks::motion
