#include "render/scene/point_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/statistics.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostPoints = 1000;     // 54 vertices each: what 16-bit indices have room for
constexpr double kFigureHeight = 1.714;       // metres: what the camera's distance belongs to
constexpr double kLeastPerson = 0.5;          // metres of what is taken for a person
constexpr double kMostPerson = 2.5;           // metres
constexpr double kUsualPerson = 1.7;          // metres, where no unit fits
constexpr double kFloorPointShare = 0.05;     // of the frames have their lowest point below
constexpr std::size_t kFramesLookedAt = 500;  // evenly over the recording

bool is_seen(const glm::dvec3& place) { return !std::isnan(place.x); }

// The corners of the box around the points of a frame; none: none is seen.
struct Box {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
};
std::optional<Box> box_of(const motion::PointClip& clip, std::size_t frame) {
    Box box;
    bool is_any = false;
    for (std::size_t point = 0; point < clip.names.size(); ++point) {
        const glm::dvec3& place = clip.position(frame, point);
        if (is_seen(place)) {
            box.low = glm::min(box.low, place);
            box.high = glm::max(box.high, place);
            is_any = true;
        }
    }
    return is_any ? std::optional(box) : std::nullopt;
}

// Sizes of the frames' boxes in the middle of all, by axis: single stray points do not count.
glm::dvec3 usual_extent(const motion::PointClip& clip) {
    std::array<std::vector<double>, 3> extents;
    const std::size_t step = std::max<std::size_t>(1, clip.frame_count / kFramesLookedAt);
    for (std::size_t frame = 0; frame < clip.frame_count; frame += step) {
        if (const auto box = box_of(clip, frame)) {
            for (int axis = 0; axis < 3; ++axis) {
                extents[static_cast<std::size_t>(axis)].push_back(box->high[axis] - box->low[axis]);
            }
        }
    }
    glm::dvec3 usual(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        auto& list = extents[static_cast<std::size_t>(axis)];
        usual[axis] = list.empty() ? 0.0 : nth_value(list, list.size() / 2);
    }
    return usual;
}

}  // namespace

GuessedPointFrame guess_point_frame(const motion::PointClip& clip) {
    GuessedPointFrame guess;
    const glm::dvec3 extent = usual_extent(clip);
    guess.is_up_guessed = !clip.up;
    guess.frame.up = clip.up.value_or(extent.z > extent.y ? glm::dvec3(0.0, 0.0, 1.0)
                                                          : glm::dvec3(0.0, 1.0, 0.0));
    guess.is_unit_guessed = !clip.metres_per_unit;
    const double height = std::abs(glm::dot(extent, guess.frame.up));
    guess.frame.metres_per_unit =
        clip.metres_per_unit.value_or(height > 1e-9 ? kUsualPerson / height : 1.0);
    for (const double unit : {0.001, 0.01, 1.0}) {
        const double metres = height * unit;
        if (guess.is_unit_guessed && metres >= kLeastPerson && metres <= kMostPerson) {
            guess.frame.metres_per_unit = unit;
        }
    }
    return guess;
}

PointFigures::PointFigures(const motion::PointClip& clip, const PointFrame& frame)
    : clip_(&clip), metres_per_unit_(frame.metres_per_unit) {
    // The shortest turn; up against y it is half a turn about x.
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const double cosine = glm::dot(frame.up, y);
    turn_ = cosine < -0.9999 ? glm::dquat(0.0, 1.0, 0.0, 0.0)
                             : glm::normalize(glm::dquat(1.0 + cosine, glm::cross(frame.up, y)));
}

Expected<PointFigures> PointFigures::create(const motion::PointClip& clip,
                                            const PointFrame& frame) {
    if (clip.frame_count == 0 || clip.names.empty()) {
        return fail("has no frame to draw");
    }
    if (clip.names.size() > kMostPoints) {
        return fail("has " + std::to_string(clip.names.size()) + " points; at most " +
                    std::to_string(kMostPoints) + " can be drawn");
    }
    PointFigures figures(clip, frame);
    std::vector<double> lowest;
    std::vector<double> highest;
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (std::size_t i = 0; i < clip.frame_count; ++i) {
        double least = 1e300;
        double most = -1e300;
        for (std::size_t point = 0; point < clip.names.size(); ++point) {
            if (const glm::dvec3& place = clip.position(i, point); is_seen(place)) {
                const glm::dvec3 at = figures.upright(place);
                low = glm::min(low, at);
                high = glm::max(high, at);
                least = std::min(least, at.y);
                most = std::max(most, at.y);
            }
        }
        if (least <= most) {
            lowest.push_back(least);
            highest.push_back(most);
        }
    }
    if (lowest.empty()) {
        return fail("has no frame in which a point is seen");
    }
    const auto rank =
        static_cast<std::size_t>(kFloorPointShare * static_cast<double>(lowest.size()));
    const double floor = nth_value(lowest, rank);
    // As high as they reach but for single stray points: hands over the head, too, are framed.
    const double top = nth_value(highest, highest.size() - 1 - rank);
    figures.origin_ = {0.5 * (low.x + high.x), floor, 0.5 * (low.z + high.z)};
    figures.size_ = static_cast<float>(std::clamp((top - floor) / kFigureHeight, 0.05, 20.0));
    return figures;
}

glm::dvec3 PointFigures::upright(const glm::dvec3& place) const {
    return metres_per_unit_ * (turn_ * place);
}

ClipFigure PointFigures::at(std::size_t frame) const {
    ClipFigure figure;
    StickBuilder builder(figure.shape, 0, StickPart::middle);
    builder.set_tint(1.0F);
    // Smaller than a joint where there are many.
    const float radius = (clip_->names.size() < 100 ? 0.9F : 0.6F) * kStickJointRadius * size_;
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (std::size_t point = 0; point < clip_->names.size(); ++point) {
        const glm::dvec3& place = clip_->position(frame, point);
        if (!is_seen(place)) {
            continue;
        }
        const glm::dvec3 at = upright(place) - origin_;
        builder.add_ellipsoid(glm::vec3(at), glm::vec3(radius), 5, 8);
        sum += at;
        count += 1.0;
    }
    // The camera follows their middle; where none is seen it stays at the stage's.
    figure.landmarks.rotations.fill(motion::kNoRotation);
    figure.landmarks.positions.fill(glm::vec3(count > 0.0 ? sum / count : glm::dvec3(0.0)));
    return figure;
}

}  // namespace raks::render
