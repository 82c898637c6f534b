#include "render/scene/point_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "base/statistics.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostPoints = 1000;     // what 16-bit indices have room for, twice
constexpr double kBodyHeight = 1.714;         // metres: what the camera's distance belongs to
constexpr double kLeastPerson = 0.5;          // metres of what is taken for a person
constexpr double kMostPerson = 2.5;           // metres
constexpr double kUsualPerson = 1.7;          // metres, where no unit fits
constexpr double kFloorPointShare = 0.05;     // of the frames have their lowest point below
constexpr std::size_t kFramesLookedAt = 500;  // evenly over the recording
constexpr float kOverlaidTint = 0.75F;  // of the colour on a stick, where there are two motions

bool is_seen(const glm::dvec3& place) { return !std::isnan(place.x); }

// The corners of the box around the points of a frame; none: none is seen.
struct Box {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
};
Box joined(const Box& one, const Box& other) {
    return {glm::min(one.low, other.low), glm::max(one.high, other.high)};
}
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

// By point: smaller where its shortest stick is short, as in fingers, so that they stay apart.
std::vector<float> radii_of(const motion::WorldPoints& points) {
    constexpr double kOfStick = 0.35;       // of the shortest stick's length
    constexpr double kWhole = 0.026 * 0.9;  // metres, of a point that stands free
    constexpr double kSmallest = 0.3;
    std::vector<double> shortest(points.clip.names.size(), 1e300);
    for (const motion::PointEdge& edge : points.edges) {
        std::vector<double> lengths;
        const std::size_t step = std::max<std::size_t>(1, points.clip.frame_count / 20);
        for (std::size_t frame = 0; frame < points.clip.frame_count; frame += step) {
            const double length = glm::distance(points.clip.position(frame, edge.from),
                                                points.clip.position(frame, edge.to));
            if (!std::isnan(length)) {
                lengths.push_back(length);
            }
        }
        if (!lengths.empty()) {
            const double usual = upper_median(std::move(lengths));
            shortest[edge.from] = std::min(shortest[edge.from], usual);
            shortest[edge.to] = std::min(shortest[edge.to], usual);
        }
    }
    std::vector<float> radii;
    for (const double length : shortest) {
        radii.push_back(static_cast<float>(std::clamp(kOfStick * length / kWhole, kSmallest, 1.0)));
    }
    return radii;
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

PointBodies::PointBodies(std::vector<motion::WorldPoints> motions) {
    constexpr std::array<StickPart, 2> kColours = {StickPart::left, StickPart::right};
    for (motion::WorldPoints& points : motions) {
        const StickPart colour =
            motions.size() == 1 ? StickPart::middle : kColours[parts_.size() % kColours.size()];
        std::vector<float> radii = radii_of(points);
        parts_.push_back({std::move(points), {}, std::move(radii), colour});
    }
}

Expected<PointBodies> PointBodies::create(std::vector<motion::WorldPoints> motions,
                                          Arrangement arrangement) {
    for (const motion::WorldPoints& points : motions) {
        if (points.clip.frame_count == 0 || points.clip.names.empty()) {
            return fail("has no frame to draw");
        }
        if (points.named > kMostPoints || points.clip.names.size() > 2 * kMostPoints) {
            return fail("has " + std::to_string(points.named) + " points; at most " +
                        std::to_string(kMostPoints) + " can be drawn");
        }
        RAKS_ASSERT(points.clip.frame_count == motions.front().clip.frame_count);
    }
    PointBodies bodies(std::move(motions));
    if (auto stood = bodies.stand_on_floor(); !stood) {
        return fail(std::move(stood.error()));
    }
    if (arrangement == Arrangement::side_by_side) {
        bodies.stand_side_by_side();
    }
    if (auto chosen = bodies.choose_detail(); !chosen) {
        return fail(std::move(chosen.error()));
    }
    return bodies;
}

Expected<void> PointBodies::stand_on_floor() {
    std::vector<double> lowest;
    std::vector<double> highest;
    Box way;
    for (std::size_t frame = 0; frame < parts_.front().points.clip.frame_count; ++frame) {
        Box all;
        for (const Part& part : parts_) {
            if (const auto box = box_of(part.points.clip, frame)) {
                all = joined(all, *box);
            }
        }
        if (all.low.y <= all.high.y) {
            lowest.push_back(all.low.y);
            highest.push_back(all.high.y);
            way = joined(way, all);
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
    for (Part& part : parts_) {
        part.origin = {0.5 * (way.low.x + way.high.x), floor, 0.5 * (way.low.z + way.high.z)};
    }
    size_ = static_cast<float>(std::clamp((top - floor) / kBodyHeight, 0.05, 20.0));
    return {};
}

// Each in the middle of its own way, as far apart as the wider of them is in most frames.
void PointBodies::stand_side_by_side() {
    constexpr double kGap = 1.25;       // against the width
    constexpr double kNarrowest = 0.7;  // metres, of a body of usual size that stands edge on
    double width = kNarrowest * static_cast<double>(size_);
    for (const Part& part : parts_) {
        width = std::max(width, usual_extent(part.points.clip).x);
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        Part& part = parts_[i];
        Box way;
        for (std::size_t frame = 0; frame < part.points.clip.frame_count; ++frame) {
            if (const auto box = box_of(part.points.clip, frame)) {
                way = joined(way, *box);
            }
        }
        if (way.low.x <= way.high.x) {
            const double place =
                static_cast<double>(i) - 0.5 * static_cast<double>(parts_.size() - 1);
            part.origin.x = 0.5 * (way.low.x + way.high.x) - kGap * width * place;
            part.origin.z = 0.5 * (way.low.z + way.high.z);
        }
    }
}

// The finest for which all points and sticks fit one mesh. Errors: too many points for any.
Expected<void> PointBodies::choose_detail() {
    constexpr std::array<Detail, 4> kDetails = {{{10, 18, 12}, {5, 8, 8}, {4, 5, 4}, {3, 4, 3}}};
    constexpr std::size_t kMostVertices = 65'535;  // 16-bit indices
    std::size_t points = 0;
    std::size_t edges = 0;
    for (const Part& part : parts_) {
        points += part.points.clip.names.size();
        edges += part.points.edges.size();
    }
    for (const Detail& detail : kDetails) {
        detail_ = detail;
        const std::size_t of_points = points * (detail.rows + 1) * (detail.columns + 1);
        if (of_points + edges * 2 * (detail.sides + 1) <= kMostVertices) {
            return {};
        }
    }
    const std::size_t of_points = points * (detail_.rows + 1) * (detail_.columns + 1);
    if (of_points > kMostVertices) {
        return fail("has " + std::to_string(points) + " points in all, more than can be drawn");
    }
    // Only an edges file can name so many: the last of them are left undrawn.
    const std::size_t room =
        (kMostVertices - of_points) / (2 * (detail_.sides + 1)) / parts_.size();
    for (Part& part : parts_) {
        part.points.edges.resize(std::min(part.points.edges.size(), room));
    }
    return {};
}

void PointBodies::add(const Part& part, std::size_t frame, Shape<StickVertex>& shape) const {
    const motion::WorldPoints& points = part.points;
    StickBuilder builder(shape, 0, part.colour);
    builder.set_tint(1.0F);
    const auto at = [&](std::size_t point) {
        return glm::vec3(points.clip.position(frame, point) - part.origin);
    };
    // Smaller than a joint where there are many.
    const float radius = (points.clip.names.size() < 100 ? 0.9F : 0.6F) * kStickJointRadius * size_;
    for (std::size_t point = 0; point < points.clip.names.size(); ++point) {
        if (is_seen(points.clip.position(frame, point))) {
            builder.add_ellipsoid(
                at(point), glm::vec3(radius * part.radii[point]), detail_.rows, detail_.columns);
        }
    }
    // Sticks are paler than points; of two motions both must keep their colour.
    builder.set_tint(part.colour == StickPart::middle ? 0.0F : kOverlaidTint);
    for (const motion::PointEdge& edge : points.edges) {
        if (is_seen(points.clip.position(frame, edge.from)) &&
            is_seen(points.clip.position(frame, edge.to))) {
            const float thin = std::min(part.radii[edge.from], part.radii[edge.to]);
            const float thickness = kStickBoneRadius * size_ * thin;
            builder.add_cone(at(edge.from), at(edge.to), thickness, thickness, detail_.sides);
        }
    }
}

ClipBody PointBodies::at(std::size_t frame) const {
    ClipBody body;
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (const Part& part : parts_) {
        add(part, frame, body.shape);
        for (std::size_t point = 0; point < part.points.clip.names.size(); ++point) {
            if (const glm::dvec3& place = part.points.clip.position(frame, point); is_seen(place)) {
                sum += place - part.origin;
                count += 1.0;
            }
        }
    }
    // The camera follows their middle; where none is seen it stays at the stage's.
    body.landmarks.rotations.fill(motion::kNoRotation);
    const glm::vec3 middle(count > 0.0 ? sum / count : glm::dvec3(0.0));
    body.landmarks.positions.fill(middle);
    // Their shadow is that of feet under the middle, or where the first body has its joints.
    for (const motion::Bone foot : {motion::Bone::left_foot,
                                    motion::Bone::right_foot,
                                    motion::Bone::left_toes,
                                    motion::Bone::right_toes}) {
        body.landmarks.positions[motion::index_of(foot)] = {middle.x, 0.0F, middle.z};
    }
    const Part& first = parts_.front();
    for (std::size_t point = 0; point < first.points.bones.size(); ++point) {
        const auto bone = first.points.bones[point];
        const glm::dvec3& place = first.points.clip.position(frame, point);
        if (bone && *bone != motion::Bone::hips && is_seen(place)) {
            body.landmarks.positions[motion::index_of(*bone)] = glm::vec3(place - first.origin);
        }
    }
    return body;
}

std::vector<BodyPoint> PointBodies::points(std::size_t frame) const {
    std::vector<BodyPoint> points;
    for (const Part& part : parts_) {
        const motion::PointClip& clip = part.points.clip;
        for (std::size_t point = 0; point < part.points.named; ++point) {
            const glm::vec3 place(clip.position(frame, point) - part.origin);
            points.push_back({clip.names[point], place, part.colour});
        }
    }
    return points;
}

}  // namespace raks::render
