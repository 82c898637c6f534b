#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace raks::audio {

/// How a rival pulse relates to the beat.
enum class RivalKind : std::uint8_t {
    twice,          ///< twice as fast
    half,           ///< half as fast
    off_beat,       ///< half a beat off
    third_off,      ///< a third of a beat off
    quarter_off,    ///< a quarter of a beat off
    three_for_two,  ///< three beats for two
    two_for_three,  ///< two beats for three
    thrice,         ///< three times as fast
    one_for_three,  ///< one beat for three: the bar of a fast waltz
};
inline constexpr std::size_t kRivalKinds = 9;  ///< number of RivalKind

/// A pulse that may be the beat in place of the one that is followed.
struct RivalPulse {
    double rate = 1.0;    ///< its beats to one of ours
    double offset = 0.0;  ///< where its beat is at ours, in its own beats
    RivalKind kind = RivalKind::off_beat;
};

/// The pulses that listeners and trackers take for the beat.
inline constexpr std::array<RivalPulse, 17> kRivalPulses = {
    {{2.0, 0.0, RivalKind::twice},
     {0.5, 0.0, RivalKind::half},
     {0.5, 0.5, RivalKind::half},
     {1.0, 0.5, RivalKind::off_beat},
     {1.0, 1.0 / 3.0, RivalKind::third_off},
     {1.0, 2.0 / 3.0, RivalKind::third_off},
     {1.0, 0.25, RivalKind::quarter_off},
     {1.0, 0.75, RivalKind::quarter_off},
     {1.5, 0.0, RivalKind::three_for_two},
     {1.5, 0.5, RivalKind::three_for_two},
     {2.0 / 3.0, 0.0, RivalKind::two_for_three},
     {2.0 / 3.0, 1.0 / 3.0, RivalKind::two_for_three},
     {2.0 / 3.0, 2.0 / 3.0, RivalKind::two_for_three},
     {3.0, 0.0, RivalKind::thrice},
     {1.0 / 3.0, 0.0, RivalKind::one_for_three},
     {1.0 / 3.0, 1.0 / 3.0, RivalKind::one_for_three},
     {1.0 / 3.0, 2.0 / 3.0, RivalKind::one_for_three}}};

/// Pulse number 0 is the one that is followed, then come its rivals.
[[nodiscard]] RivalPulse pulse_at(std::size_t number) noexcept;

/// A pulse as seen from beat number 0 of the followed one: which number it has as seen from beat
/// `beat`. What is half as fast, say, falls on every other beat.
[[nodiscard]] std::size_t place_at(std::size_t pulse, long beat) noexcept;

}  // namespace raks::audio
