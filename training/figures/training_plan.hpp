#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/label_tables.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/label_counts.hpp"
#include "training/figures/training_clip.hpp"

/// From files to a learnt figure: the work of `raks train figure`.
namespace raks::motion {

/// Which files, which labels and how to learn from them.
struct FigureTrainingPlan {
    std::vector<std::filesystem::path> clips;  ///< or one folder: all clips in it
    std::filesystem::path labels;              ///< table of labelled repetitions (label_tables.hpp)
    std::vector<FigureLabel> found;  ///< labels that no table holds; used without `labels`
    /// Table of counts; none: counts lie evenly between a label's start and end.
    std::optional<std::filesystem::path> counts;
    /// Takes counts from these beats instead; labels then need not give a number of beats.
    std::optional<DancedMusic> music;
    std::optional<std::filesystem::path> faults;  ///< table of capture faults

    std::string figure = "basic";      ///< only labels of this figure
    std::string dance;                 ///< name of the dance, written into the model; needed
    DanceRole role = DanceRole::lead;  ///< only labels of this role
    FigureFeatures features = FigureFeatures::angles;  ///< joint angles, or joint positions
    std::string split;                                 ///< only labels of this split; empty: all
    /// Only labels of at least this confidence. (Averaging over doubtful repeats shrinks the dance:
    /// measured 1.9 m/s of peak toe speed over all >= 0.6, 2.4 over >= 0.95, 2.8 in single
    /// repeats.)
    double min_confidence = 0.9;

    MotionReadOptions reading;                         ///< of the clips; with another rate
    std::optional<double> metres_per_unit;             ///< none: found from the body's size
    std::optional<double> height{};                    ///< of the body, metres; none: found
    std::optional<glm::dvec3> up{};                    ///< axis that points up; none: found
    JointLabels joints{};                              ///< which joint of the clips is which bone
    ClipTravel travel = ClipTravel::file;              ///< whether the clips lead anywhere
    std::string attribution;                           ///< credit that the data's licence asks for
    int states = 16;                                   ///< of each part's HMM
    int baum_welch_iterations = 0;                     ///< rounds; see FigureTrainingOptions
    CovarianceKind covariance = CovarianceKind::tied;  ///< one for all states, or one each
    StatesStart start = StatesStart::flat;             ///< where the states lie before Baum-Welch
};

/// One label of the figure, and why it was not used, if it was not.
struct RepeatUse {
    FigureLabel label;     ///< the table's row
    std::string left_out;  ///< why; empty: used
};

/// The learnt figure and what it was learnt from.
struct FigureTrainingReport {
    FigureModel model;                       ///< passes validate()
    std::array<double, 3> log_likelihood{};  ///< per sample, of the training repeats, by Part
    std::vector<RepeatUse> repeats;          ///< all labels of the figure, role and split
    std::vector<std::string> warnings;       ///< for people, one line each
};

/// How the clips of a plan are read.
[[nodiscard]] ClipUnits units_of(const FigureTrainingPlan& plan);

/// The clips of a plan by take: the files named, or all clips of one folder. A later file of the
/// same name replaces an earlier one. Errors: none named, a folder without clips, or one that
/// cannot be read.
[[nodiscard]] Expected<std::map<std::string, std::filesystem::path>> clips_by_take(
    const FigureTrainingPlan& plan);

/// Training data of a plan: its motion and repeats.
struct TrainingMaterial {
    std::vector<TrainingClip> clips;    ///< only those that labels need
    std::vector<FigureRepeat> repeats;  ///< weight: the label's confidence
    std::vector<RepeatUse> uses;        ///< all labels of the figure, role and split
    std::vector<std::string> warnings;  ///< for people, one line each
};

/// Reads only the clips that labels of the figure, role, split and confidence need. Repeats that
/// touch a fault of more than half a second (of other joints than head and hands) are left out;
/// shorter faults are bridged. Errors: of the readers; a labelled clip that is not among `clips`;
/// a label beyond the end of its clip, or that the music has no beats for; nothing left to train
/// on.
[[nodiscard]] Expected<TrainingMaterial> load_material(const FigureTrainingPlan& plan);

/// Loads the material, keeps the repeats with the commonest turn and trains the figure.
/// Deterministic: the same files and plan give the same bits. Errors: those of load_material and of
/// train_figure in figure_trainer.hpp.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureTrainingReport> train_figure(const FigureTrainingPlan& plan);

/// The credit that models learnt from CMU clips must carry.
[[nodiscard]] std::string_view cmu_attribution() noexcept;

}  // namespace raks::motion
