// Take figure: a take as the mannequin shows it.
#pragma once

#include <vector>

#include "motion/skeleton/pose.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::apps {

/// A take on the mannequin: as large as it, on the whole facing us, its way about the middle of the
/// stage. Immutable. Threads: any. Real-time: no.
class TakeFigure {
 public:
    /// The clip has poses.
    explicit TakeFigure(const motion::TrainingClip& clip);

    /// How it stands at a moment, seconds; held before the first frame and behind the last.
    [[nodiscard]] motion::Pose at(double seconds) const;
    /// From the first frame to the last.
    [[nodiscard]] double seconds() const noexcept;

 private:
    std::vector<motion::Pose> poses_;
    double frames_per_second_;
};

}  // namespace raks::apps
