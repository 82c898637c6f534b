#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "audio/music/generator/dsp.hpp"
#include "audio/music/generator/form_score.hpp"
#include "audio/music/generator/tempo_curve.hpp"

namespace raks::audio {

/// Level and low-pass of the whole mix over the sections of a form. One piece, in order, once.
/// Threads: one.
class FormSound {
 public:
    /// `curve`: times of the sections' beats; `rate`: hertz.
    FormSound(std::span<const SectionSpan> form, const TempoCurve& curve, double rate);

    /// Sound begins at this frame: nothing of what was before it is left.
    void begin(std::int64_t frame);
    /// Changes both sides of the frames from `from` on; they have the same length.
    void process(std::int64_t from, std::span<float> left, std::span<float> right);

 private:
    /// A section in frames; gain and cut-off go evenly (the cut-off in octaves) from its first
    /// frame to its last.
    struct Stretch {
        std::int64_t from = 0;
        std::int64_t to = 0;
        double gain_from = 1.0;
        double gain_to = 1.0;
        double hertz_from = 0.0;  ///< 0: no low-pass
        double hertz_to = 0.0;
    };
    void set_goals(std::int64_t frame);

    std::vector<Stretch> stretches_;
    std::size_t at_ = 0;  // stretch of the current frame
    double rate_;
    double glide_;  // share of the way to a goal that is made in one frame
    double goal_gain_ = 1.0;
    double goal_wet_ = 0.0;
    double gain_ = 1.0;
    double wet_ = 0.0;  // share of the low-passed sound
    StateVariableFilter left_low_;
    StateVariableFilter right_low_;
};

}  // namespace raks::audio
