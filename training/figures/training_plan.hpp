#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/music_counts.hpp"

/// From files to a learnt figure: what `raks train figure` does.
namespace raks::motion {

struct FigureTrainingPlan {
    std::vector<std::filesystem::path> clips;  ///< BVH; or one folder: all its *.bvh
    std::filesystem::path labels;
    /// Moments of the counts; none: they lie evenly between a label's start and end.
    std::optional<std::filesystem::path> counts;
    /// Counts from its beats instead; labels then need not say how many beats they have.
    std::optional<DancedMusic> music;
    std::optional<std::filesystem::path> faults;

    std::string figure = "basic";
    std::string dance;  ///< that the model says it is of
    DanceRole role = DanceRole::lead;
    FigureFeatures features = FigureFeatures::angles;
    std::string split;  ///< only labels of this split; empty: all
    /// Only labels at least so sure. (Averaging over doubtful repeats shrinks the dance: measured
    /// 1.9 m/s of peak toe speed over all >= 0.6, 2.4 over >= 0.95, 2.8 in single repeats.)
    double min_confidence = 0.9;

    std::optional<double> frames_per_second;  ///< instead of the file's
    std::optional<double> metres_per_unit;    ///< none: guessed from the body's height
    std::string attribution;
    int states = 16;
    int baum_welch_iterations = 0;
    CovarianceKind covariance = CovarianceKind::tied;
    StatesStart start = StatesStart::flat;
};

/// Which labels were used, and which were not and why.
struct RepeatUse {
    FigureLabel label;
    std::string left_out;  ///< why; empty: used
};

struct FigureTrainingReport {
    FigureModel model;
    std::array<double, 3> log_likelihood{};  ///< per sample, of the training repeats, by Part
    std::vector<RepeatUse> repeats;          ///< of the figure, role and split
    std::vector<std::string> warnings;
};

/// The motion and repeats that a plan names, ready to be learnt from.
struct TrainingMaterial {
    std::vector<TrainingClip> clips;
    std::vector<FigureRepeat> repeats;  ///< weight: the label's confidence
    std::vector<RepeatUse> uses;
    std::vector<std::string> warnings;
};

/// Reads only the clips that labels of the figure, role, split and confidence need. Repeats that
/// touch a fault of more than half a second (of other joints than head and hands) are left out;
/// shorter faults are bridged. Errors: of the readers; a labelled clip that is not among `clips`;
/// a label beyond the end of its clip, or that the music has no beats for; nothing left to learn
/// from.
[[nodiscard]] Expected<TrainingMaterial> load_material(const FigureTrainingPlan& plan);

/// Does it all. Deterministic: the same files and plan give the same bits.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureTrainingReport> train_figure(const FigureTrainingPlan& plan);

/// "The data used in this project was obtained from mocap.cs.cmu.edu...": what models learnt from
/// CMU clips must carry.
[[nodiscard]] std::string_view cmu_attribution() noexcept;

}  // namespace raks::motion
