#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// One figure as it is danced by one skeleton: poses over one repeat, closed (the pose after the
/// last is the first), with planted feet. Immutable once made.
class FigureCycle {
 public:
    /// Solves the trajectories, carries them over to `skeleton`, plants the feet. The figure's net
    /// displacement and turn are spread over it, so that a repeat ends where it began.
    /// Threads: workers. Real-time: no (some ms).
    FigureCycle(const FigureModel& model, const Skeleton& skeleton);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] int beats() const noexcept { return beats_; }
    [[nodiscard]] Bpm learnt_tempo() const noexcept { return learnt_tempo_; }

    /// The pose at a phase in beats from count 1 (any number: it wraps).
    /// Threads: any. Real-time: yes.
    [[nodiscard]] Pose at(Beats phase) const noexcept;

 private:
    std::string name_;
    int beats_ = 8;
    Bpm learnt_tempo_{120.0};
    std::vector<Pose> poses_;
};

}  // namespace raks::motion
