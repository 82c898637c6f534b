// The gestures that end a song. Each ends in standing.
#include <array>

#include "motion/dance/dynamics/gesture.hpp"

namespace raks::motion {
namespace {

using Key = GestureKey;
using Hand = GestureHand;

constexpr std::array kBowKeys = {Key{0.9F, {.bow = 1.0F, .head_nod = 0.10F}},
                                 Key{1.3F, {.bow = 0.95F, .head_nod = 0.08F}},
                                 Key{2.4F, {.chest = 0.05F}},
                                 Key{3.2F, {}}};
constexpr std::array kBowHands = {Hand{Side::right, HandPlace::waist, 0.0, 1.5}};
constexpr std::array kCurtsyKeys = {
    Key{0.6F, {.weight = 0.9F, .drop = 0.02F, .chest = 0.06F}},
    Key{1.4F,
        {.weight = 0.8F, .drop = 0.16F, .bow = 0.30F, .head_nod = 0.22F, .right_heel = 0.60F}},
    Key{1.8F,
        {.weight = 0.8F, .drop = 0.15F, .bow = 0.28F, .head_nod = 0.20F, .right_heel = 0.60F}},
    Key{2.8F, {.weight = 0.4F, .chest = 0.06F}},
    Key{3.4F, {}}};
constexpr std::array kCurtsyHands = {Hand{Side::left, HandPlace::low, 0.0, 2.1},
                                     Hand{Side::right, HandPlace::low, 0.0, 2.1}};
constexpr std::array kWaveKeys = {
    Key{0.8F, {.weight = -0.5F, .side = 0.05F, .chest = 0.08F, .right_wave = 0.30F}},
    Key{1.6F,
        {.weight = -0.6F,
         .side = -0.04F,
         .chest = 0.08F,
         .head_turn = 0.25F,
         .head_tilt = 0.10F,
         .right_wave = 0.35F}},
    Key{2.3F, {.weight = -0.4F, .head_turn = -0.25F, .right_wave = 0.25F}},
    Key{3.2F, {}}};
constexpr std::array kWaveHands = {Hand{Side::right, HandPlace::high, 0.0, 2.4}};
constexpr std::array kHeartKeys = {Key{0.9F, {.weight = 0.4F, .chest = 0.05F, .head_tilt = 0.10F}},
                                   Key{1.5F, {.weight = 0.4F, .bow = 0.45F, .head_nod = 0.16F}},
                                   Key{1.9F, {.weight = 0.3F, .bow = 0.42F, .head_nod = 0.14F}},
                                   Key{2.8F, {.weight = 0.2F, .chest = 0.06F}},
                                   Key{3.4F, {}}};
constexpr std::array kHeartHands = {Hand{Side::right, HandPlace::chest, 0.0, 2.2}};
constexpr std::array kFlourishKeys = {
    Key{0.9F, {.weight = 0.7F, .drop = -0.01F, .side = -0.06F, .chest = 0.16F, .head_nod = -0.10F}},
    Key{1.7F, {.weight = 0.5F, .drop = 0.04F, .bow = 0.60F, .head_nod = 0.12F}},
    Key{2.1F, {.weight = 0.5F, .drop = 0.04F, .bow = 0.58F, .head_nod = 0.10F}},
    Key{3.0F, {.weight = 0.2F, .chest = 0.08F}},
    Key{3.6F, {}}};
constexpr std::array kFlourishHands = {Hand{Side::left, HandPlace::wide, 0.0, 2.2},
                                       Hand{Side::right, HandPlace::high, 0.0, 1.1},
                                       Hand{Side::right, HandPlace::wide, 1.1, 2.2}};
constexpr std::array kStanceKeys = {
    Key{0.8F,
        {.weight = -0.7F,
         .drop = 0.015F,
         .ahead = 0.02F,
         .lean = -0.10F,
         .chest = 0.06F,
         .head_nod = -0.10F,
         .head_tilt = 0.08F}},
    Key{1.7F,
        {.weight = -0.8F,
         .drop = 0.015F,
         .ahead = 0.03F,
         .lean = -0.12F,
         .head_nod = 0.12F,
         .head_tilt = 0.10F}},
    Key{2.4F, {.weight = -0.7F, .ahead = 0.02F, .lean = -0.08F, .head_nod = -0.04F}},
    Key{3.4F, {}}};
constexpr std::array kStanceHands = {Hand{Side::left, HandPlace::chest, 0.0, 2.4},
                                     Hand{Side::right, HandPlace::waist, 0.0, 2.4}};
constexpr std::array kFistKeys = {
    Key{0.5F, {.weight = 0.4F, .drop = 0.05F, .lean = 0.08F, .head_nod = 0.16F}},
    Key{1.0F, {.weight = 0.5F, .lean = -0.08F, .side = 0.06F, .chest = 0.14F, .head_nod = -0.12F}},
    Key{1.9F, {.weight = 0.5F, .lean = -0.06F, .side = 0.04F, .chest = 0.10F, .head_nod = 0.14F}},
    Key{2.5F, {.weight = 0.3F}},
    Key{3.2F, {}}};
constexpr std::array kFistHands = {Hand{Side::right, HandPlace::high, 0.3, 2.1}};
constexpr std::array kPointKeys = {
    Key{0.7F, {.weight = 0.6F, .ahead = 0.03F, .lean = 0.08F, .twist = 0.12F, .head_tilt = 0.08F}},
    Key{1.5F,
        {.weight = 0.7F,
         .ahead = 0.03F,
         .lean = 0.04F,
         .twist = 0.20F,
         .head_turn = -0.10F,
         .head_nod = 0.14F}},
    Key{2.2F, {.weight = 0.4F, .head_nod = -0.06F}},
    Key{3.2F, {}}};
constexpr std::array kPointHands = {Hand{Side::right, HandPlace::offered, 0.0, 1.9}};
constexpr std::array kNodKeys = {
    Key{0.6F, {.weight = 0.6F, .drop = 0.015F, .head_nod = 0.24F}},
    Key{1.0F, {.weight = 0.6F, .head_nod = -0.10F}},
    Key{1.5F, {.weight = 0.6F, .drop = 0.015F, .head_turn = 0.15F, .head_nod = 0.22F}},
    Key{2.0F, {.weight = 0.5F, .chest = 0.06F, .head_nod = -0.10F}},
    Key{3.0F, {}}};

/// In the order of Ending.
constexpr std::array<Gesture, kEndingNames.size()> kEndingGestures = {
    {{kBowKeys, kBowHands},
     {kCurtsyKeys, kCurtsyHands},
     {kWaveKeys, kWaveHands, 1.8F},
     {kHeartKeys, kHeartHands},
     {kFlourishKeys, kFlourishHands},
     {kStanceKeys, kStanceHands},
     {kFistKeys, kFistHands},
     {kPointKeys, kPointHands},
     {kNodKeys, {}}}};

}  // namespace

const Gesture& gesture_of(Ending ending) noexcept RAKS_NONBLOCKING {
    return kEndingGestures[static_cast<std::size_t>(ending)];
}

}  // namespace raks::motion
