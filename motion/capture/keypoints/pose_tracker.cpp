#include "motion/capture/keypoints/pose_tracker.hpp"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kSomebody = 0.5;       // of the network's flag
constexpr std::size_t kLookEvery = 30;  // pictures
constexpr double kElsewhere = 0.1;      // overlap: the detector sees nobody where one is followed
constexpr double kLeastSquare = 24.0;   // pixels

// Who of several is the dancer: who is near where the dancer was, else the surest.
const DetectedPerson& likely_dancer(const std::vector<DetectedPerson>& people,
                                    const std::optional<PoseSquare>& last) {
    if (!last) {
        return people.front();
    }
    return *std::min_element(people.begin(), people.end(), [&](const auto& one, const auto& other) {
        return glm::distance(one.square.centre, last->centre) <
               glm::distance(other.square.centre, last->centre);
    });
}

// Whether a square is worth looking at: some of it lies in the picture.
bool is_usable(const PoseSquare& square, const PictureView& picture) {
    return square.side >= kLeastSquare && square.centre.x > -square.side / 2 &&
           square.centre.y > -square.side / 2 &&
           square.centre.x < picture.width + square.side / 2 &&
           square.centre.y < picture.height + square.side / 2 &&
           square.side < 4.0 * std::max(picture.width, picture.height);
}

}  // namespace

std::optional<FoundJoints> PoseTracker::start_anew(const PictureView& picture,
                                                   KeypointPicture& seen) {
    const std::vector<DetectedPerson> people = network_.detect(picture);
    pictures_ = 0;
    seen.people = people.size();
    if (people.empty()) {
        return std::nullopt;
    }
    FoundJoints found = network_.find_joints(picture, likely_dancer(people, last_).square);
    return found.score >= kSomebody ? std::optional(found) : std::nullopt;
}

KeypointPicture PoseTracker::follow(const PictureView& picture) {
    KeypointPicture seen;
    std::optional<FoundJoints> found;
    if (square_) {
        found = network_.find_joints(picture, *square_);
        if (found->score < kSomebody) {
            found.reset();
        }
    }
    if (!found) {
        found = start_anew(picture, seen);
    } else if (++pictures_ >= kLookEvery) {
        pictures_ = 0;
        const std::vector<DetectedPerson> people = network_.detect(picture);
        seen.people = std::max<std::size_t>(people.size(), 1);
        const bool is_elsewhere =
            !people.empty() && std::none_of(people.begin(), people.end(), [&](const auto& one) {
                return overlap_of(one.square, *square_) > kElsewhere;
            });
        if (is_elsewhere) {
            FoundJoints other = network_.find_joints(picture, people.front().square);
            found = other.score > found->score ? other : *found;
        }
    }
    square_.reset();
    if (found) {
        seen.score = std::min(found->score, 1.0);
        seen.points = found->points;
        last_ = found->next;
        if (is_usable(found->next, picture)) {
            square_ = found->next;
        }
    }
    return seen;
}

}  // namespace raks::capture
