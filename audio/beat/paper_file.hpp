#pragma once

#include <vector>

#include "audio/beat/paper_beat.hpp"
#include "audio/features/rhythm_frames.hpp"

namespace raks::audio {

/// The paper's whole-file form (paper_beats), fed with samples of any supported rate.
/// Threads: one. Real-time: no (it keeps 8 bytes for each hop of the file).
class PaperFile {
 public:
    /// Starts a file. Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// The next samples, mono, finite, in [-1, 1].
    void add(std::span<const float> mono);
    /// Beats of the file, whose length is `duration`. To be called once, after all samples.
    [[nodiscard]] std::vector<BeatEvent> finish(Nanos duration);

 private:
    RhythmFrames windows_;
    PaperFlux flux_;
    std::vector<PaperFlux::Frame> frames_;
};

}  // namespace raks::audio
