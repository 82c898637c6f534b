#pragma once

namespace raks::audio {

// Keys of General MIDI's percussion map (RP-003).
inline constexpr int kKick = 36;
inline constexpr int kRim = 37;
inline constexpr int kSnare = 38;
inline constexpr int kClap = 39;
inline constexpr int kLowTom = 41;
inline constexpr int kHat = 42;
inline constexpr int kFloorTom = 43;
inline constexpr int kPedalHat = 44;
inline constexpr int kTom = 45;
inline constexpr int kOpenHat = 46;
inline constexpr int kRide = 51;
inline constexpr int kTambourine = 54;
inline constexpr int kCowbell = 56;
inline constexpr int kHighBongo = 60;
inline constexpr int kLowBongo = 61;
inline constexpr int kSlapConga = 62;
inline constexpr int kOpenConga = 63;
inline constexpr int kLowConga = 64;
inline constexpr int kTimbale = 65;
inline constexpr int kAgogo = 67;
inline constexpr int kCabasa = 69;
inline constexpr int kMaracas = 70;
inline constexpr int kGuiro = 73;
inline constexpr int kLongGuiro = 74;
inline constexpr int kClaves = 75;
inline constexpr int kWoodBlock = 76;
inline constexpr int kShaker = 82;
inline constexpr int kMuteTriangle = 80;
inline constexpr int kTriangle = 81;

}  // namespace raks::audio
