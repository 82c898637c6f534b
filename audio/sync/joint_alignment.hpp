#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "audio/sync/track_alignment.hpp"

namespace raks::audio {

/// The clock of one of several recorders against the common one.
struct JointClock {
    ClockLine line;            ///< from the track's clock to the reference's
    double confidence = 0.0;   ///< [0, 1]: the least on the way to the reference
    std::size_t through = 0;   ///< the track that it is aligned with; the reference with itself
    std::size_t used = 0;      ///< windows, as TrackAlignment
    std::size_t compared = 0;  ///< windows, as TrackAlignment
    /// Largest difference from what another pair of tracks gives in the middle of the shorter one,
    /// seconds; 0 where no other pair tells. Beyond some 5 ms a person should look.
    double disagreement = 0.0;
    bool hears_song = false;  ///< its pair with the song could be aligned
};

/// How several tracks are aligned.
struct JointOptions {
    /// Whose clock is the common one; none: that of the first track, but the song, of the largest
    /// group of tracks that can be aligned.
    std::optional<std::size_t> reference{};
    std::optional<std::size_t> song{};  ///< index of the track that is a song, if one is
    /// As of align_tracks, for each pair but those with the song.
    double most_offset = std::numeric_limits<double>::infinity();
    int threads = 1;  ///< does not change the result
};

/// All of them.
struct JointAlignment {
    std::size_t reference = 0;                 ///< whose clock is the common one
    std::vector<Expected<JointClock>> clocks;  ///< by track; errors: why it does not join
};

/// Aligns several recordings of the same sound. Every pair is tried (align_tracks), and each track
/// joins the common clock by its surest way to the reference: not every camera needs to hear the
/// same as the reference. A song as it came to the loudspeaker may be one of the tracks: it joins
/// cameras well, as it has no room of its own, and its clock tells when the song began.
///
/// `tracks`: at least one. `progress`, when given, is called with the pairs done and all, from any
/// thread but from one at a time; once it returns false no further pair is tried, and tracks may
/// stay apart. Threads: any. Real-time: no.
[[nodiscard]] JointAlignment align_jointly(
    std::span<const SyncTrack> tracks,
    const JointOptions& options,
    const std::function<bool(std::size_t, std::size_t)>& progress = {});

inline constexpr double kSpeedOfSound = 343.0;  ///< m/s, in air of 20 degrees Celsius

/// Corrects clocks by the way of the sound: `distances`, one a track, from the loudspeaker to the
/// microphone in metres, 0 for the song itself. A clock changes only where both its distance and
/// the reference's are known; without that the error is 2.9 ms for each metre of difference.
void correct_sound_way(JointAlignment& alignment, std::span<const std::optional<double>> distances);

}  // namespace raks::audio
