#include "apps/raks_capture/skeleton_view.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using capture::BodyPoint;
using render::Colour;

constexpr double kSureJoint = 0.5;  // likelihood; below it is drawn faint
constexpr float kFaint = 0.3F;      // of the opacity
constexpr Colour kOutline{0x05060C, 0.75F};

constexpr std::pair<BodyPoint, BodyPoint> kBones[] = {
    {BodyPoint::left_shoulder, BodyPoint::right_shoulder},
    {BodyPoint::left_hip, BodyPoint::right_hip},
    {BodyPoint::nose, BodyPoint::left_ear},
    {BodyPoint::nose, BodyPoint::right_ear},
    {BodyPoint::left_shoulder, BodyPoint::left_hip},
    {BodyPoint::right_shoulder, BodyPoint::right_hip},
    {BodyPoint::left_shoulder, BodyPoint::left_elbow},
    {BodyPoint::right_shoulder, BodyPoint::right_elbow},
    {BodyPoint::left_elbow, BodyPoint::left_wrist},
    {BodyPoint::right_elbow, BodyPoint::right_wrist},
    {BodyPoint::left_wrist, BodyPoint::left_index},
    {BodyPoint::right_wrist, BodyPoint::right_index},
    {BodyPoint::left_wrist, BodyPoint::left_pinky},
    {BodyPoint::right_wrist, BodyPoint::right_pinky},
    {BodyPoint::left_hip, BodyPoint::left_knee},
    {BodyPoint::right_hip, BodyPoint::right_knee},
    {BodyPoint::left_knee, BodyPoint::left_ankle},
    {BodyPoint::right_knee, BodyPoint::right_ankle},
    {BodyPoint::left_ankle, BodyPoint::left_heel},
    {BodyPoint::right_ankle, BodyPoint::right_heel},
    {BodyPoint::left_heel, BodyPoint::left_foot_index},
    {BodyPoint::right_heel, BodyPoint::right_foot_index},
};

std::size_t index_of(BodyPoint point) { return static_cast<std::size_t>(point); }

// Of its side; between the sides the middle's.
Colour colour_of_bone(BodyPoint one, BodyPoint other) {
    const Colour first = colour_of_side(capture::name_of(one));
    const Colour second = colour_of_side(capture::name_of(other));
    if (one == BodyPoint::nose) {
        return second;
    }
    return first.rgb == second.rgb ? first : side_colours::kMiddle;
}

float opacity_of(const ViewJoint& joint) { return joint.visibility >= kSureJoint ? 1.0F : kFaint; }

void draw_line(const render::PaneFrame& frame,
               const render::PicturePlace& place,
               const glm::dvec2& one,
               const glm::dvec2& other,
               Colour colour,
               float width) {
    const glm::vec2 from = place.in_box(one);
    const glm::vec2 to = place.in_box(other);
    frame.pen.line(from.x, from.y, to.x, to.y, colour, width);
}

// Dashes of what does not count, on a dark outline.
void draw_dashes(const render::PaneFrame& frame, const glm::vec2& from, const glm::vec2& to) {
    constexpr float kDash = 4.0F;
    constexpr float kGap = 3.0F;
    const float length = glm::distance(from, to);
    for (float at = 0.0F; at < length; at += kDash + kGap) {
        const glm::vec2 one = glm::mix(from, to, at / length);
        const glm::vec2 other = glm::mix(from, to, std::min(at + kDash, length) / length);
        frame.pen.line(one.x, one.y, other.x, other.y, kOutline, 3.0F);
        frame.pen.line(one.x, one.y, other.x, other.y, side_colours::kHidden, 1.5F);
    }
}

enum class BonePart : std::uint8_t { outline, bone };

void draw_bones(const render::PaneFrame& frame,
                const render::PicturePlace& place,
                const ViewSkeleton& joints,
                BonePart part) {
    constexpr float kBone = 2.5F;
    constexpr float kRim = 1.2F;  // of the outline, each side
    const bool is_outline = part == BonePart::outline;
    for (const auto& [one, other] : kBones) {
        const ViewJoint& from = joints[index_of(one)];
        const ViewJoint& to = joints[index_of(other)];
        if (from.visibility <= 0.0 || to.visibility <= 0.0) {
            continue;
        }
        if (!from.is_hidden && !to.is_hidden) {
            const Colour colour = is_outline ? kOutline : colour_of_bone(one, other);
            draw_line(frame,
                      place,
                      from.pixel,
                      to.pixel,
                      colour.faded(std::min(opacity_of(from), opacity_of(to))),
                      is_outline ? kBone + 2.0F * kRim : kBone);
        } else if (!is_outline) {
            draw_dashes(frame, place.in_box(from.pixel), place.in_box(to.pixel));
        }
    }
}

}  // namespace

Colour colour_of_side(std::string_view joint) noexcept {
    return joint.find("left") != std::string_view::npos    ? side_colours::kLeft
           : joint.find("right") != std::string_view::npos ? side_colours::kRight
                                                           : side_colours::kMiddle;
}

void draw_skeleton(const render::PaneFrame& frame,
                   const render::PicturePlace& place,
                   const ViewSkeleton& joints) {
    // All outlines first, so that none lies over a bone.
    draw_bones(frame, place, joints, BonePart::outline);
    draw_bones(frame, place, joints, BonePart::bone);
    for (const auto& [one, other] : kBones) {
        for (const BodyPoint point : {one, other}) {
            const ViewJoint& joint = joints[index_of(point)];
            if (joint.visibility > 0.0 && !joint.is_hidden) {
                const glm::vec2 at = place.in_box(joint.pixel);
                frame.pen.dot(at.x, at.y, 3.0F, kOutline.faded(opacity_of(joint)));
                frame.pen.dot(at.x,
                              at.y,
                              2.2F,
                              colour_of_side(capture::name_of(point)).faded(opacity_of(joint)));
            }
        }
    }
}

void draw_placed(const render::PaneFrame& frame,
                 const render::PicturePlace& place,
                 const std::array<std::optional<glm::dvec2>, capture::kBodyPoints>& places) {
    for (const auto& [one, other] : kBones) {
        const auto& from = places[index_of(one)];
        const auto& to = places[index_of(other)];
        if (from && to) {
            draw_line(frame, place, *from, *to, side_colours::kPlaced, 1.0F);
        }
    }
}

void draw_legend(const render::PaneFrame& frame, const render::Box& box) {
    constexpr std::pair<std::string_view, Colour> kItems[] = {{"left", side_colours::kLeft},
                                                              {"right", side_colours::kRight},
                                                              {"placed", side_colours::kPlaced},
                                                              {"hidden", side_colours::kHidden}};
    float x = box.x;
    const float middle = box.y + 0.5F * box.height;
    const ImFont* const font = frame.pen.fonts().small;
    for (const auto& [name, colour] : kItems) {
        constexpr float kDash = 11.0F;
        if (name == "hidden") {
            draw_dashes(frame, {x, middle}, {x + kDash, middle});
        } else {
            const bool is_thick = colour.alpha >= 1.0F;
            frame.pen.line(x, middle, x + kDash, middle, colour, is_thick ? 3.0F : 1.0F);
        }
        x += kDash + 4.0F;
        x += 8.0F +
             frame.pen.text(
                 font, x, middle - 0.5F * frame.pen.height_of(font), render::palette::kDim, name);
    }
}

}  // namespace raks::apps
