// The gestures of those who wait. Each ends in the stance in which the next one begins.
#include <array>

#include "motion/dance/dynamics/gesture.hpp"

namespace raks::motion {
namespace {

using Key = GestureKey;
using Hand = GestureHand;

constexpr std::array kWeightKeys = {
    Key{1.2F, {.weight = 1.0F, .hips_turn = 0.06F, .side = -0.05F, .head_tilt = 0.05F}},
    Key{2.4F, {.weight = 0.8F, .hips_turn = -0.05F, .side = 0.04F, .right_heel = 0.25F}},
    Key{3.8F, {.weight = 0.7F, .right_heel = 0.0F}}};
constexpr std::array kLookKeys = {
    Key{0.9F, {.weight = 0.3F, .twist = 0.12F, .head_turn = 0.75F, .head_nod = 0.04F}},
    Key{1.6F, {.weight = 0.3F, .twist = 0.14F, .head_turn = 0.68F, .head_nod = -0.05F}},
    Key{2.7F, {.weight = -0.3F, .twist = -0.12F, .head_turn = -0.62F}},
    Key{3.9F, {.weight = -0.4F}}};
constexpr std::array kBreatheKeys = {
    Key{1.6F,
        {.lean = -0.05F,
         .chest = 0.16F,
         .shoulders = 0.10F,
         .left_out = 0.06F,
         .right_out = 0.06F}},
    Key{3.0F,
        {.drop = 0.012F, .lean = 0.05F, .chest = -0.05F, .head_nod = 0.08F, .shoulders = -0.02F}},
    Key{4.0F, {}}};
constexpr std::array kStretchKeys = {
    Key{1.1F,
        {.weight = 0.4F, .lean = -0.10F, .chest = 0.12F, .head_nod = -0.12F, .shoulders = 0.10F}},
    Key{1.9F,
        {.weight = -0.5F,
         .lean = -0.10F,
         .side = -0.16F,
         .chest = 0.12F,
         .head_nod = -0.10F,
         .shoulders = 0.12F}},
    Key{2.7F, {.weight = -0.3F, .side = 0.06F, .head_tilt = 0.06F}},
    Key{3.9F, {.weight = -0.5F}}};
constexpr std::array kStretchHands = {Hand{Side::left, HandPlace::high, 0.1, 2.1},
                                      Hand{Side::right, HandPlace::high, 0.25, 2.0}};
constexpr std::array kTapKeys = {
    Key{0.9F, {.weight = -0.9F, .side = 0.05F, .left_toes = 0.0F}},
    Key{1.2F, {.weight = -0.9F, .side = 0.05F, .left_toes = 0.38F}},
    Key{1.5F, {.weight = -0.9F, .side = 0.05F, .head_nod = 0.05F, .left_toes = 0.0F}},
    Key{1.8F, {.weight = -0.9F, .side = 0.05F, .left_toes = 0.38F}},
    Key{2.1F, {.weight = -0.9F, .side = 0.04F, .head_nod = 0.05F, .left_toes = 0.0F}},
    Key{2.4F, {.weight = -0.9F, .side = 0.03F, .head_turn = 0.1F, .left_toes = 0.34F}},
    Key{2.7F, {.weight = -0.8F, .head_turn = 0.15F, .left_toes = 0.0F}},
    Key{3.9F, {.weight = -0.6F}}};
constexpr std::array kShakeKeys = {Key{0.8F,
                                       {.weight = 0.3F,
                                        .lean = 0.05F,
                                        .head_nod = 0.10F,
                                        .left_out = 0.14F,
                                        .right_out = 0.14F,
                                        .left_bend = 0.25F,
                                        .right_bend = 0.25F,
                                        .left_shake = 0.30F,
                                        .right_shake = 0.30F}},
                                   Key{1.7F,
                                       {.weight = -0.3F,
                                        .lean = 0.04F,
                                        .head_tilt = 0.06F,
                                        .left_out = 0.12F,
                                        .right_out = 0.12F,
                                        .left_bend = 0.15F,
                                        .right_bend = 0.15F,
                                        .left_shake = 0.30F,
                                        .right_shake = 0.30F}},
                                   Key{2.7F, {.weight = -0.4F, .chest = 0.06F}},
                                   Key{3.8F, {.weight = -0.2F}}};
constexpr std::array kShouldersKeys = {
    Key{0.7F, {.lean = 0.05F, .shoulders = 0.10F, .left_fore = 0.10F, .right_fore = 0.10F}},
    Key{1.3F,
        {.lean = -0.03F,
         .chest = 0.14F,
         .shoulders = 0.16F,
         .left_fore = -0.12F,
         .right_fore = -0.12F}},
    Key{2.0F,
        {.lean = -0.02F,
         .chest = 0.06F,
         .shoulders = -0.03F,
         .left_fore = -0.08F,
         .right_fore = -0.08F}},
    Key{2.9F, {.side = 0.06F, .head_tilt = -0.08F, .shoulders = 0.05F}},
    Key{3.9F, {}}};
constexpr std::array kNeckKeys = {
    Key{1.0F, {.weight = 0.2F, .head_nod = 0.06F, .head_tilt = 0.34F}},
    Key{1.9F, {.weight = 0.1F, .head_nod = 0.28F}},
    Key{2.8F, {.weight = -0.2F, .head_nod = 0.06F, .head_tilt = -0.34F}},
    Key{3.9F, {.weight = -0.3F}}};
constexpr std::array kSwayKeys = {
    Key{0.8F, {.weight = 0.9F, .hips_turn = 0.05F, .side = -0.06F, .left_fore = 0.05F}},
    Key{1.7F, {.weight = -0.9F, .hips_turn = -0.05F, .side = 0.06F, .right_fore = 0.05F}},
    Key{2.6F, {.weight = 0.8F, .hips_turn = 0.05F, .side = -0.05F, .left_fore = 0.04F}},
    Key{3.8F, {.weight = 0.1F}}};
constexpr std::array kToesKeys = {
    Key{0.8F, {.drop = 0.02F, .ahead = 0.02F}},
    Key{1.5F,
        {.drop = -0.045F, .ahead = 0.06F, .chest = 0.06F, .left_heel = 0.42F, .right_heel = 0.42F}},
    Key{2.2F,
        {.drop = -0.04F,
         .ahead = 0.06F,
         .head_turn = 0.1F,
         .left_heel = 0.38F,
         .right_heel = 0.38F}},
    Key{3.0F, {.drop = 0.025F, .ahead = 0.01F, .lean = 0.03F}},
    Key{3.9F, {}}};
constexpr std::array kKneesKeys = {
    Key{0.8F, {.drop = 0.07F, .lean = 0.10F, .left_fore = 0.15F, .right_fore = 0.15F}},
    Key{1.4F, {.drop = 0.0F}},
    Key{2.1F, {.drop = 0.09F, .lean = 0.13F, .left_fore = 0.20F, .right_fore = 0.20F}},
    Key{2.9F, {.lean = -0.02F, .chest = 0.05F}},
    Key{3.8F, {.weight = 0.3F}}};
constexpr std::array kUpKeys = {
    Key{1.0F, {.weight = 0.4F, .lean = -0.06F, .head_turn = 0.30F, .head_nod = -0.30F}},
    Key{2.1F, {.weight = 0.5F, .lean = -0.06F, .head_turn = -0.25F, .head_nod = -0.32F}},
    Key{3.0F, {.weight = 0.5F, .head_nod = 0.06F}},
    Key{3.9F, {.weight = 0.4F}}};
constexpr std::array kTwistKeys = {Key{0.8F,
                                       {.hips_turn = 0.12F,
                                        .twist = 0.45F,
                                        .head_turn = 0.15F,
                                        .left_out = 0.15F,
                                        .right_out = 0.15F,
                                        .right_fore = 0.30F}},
                                   Key{1.7F,
                                       {.hips_turn = -0.12F,
                                        .twist = -0.45F,
                                        .head_turn = -0.15F,
                                        .left_out = 0.15F,
                                        .right_out = 0.15F,
                                        .left_fore = 0.30F}},
                                   Key{2.6F,
                                       {.hips_turn = 0.08F,
                                        .twist = 0.30F,
                                        .left_out = 0.10F,
                                        .right_out = 0.10F,
                                        .right_fore = 0.15F}},
                                   Key{3.7F, {.weight = -0.2F}}};
constexpr std::array kLoosenKeys = {
    Key{0.8F, {.weight = -0.9F, .side = 0.05F, .left_heel = 0.55F}},
    Key{1.7F, {.weight = 0.9F, .side = -0.05F, .right_heel = 0.55F}},
    Key{2.5F, {.weight = -0.8F, .side = 0.04F, .left_heel = 0.40F}},
    Key{3.7F, {.weight = -0.5F}}};
constexpr std::array kFoldKeys = {
    Key{1.1F, {.weight = 0.5F, .head_tilt = 0.08F}},
    Key{2.2F, {.weight = 0.7F, .twist = 0.06F, .head_turn = 0.20F, .head_tilt = 0.08F}},
    Key{3.0F, {.weight = 0.3F, .head_turn = -0.10F}},
    Key{3.9F, {.weight = 0.2F}}};
constexpr std::array kFoldHands = {Hand{Side::left, HandPlace::waist, 0.1, 2.5},
                                   Hand{Side::right, HandPlace::waist, 0.2, 2.6}};
constexpr std::array kAkimboKeys = {
    Key{1.0F, {.weight = 1.0F, .side = -0.08F, .head_tilt = 0.08F}},
    Key{2.0F,
        {.weight = 0.9F,
         .hips_turn = 0.06F,
         .side = -0.06F,
         .head_turn = 0.30F,
         .right_heel = 0.20F}},
    Key{2.8F, {.weight = 0.8F, .side = -0.02F, .head_turn = -0.05F}},
    Key{3.9F, {.weight = 0.5F}}};
constexpr std::array kAkimboHands = {Hand{Side::left, HandPlace::hip, 0.2, 2.4}};

constexpr std::array kBounceKeys = {
    Key{0.5F, {.drop = 0.045F, .head_nod = 0.08F, .left_bend = 0.2F, .right_bend = 0.2F}},
    Key{0.9F, {.drop = 0.0F, .side = 0.05F, .left_bend = 0.2F, .right_bend = 0.2F}},
    Key{1.3F, {.drop = 0.055F, .head_nod = 0.10F, .left_bend = 0.3F, .right_bend = 0.3F}},
    Key{1.7F, {.drop = 0.0F, .side = -0.05F, .left_bend = 0.3F, .right_bend = 0.3F}},
    Key{2.1F, {.drop = 0.055F, .head_nod = 0.10F, .left_bend = 0.3F, .right_bend = 0.3F}},
    Key{2.6F, {.weight = 0.4F, .left_bend = 0.1F, .right_bend = 0.1F}},
    Key{3.7F, {.weight = 0.6F}}};
constexpr std::array kChestKeys = {
    Key{0.6F, {.chest = 0.22F, .left_fore = -0.06F, .right_fore = -0.06F}},
    Key{1.1F,
        {.drop = 0.015F,
         .chest = -0.14F,
         .shoulders = 0.04F,
         .left_fore = 0.08F,
         .right_fore = 0.08F}},
    Key{1.6F, {.chest = 0.22F, .left_fore = -0.06F, .right_fore = -0.06F}},
    Key{2.2F, {.drop = 0.02F, .chest = -0.16F, .shoulders = 0.04F}},
    Key{2.9F, {.weight = -0.4F, .chest = 0.05F}},
    Key{3.8F, {.weight = -0.5F}}};
constexpr std::array kShimmyKeys = {
    Key{0.6F, {.drop = 0.02F, .lean = -0.04F, .left_out = 0.25F, .right_out = 0.25F}},
    Key{0.8F, {.drop = 0.02F, .lean = -0.04F, .twist = 0.16F, .left_out = 0.3F, .right_out = 0.3F}},
    Key{1.0F,
        {.drop = 0.02F, .lean = -0.03F, .twist = -0.16F, .left_out = 0.3F, .right_out = 0.3F}},
    Key{1.2F, {.drop = 0.02F, .lean = -0.02F, .twist = 0.16F, .left_out = 0.3F, .right_out = 0.3F}},
    Key{1.4F, {.drop = 0.02F, .twist = -0.16F, .left_out = 0.3F, .right_out = 0.3F}},
    Key{1.6F, {.drop = 0.02F, .lean = 0.02F, .twist = 0.14F, .left_out = 0.3F, .right_out = 0.3F}},
    Key{1.8F,
        {.drop = 0.02F, .lean = 0.04F, .twist = -0.12F, .left_out = 0.25F, .right_out = 0.25F}},
    Key{2.6F, {.weight = 0.5F, .head_tilt = 0.08F}},
    Key{3.8F, {.weight = 0.7F}}};
constexpr std::array kCircleKeys = {
    Key{0.7F, {.weight = 1.0F, .ahead = 0.0F, .side = -0.08F}},
    Key{1.2F, {.weight = 0.0F, .drop = 0.01F, .ahead = 0.07F, .lean = -0.10F}},
    Key{1.7F, {.weight = -1.0F, .ahead = 0.0F, .side = 0.08F}},
    Key{2.2F, {.weight = 0.0F, .drop = 0.01F, .ahead = -0.06F, .lean = 0.10F}},
    Key{2.7F, {.weight = 0.9F, .ahead = 0.0F, .side = -0.06F}},
    Key{3.7F, {.weight = 0.4F}}};
constexpr std::array kArmKeys = {
    Key{1.1F, {.weight = 0.7F, .side = -0.06F, .chest = 0.08F, .head_turn = 0.45F}},
    Key{2.1F,
        {.weight = 0.8F,
         .side = -0.03F,
         .twist = 0.10F,
         .chest = 0.08F,
         .head_turn = 0.20F,
         .head_tilt = 0.06F,
         .left_shake = 0.0F}},
    Key{3.0F, {.weight = 0.3F}},
    Key{3.9F, {.weight = 0.2F}}};
constexpr std::array kArmHands = {Hand{Side::left, HandPlace::wide, 0.1, 2.3}};
constexpr std::array kCrossedKeys = {
    Key{1.0F, {.weight = -0.6F, .ahead = 0.02F, .lean = -0.08F, .head_nod = -0.06F}},
    Key{2.0F,
        {.weight = -0.8F, .ahead = 0.03F, .lean = -0.10F, .head_turn = 0.25F, .head_tilt = 0.10F}},
    Key{2.9F, {.weight = -0.5F, .head_nod = 0.08F}},
    Key{3.9F, {.weight = -0.6F}}};
constexpr std::array kCrossedHands = {Hand{Side::left, HandPlace::chest, 0.1, 2.4},
                                      Hand{Side::right, HandPlace::waist, 0.2, 2.5}};
constexpr std::array kBangKeys = {
    Key{0.6F, {.drop = 0.03F, .lean = 0.22F, .head_nod = 0.30F}},
    Key{1.0F, {.lean = -0.04F, .head_nod = -0.12F}},
    Key{1.4F, {.drop = 0.04F, .lean = 0.26F, .head_nod = 0.34F, .left_bend = 0.2F}},
    Key{1.9F, {.lean = -0.05F, .head_nod = -0.12F}},
    Key{2.4F, {.drop = 0.03F, .lean = 0.18F, .head_turn = 0.1F, .head_nod = 0.22F}},
    Key{3.0F, {.weight = 0.4F}},
    Key{3.8F, {.weight = 0.6F}}};
constexpr std::array kNodsKeys = {
    Key{0.6F, {.weight = 0.5F, .drop = 0.012F, .head_nod = 0.18F}},
    Key{1.0F, {.weight = 0.5F, .head_turn = 0.05F, .head_nod = -0.05F}},
    Key{1.5F, {.weight = 0.6F, .drop = 0.012F, .head_turn = 0.08F, .head_nod = 0.20F}},
    Key{1.9F, {.weight = 0.5F, .head_turn = 0.05F, .head_nod = -0.05F}},
    Key{2.4F, {.weight = -0.2F, .drop = 0.015F, .head_nod = 0.20F}},
    Key{3.0F, {.weight = -0.6F, .head_tilt = -0.08F}},
    Key{3.8F, {.weight = -0.5F}}};
constexpr std::array kFrameKeys = {
    Key{1.2F, {.drop = -0.01F, .lean = -0.05F, .chest = 0.10F, .head_turn = 0.20F}},
    Key{2.1F,
        {.weight = 0.5F,
         .drop = -0.01F,
         .lean = -0.05F,
         .side = 0.06F,
         .chest = 0.10F,
         .head_turn = 0.25F}},
    Key{3.0F, {.weight = 0.2F}},
    Key{3.9F, {.weight = 0.3F}}};
constexpr std::array kFrameHands = {Hand{Side::left, HandPlace::wide, 0.1, 2.3},
                                    Hand{Side::right, HandPlace::chest, 0.2, 2.3}};
constexpr std::array kPresentKeys = {
    Key{1.1F, {.weight = 0.6F, .ahead = 0.02F, .bow = 0.15F, .head_nod = 0.06F}},
    Key{2.0F, {.weight = 0.7F, .ahead = 0.02F, .bow = 0.10F, .head_tilt = 0.10F}},
    Key{2.9F, {.weight = 0.2F, .chest = 0.05F}},
    Key{3.9F, {.weight = 0.1F}}};
constexpr std::array kPresentHands = {Hand{Side::left, HandPlace::offered, 0.1, 2.2}};

/// In the order of IdleMove.
constexpr std::array<Gesture, kIdleMoveNames.size()> kIdleGestures = {
    {{kWeightKeys, {}},
     {kLookKeys, {}},
     {kBreatheKeys, {}},
     {kStretchKeys, kStretchHands},
     {kTapKeys, {}},
     {kShakeKeys, {}, 4.0F},
     {kShouldersKeys, {}},
     {kNeckKeys, {}},
     {kSwayKeys, {}},
     {kToesKeys, {}},
     {kKneesKeys, {}},
     {kUpKeys, {}},
     {kTwistKeys, {}},
     {kLoosenKeys, {}},
     {kFoldKeys, kFoldHands},
     {kAkimboKeys, kAkimboHands},
     {kBounceKeys, {}},
     {kChestKeys, {}},
     {kShimmyKeys, {}},
     {kCircleKeys, {}},
     {kArmKeys, kArmHands},
     {kCrossedKeys, kCrossedHands},
     {kBangKeys, {}},
     {kNodsKeys, {}},
     {kFrameKeys, kFrameHands},
     {kPresentKeys, kPresentHands}}};

}  // namespace

const Gesture& gesture_of(IdleMove move) noexcept RAKS_NONBLOCKING {
    return kIdleGestures[static_cast<std::size_t>(move)];
}

}  // namespace raks::motion
