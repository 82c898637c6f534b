#pragma once

#include <span>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/trials/block_clock.hpp"
#include "engine/trials/loop_recorder.hpp"

/// How much later a device is heard than it reports: clicks are played, and their way back through
/// a loop (an input that hears them) or a person's taps are compared with when they should have
/// been heard. Threads: any. Real-time: no.
namespace raks::engine {

/// Clicks: where each begins, in seconds, and how long it lasts until the last one has faded.
struct ClickTrain {
    std::vector<double> clicks;  ///< ascending; from 2.5 s on, as a device may need time to start
    double seconds = 0.0;        ///< of the whole
};
/// For a loop: at irregular distances of 0.3 to 0.6 s, so that a long way back is told from a click
/// before.
[[nodiscard]] ClickTrain irregular_clicks(int count);
/// For a person: at equal distances, in seconds.
[[nodiscard]] ClickTrain regular_clicks(int count, double distance);

/// One click: a rising tone of 12 ms, 1 to 6 kHz, which loudspeakers and microphones of all kinds
/// pass on.
[[nodiscard]] std::vector<float> click_sound(SampleRate rate);
/// The whole train, one channel.
[[nodiscard]] std::vector<float> sound_of(const ClickTrain& train, SampleRate rate);

/// A median of many.
struct MeasuredOffset {
    Nanos offset{};     ///< heard later than reported; negative: earlier
    Nanos quartiles{};  ///< distance of the quartiles
    int count = 0;      ///< how many clicks or taps it is the median of
};

/// From a loop. `sent`: the clock of the output that played `train` from frame 0 on. Offsets from
/// -0.1 to 2.1 s are found. Errors: fewer than half of the clicks came back; they came back at
/// times that lie over 20 ms apart.
[[nodiscard]] Expected<MeasuredOffset> loop_offset(const ClickTrain& train,
                                                   const BlockClock& sent,
                                                   const LoopRecording& heard);

/// Taps that a person needs to make.
constexpr int kTaps = 16;
/// From taps: of each the distance to the click next to it. `clicks`: when each should have been
/// heard, ascending. Offsets up to half of the clicks' distance are found. Errors: fewer than kTaps
/// taps fell on clicks; their quartiles lie over 60 ms apart.
[[nodiscard]] Expected<MeasuredOffset> tap_offset(std::span<const HostTime> clicks,
                                                  std::span<const HostTime> taps);

}  // namespace raks::engine
