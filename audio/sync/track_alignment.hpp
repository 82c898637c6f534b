#pragma once

#include <cstddef>
#include <limits>

#include "audio/sync/clock_line.hpp"
#include "audio/sync/sync_track.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// How the clock of one recorder runs against that of another, told by what both heard.
///
/// Times are of arrival: a recorder that stands d metres further from the loudspeaker hears
/// everything d / 343 seconds later, and its offset is too small by that; see
/// joint_alignment.hpp, which corrects it where distances are known.
struct TrackAlignment {
    ClockLine line;            ///< from the track's clock to the reference's
    double confidence = 0.0;   ///< [0, 1]; below 0.5 a person should look
    std::size_t used = 0;      ///< windows that lie on the line
    std::size_t heard = 0;     ///< windows in which a peak stood out
    std::size_t compared = 0;  ///< windows that lie within both tracks
    double spread = 0.0;       ///< root mean square distance of the used ones from the line, s
};

/// Drifts beyond this are refused: clocks of recorders differ by some ten parts in a million, so
/// that more is another fault, such as a film at another speed.
inline constexpr double kMostDriftPpm = 500.0;
/// Fewer windows than this do not make a line: 12.5 s that both hear give four.
inline constexpr std::size_t kLeastWindows = 4;

/// Aligns two recordings of the same sound: music, speech, anything but a steady tone. The whole
/// tracks are searched for each other (coarse_alignment.hpp), then windows of 5 s
/// (window_peaks.hpp) are measured and a straight line is drawn through most of them
/// (clock_line.hpp).
///
/// Measured with music in a simulated room (docs/measurements/sound.md): 0.1 ms, 2 ppm where the
/// room's reverberation is as strong as the direct sound. It takes some 0.6 s of CPU for tracks of
/// 40 s, 4 s for five minutes.
///
/// The confidence is the product of: how many of the windows heard agree; how much the alignment
/// stands out from the next best one (full where that has half its score or less); how much the
/// direct sound stands out from echoes in the sum of all windows (full where the strongest has 0.6
/// of its height or less); and 1 - 2^(-used / 4).
///
/// `most_offset`: seconds; offsets beyond it to either side are not considered. With cameras that
/// were started within half a minute, music that repeats itself after longer is no riddle.
///
/// Nothing is guessed. Errors, one line each, with what to do:
/// - no sound that both hear;
/// - fewer than kLeastWindows windows agree;
/// - another alignment is nearly as good, as in music that repeats itself to the sample;
/// - windows contradict each other, as where one of the recordings was cut or lost sound;
/// - an echo is nearly as strong as the direct sound, so that it could be taken for it;
/// - the clocks drift by more than kMostDriftPpm (up to 1,300 ppm are recognized as such).
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<TrackAlignment> align_tracks(
    const SyncTrack& reference,
    const SyncTrack& track,
    double most_offset = std::numeric_limits<double>::infinity());

}  // namespace raks::audio
