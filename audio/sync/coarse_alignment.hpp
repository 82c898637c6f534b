#pragma once

#include <span>
#include <vector>

#include "audio/sync/clock_line.hpp"

namespace raks::audio {

/// How one track may lie against another, to a few milliseconds.
struct CoarseAlignment {
    ClockLine line;      ///< from the part's clock to the whole's
    double score = 0.0;  ///< sum of the heights of all peaks that agree, in standard deviations
};

/// Searches a whole track for another one: chunks of 10 s of `part`, spread over it, against all of
/// `whole` (PhaseCorrelator, 150 to 1,500 Hz), for drifts of up to 1,300 ppm. Best first, at most
/// four: music that repeats itself to the sample lies well in more than one place.
/// `part` and `whole`: at SyncTrack::kCoarseRate, at least SyncTrack::kWindow long; the part is not
/// longer. Memory beside them: 10 MB, for any length. Threads: any. Real-time: no.
[[nodiscard]] std::vector<CoarseAlignment> find_coarse_alignments(std::span<const float> part,
                                                                  std::span<const float> whole);

}  // namespace raks::audio
