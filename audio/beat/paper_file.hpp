#pragma once

#include <vector>

#include "audio/beat/paper_beat.hpp"
#include "audio/features/rhythm_frames.hpp"

namespace raks::audio {

/// The paper's method over a whole file (paper_beats), fed with samples of any supported rate.
/// Threads: one. Real-time: no (it keeps 8 bytes a hop of the file).
class PaperFile {
 public:
    /// Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// The next samples, mono, finite, in [-1, 1].
    void add(std::span<const float> mono);
    /// Beats of the file, whose length is `duration`. Once, at the end.
    [[nodiscard]] std::vector<BeatEvent> finish(Nanos duration);

 private:
    RhythmFrames windows_;
    PaperFlux flux_;
    std::vector<PaperFlux::Frame> frames_;
};

}  // namespace raks::audio
