#include "render/scene/dancers_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/time.hpp"

#include <glm/common.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::WorldPose;

const float kRoomHop = static_cast<float>(to_seconds(kHop));

// Metres from a joint to the skin, and a little air.
constexpr float kAroundJoint = 0.14F;
constexpr float kAroundFoot = 0.20F;
// From a wrist to the fingertips, and a little air.
constexpr float kAroundHand = 0.20F;
// From the head's joint to the edges of a face shot, and down to the collar bones.
constexpr float kAroundFace = 0.19F;
constexpr float kBelowFace = 0.20F;
// From the head's joint to its top.
constexpr float kOverHead = 0.25F;
// Nobody is shown smaller than one who stands with the arms down.
constexpr float kLeastReach = 0.45F;
// Seconds in which an edge that nobody reaches any more does two thirds of its way back.
constexpr float kShrinkSeconds = 3.0F;
// A picture of a face is no larger than it must be: it goes along with the head.
constexpr float kFaceShrinkSeconds = 0.8F;
// And its way out to who leaves the room.
constexpr float kGrowSeconds = 0.08F;
// Time constant of the springs.
constexpr float kSpringSeconds = 0.16F;
// The room leads who travels by this much: as far as its springs and the camera's lag behind.
constexpr float kLeadSeconds = 0.65F;
// Time constant of the speed of travel: steps to and fro cancel out.
constexpr float kSpeedSeconds = 0.4F;

constexpr std::array<Bone, 4> kOuterJoints = {
    Bone::left_lower_arm, Bone::right_lower_arm, Bone::left_lower_leg, Bone::right_lower_leg};
constexpr std::array<Bone, 2> kRoomHands = {Bone::left_hand, Bone::right_hand};
constexpr std::array<Bone, 2> kRoomFeet = {Bone::left_foot, Bone::right_foot};

void include(StageBox& box, glm::vec3 at, float around) noexcept {
    box.low = glm::min(box.low, at - glm::vec3(around));
    box.high = glm::max(box.high, at + glm::vec3(around));
}

StageBox face_of(const WorldPose& dancer) noexcept {
    const glm::vec3 head = dancer.position(Bone::head);
    return {head - glm::vec3(kAroundFace, kBelowFace, kAroundFace),
            head + glm::vec3(kAroundFace, kOverHead, kAroundFace)};
}

// What the dancers take at this moment.
DancersRoom taken_by(std::span<const WorldPose> dancers) noexcept {
    const glm::vec3 first = dancers.front().position(Bone::hips);
    DancersRoom room{
        .body = {first, first}, .feet = {first, first}, .hips = first.y, .hand = first.y};
    for (const WorldPose& dancer : dancers) {
        const glm::vec3 hips = dancer.position(Bone::hips);
        const glm::vec3 head = dancer.position(Bone::head);
        include(room.body, {hips.x, hips.y, hips.z}, kLeastReach);
        for (const Bone joint : kOuterJoints) {
            include(room.body, dancer.position(joint), kAroundJoint);
        }
        for (const Bone hand : kRoomHands) {
            include(room.body, dancer.position(hand), kAroundHand);
            room.hand = std::min(room.hand, dancer.position(hand).y - kAroundHand);
        }
        for (const Bone foot : kRoomFeet) {
            include(room.body, dancer.position(foot), kAroundFoot);
            include(room.feet, dancer.position(foot), kAroundFoot);
        }
        room.hips = std::min(room.hips, hips.y);
        room.head = std::max(room.head, head.y + kOverHead);
    }
    room.faces[0] = face_of(dancers.front());
    room.faces[1] = face_of(dancers.size() == 2 ? dancers.back() : dancers.front());
    room.faces[2] = {glm::min(room.faces[0].low, room.faces[1].low),
                     glm::max(room.faces[0].high, room.faces[1].high)};
    room.body.low.y = 0.0F;
    room.body.high.y = std::max(room.body.high.y, room.head);
    return room;
}

constexpr std::size_t kGirths = std::tuple_size_v<StageOutline>;

// How far the dancers reach along each of the directions around them: that of the outline's lines.
using Girth = std::array<float, kGirths>;

glm::vec2 girth_direction(std::size_t number) noexcept {
    const float angle =
        2.0F * glm::pi<float>() * static_cast<float>(number) / static_cast<float>(kGirths);
    return {std::cos(angle), std::sin(angle)};
}

const std::array<glm::vec2, kGirths> kGirthDirections = [] {
    std::array<glm::vec2, kGirths> directions;
    for (std::size_t i = 0; i < kGirths; ++i) {
        directions[i] = girth_direction(i);
    }
    return directions;
}();

void include(Girth& girth, glm::vec3 at, float around) noexcept {
    for (std::size_t i = 0; i < kGirths; ++i) {
        girth[i] = std::max(girth[i], glm::dot(kGirthDirections[i], {at.x, at.z}) + around);
    }
}

Girth girth_of(std::span<const WorldPose> dancers, glm::vec3 ahead) noexcept {
    Girth girth;
    girth.fill(std::numeric_limits<float>::lowest());
    for (const WorldPose& dancer : dancers) {
        include(girth, dancer.position(Bone::hips), kLeastReach);
        include(girth, dancer.position(Bone::head), kAroundFace);
        for (const Bone joint : kOuterJoints) {
            include(girth, dancer.position(joint), kAroundJoint);
        }
        for (const Bone hand : kRoomHands) {
            include(girth, dancer.position(hand), kAroundHand);
        }
        for (const Bone foot : kRoomFeet) {
            include(girth, dancer.position(foot), kAroundFoot);
        }
    }
    for (std::size_t i = 0; i < kGirths; ++i) {
        // The place where they would be soon is part of the room, too.
        girth[i] += std::max(glm::dot(kGirthDirections[i], {ahead.x, ahead.z}), 0.0F);
    }
    return girth;
}

// Where neighbouring lines of the outline meet.
StageOutline outline_of(const Girth& girth) noexcept {
    StageOutline outline;
    for (std::size_t i = 0; i < kGirths; ++i) {
        const std::size_t next = (i + 1) % kGirths;
        const glm::vec2 one = kGirthDirections[i];
        const glm::vec2 two = kGirthDirections[next];
        const float sine = one.x * two.y - one.y * two.x;
        outline[i] = {(girth[i] * two.y - girth[next] * one.y) / sine,
                      (girth[next] * one.x - girth[i] * two.x) / sine};
    }
    return outline;
}

glm::vec3 middle_of(std::span<const WorldPose> dancers) noexcept {
    glm::vec3 sum{};
    for (const WorldPose& dancer : dancers) {
        sum += dancer.position(Bone::hips);
    }
    return sum / static_cast<float>(dancers.size());
}

// The place where it would be soon is part of the room, too.
void lead(StageBox& box, glm::vec3 by) noexcept {
    box.low = glm::min(box.low, box.low + by);
    box.high = glm::max(box.high, box.high + by);
}

}  // namespace

StageOutline outline_of(const StageBox& box) noexcept {
    StageOutline outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        // Counted round from +x over +z, as the lines of an outline are.
        const std::size_t quarter = 4 * i / outline.size();
        outline[i] = {quarter == 0 || quarter == 3 ? box.high.x : box.low.x,
                      quarter < 2 ? box.high.z : box.low.z};
    }
    return outline;
}

void DancersRoomKeeper::Edge::begin(float at) noexcept {
    held = at;
    spring.begin(at);
}

// `outward`: 1 where the edge's coordinate grows outward, else -1.
void DancersRoomKeeper::Edge::grow(float to, float outward, float shrink_seconds) noexcept {
    const float shrink = 1.0F - std::exp(-kRoomHop / shrink_seconds);
    const float grow = 1.0F - std::exp(-kRoomHop / kGrowSeconds);
    const bool is_outside = (to - held) * outward > 0.0F;
    held += (is_outside ? grow : shrink) * (to - held);
    spring.follow(held, kRoomHop, kSpringSeconds);
}

const DancersRoom& DancersRoomKeeper::advance(std::span<const WorldPose> dancers) noexcept {
    const glm::vec3 middle = middle_of(dancers);
    if (!has_begun_) {
        speed_ = glm::vec3(0.0F);
        middle_ = middle;
    }
    const float share = 1.0F - std::exp(-kRoomHop / kSpeedSeconds);
    speed_ += share * ((middle - middle_) / kRoomHop - speed_);
    middle_ = middle;

    DancersRoom taken = taken_by(dancers);
    const glm::vec3 ahead = kLeadSeconds * glm::vec3(speed_.x, 0.0F, speed_.z);
    lead(taken.body, ahead);
    lead(taken.feet, ahead);
    const auto follow = [this](Edge& edge, float to, float outward, float shrink = kShrinkSeconds) {
        has_begun_ ? edge.grow(to, outward, shrink) : edge.begin(to);
        return edge.spring.place;
    };
    for (int axis = 0; axis < 3; ++axis) {
        room_.body.low[axis] = follow(body_low_[axis], taken.body.low[axis], -1.0F);
        room_.body.high[axis] = follow(body_high_[axis], taken.body.high[axis], 1.0F);
    }
    for (int i = 0; i < 2; ++i) {
        const int axis = 2 * i;
        room_.feet.low[axis] = follow(feet_low_[i], taken.feet.low[axis], -1.0F);
        room_.feet.high[axis] = follow(feet_high_[i], taken.feet.high[axis], 1.0F);
    }
    const Girth girth = girth_of(dancers, ahead);
    Girth shown;
    for (std::size_t i = 0; i < kGirths; ++i) {
        shown[i] = follow(girth_[i], girth[i], 1.0F);
    }
    room_.outline = outline_of(shown);
    room_.hips = follow(hips_, taken.hips, -1.0F);
    room_.head = follow(head_, taken.head, 1.0F);
    room_.hand = follow(hand_, taken.hand, -1.0F);
    for (std::size_t i = 0; i < taken.faces.size(); ++i) {
        lead(taken.faces[i], ahead);
        for (int axis = 0; axis < 3; ++axis) {
            room_.faces[i].low[axis] =
                follow(face_low_[i][axis], taken.faces[i].low[axis], -1.0F, kFaceShrinkSeconds);
            room_.faces[i].high[axis] =
                follow(face_high_[i][axis], taken.faces[i].high[axis], 1.0F, kFaceShrinkSeconds);
        }
    }
    has_begun_ = true;
    return room_;
}

}  // namespace raks::render
