#include "render/scene/shot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

struct SizeRule {
    std::string_view name;
    float pitch_degrees;
    float fov_degrees;
    float margin;
};

// By ShotSize. Long lenses for parts of the body, which they flatten kindly; the floor shows where
// feet do.
constexpr std::array<SizeRule, 7> kSizes = {{
    {"wide", 8.0F, 30.0F, 0.17F},
    {"low", 3.0F, 36.0F, 0.04F},
    {"full", 6.0F, 26.0F, 0.05F},
    {"knees up", 4.5F, 24.0F, 0.04F},
    {"upper body", 3.5F, 22.0F, 0.05F},
    {"face", 3.2F, 18.0F, 0.06F},
    {"feet", 10.0F, 22.0F, 0.05F},
}};

const SizeRule& rule_of(ShotSize size) noexcept { return kSizes[static_cast<std::size_t>(size)]; }

// Where a body is cut, as a share of the hips' height: between joints, never through one.
constexpr float kBelowKnees = 0.40F;
constexpr float kBelowWaist = 0.92F;
constexpr float kOverThighs = 0.72F;

// The camera's directions for yaw and pitch.
struct Directions {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 toward;  // from what is seen to the camera
};

Directions directions_of(float yaw, float pitch) noexcept {
    const glm::vec3 toward(
        std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw));
    const glm::vec3 right(std::cos(yaw), 0.0F, -std::sin(yaw));
    return {right, glm::cross(toward, right), toward};
}

// Half of what is seen at 1 m, from edge to edge.
struct Lens {
    float x;
    float y;
};

Lens lens_of(const ShotView& view, float aspect) noexcept {
    Camera camera;
    camera.vertical_fov = view.fov;
    const glm::mat4 clip = camera.clip_from_view(aspect);
    return {1.0F / clip[0][0], 1.0F / clip[1][1]};
}

// How a box lies before a camera of known directions: the camera that sees it all stands at least
// `by_width` and `by_height` along `toward`, and its two other coordinates are between the edges'.
struct Fit {
    float by_width;
    float by_height;
    float aside;  // of the camera along `right`
    // Along `up`, of lines through the camera that graze the box above and below.
    float over;
    float under;
};

Fit fit_of(const ShotView& view, const Directions& to, Lens free) noexcept {
    constexpr float kEndless = std::numeric_limits<float>::max();
    float right = -kEndless;
    float left = kEndless;
    float over = -kEndless;
    float under = kEndless;
    for (const glm::vec2 corner : view.outline) {
        for (const float y : {view.box.low.y, view.box.high.y}) {
            const glm::vec3 at(corner.x, y, corner.y);
            const float depth = glm::dot(at, to.toward);
            right = std::max(right, glm::dot(at, to.right) + depth * free.x);
            left = std::min(left, glm::dot(at, to.right) - depth * free.x);
            over = std::max(over, glm::dot(at, to.up) + depth * free.y);
            under = std::min(under, glm::dot(at, to.up) - depth * free.y);
        }
    }
    return {0.5F * (right - left) / free.x,
            0.5F * (over - under) / free.y,
            0.5F * (right + left),
            over,
            under};
}

glm::vec3 middle_of(const StageBox& box) noexcept { return 0.5F * (box.low + box.high); }

// Half of what the box may take at 1 m. A picture that is too narrow has no room to give away.
Lens free_part(const ShotView& view, Lens lens) noexcept {
    const float aside = std::min(view.margin, ShotView::kSideMargin);
    return {(1.0F - 2.0F * aside) * lens.x, (1.0F - 2.0F * view.margin) * lens.y};
}

}  // namespace

std::string_view name_of(ShotSize size) noexcept { return rule_of(size).name; }

ShotView view_of(ShotSize size, const DancersRoom& room, float yaw, FaceOf whose) noexcept {
    const SizeRule& rule = rule_of(size);
    ShotView view;
    view.box = room.body;
    view.outline = room.outline;
    view.yaw = yaw;
    view.pitch = glm::radians(rule.pitch_degrees);
    view.fov = glm::radians(rule.fov_degrees);
    view.margin = rule.margin;
    switch (size) {
        case ShotSize::wide:
        case ShotSize::low:
        case ShotSize::full:
            break;
        case ShotSize::knees_up:
            view.box.low.y = kBelowKnees * room.hips;
            break;
        case ShotSize::upper_body:
            view.box.low.y = std::min(kBelowWaist * room.hips, room.hand);
            break;
        case ShotSize::face:
            view.box = room.faces[static_cast<std::size_t>(whose)];
            view.outline = outline_of(view.box);
            break;
        case ShotSize::feet:
            view.box = room.feet;
            view.outline = outline_of(view.box);
            view.box.low.y = 0.0F;
            view.box.high.y = kOverThighs * room.hips;
            break;
    }
    return view;
}

ShotView between(const ShotView& from, const ShotView& to, float share) noexcept {
    const float turn = 2.0F * glm::pi<float>();
    const float yaw_by = to.yaw - from.yaw;
    const float shorter = yaw_by - turn * std::round(yaw_by / turn);
    ShotView view = from;
    view.box = {glm::mix(from.box.low, to.box.low, share),
                glm::mix(from.box.high, to.box.high, share)};
    for (std::size_t i = 0; i < view.outline.size(); ++i) {
        view.outline[i] = glm::mix(from.outline[i], to.outline[i], share);
    }
    view.yaw = from.yaw + share * shorter;
    view.pitch = glm::mix(from.pitch, to.pitch, share);
    view.fov = glm::mix(from.fov, to.fov, share);
    view.margin = glm::mix(from.margin, to.margin, share);
    return view;
}

Camera camera_of(const ShotView& view, float aspect) noexcept {
    const Directions to = directions_of(view.yaw, view.pitch);
    const Lens free = free_part(view, lens_of(view, aspect));
    const Fit fit = fit_of(view, to, free);
    const float along = std::max(fit.by_width, fit.by_height);
    // All heights between these two show the whole box.
    const float lowest = fit.over - along * free.y;
    const float highest = fit.under + along * free.y;
    // The floor under the box, too, where there is room: as a box that stands on it would be shown.
    ShotView standing = view;
    standing.box.low.y = 0.0F;
    const float with_floor = fit_of(standing, to, free).under + along * free.y;
    const float height =
        std::clamp(0.5F * (fit.over - along * free.y + with_floor), lowest, highest);
    const glm::vec3 eye = fit.aside * to.right + height * to.up + along * to.toward;
    Camera camera;
    camera.yaw = view.yaw;
    camera.pitch = view.pitch;
    camera.vertical_fov = view.fov;
    camera.distance = std::clamp(along - glm::dot(middle_of(view.box), to.toward),
                                 Camera::kMinDistance,
                                 Camera::kMaxDistance);
    camera.target = eye - camera.distance * to.toward;
    return camera;
}

float width_demand(const ShotView& view, float aspect) noexcept {
    const Directions to = directions_of(view.yaw, view.pitch);
    const Fit fit = fit_of(view, to, free_part(view, lens_of(view, aspect)));
    const float before = glm::dot(middle_of(view.box), to.toward);
    return std::max((fit.by_width - before) / (fit.by_height - before), 1.0F);
}

}  // namespace raks::render
