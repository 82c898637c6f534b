#pragma once

#include <string>
#include <vector>

#include "apps/terminal/command_table.hpp"
#include "training/figures/training_plan.hpp"

/// The commands of the program `raks-train`, that `raks train` starts.
namespace raks::apps {

/// Labelled motion to learn from.
struct LabelledClips {
    std::vector<Path> clips;  ///< BVH files, or one folder of them
    Path labels;              ///< TSV
    Path counts;              ///< TSV; empty: counts lie evenly between a label's start and end
    Path faults;              ///< TSV of capture faults; empty: none
    std::string split;        ///< empty: all labels
    double min_confidence = 0.9;
    double fps = 0.0;  ///< 0: the file's
};

struct TrainFigureArguments : LabelledClips {
    Path music;             ///< danced to: its beats are the counts; empty: none
    double offset = 0.0;    ///< seconds of the music at a clip's first frame
    std::string figure;     ///< empty: "basic", of a written dance all
    std::string dance;      ///< empty: what `output` names, else the first of the list
    std::string extends;    ///< the dance that the figure joins; empty: none
    int beats_per_bar = 4;  ///< of the music of a dance that is new
    motion::DanceRole role = motion::DanceRole::lead;
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    double scale = 0.0;  ///< metres per unit; 0: guessed
    int states = 0;      ///< 0: 16, of a written dance as many as its figures need
    int iterations = 0;
    motion::CovarianceKind covariance = motion::CovarianceKind::tied;
    motion::StatesStart start = motion::StatesStart::flat;
    std::string source;  ///< "cmu": the model carries CMU's acknowledgement
    std::string output;  ///< X.json, a folder, or the name of a dance; empty: the dance's name
};
/// Learns from clips, or from a written dance (one .toml in place of the clips).
[[nodiscard]] ExitCode train_figure(const TrainFigureArguments& arguments);
[[nodiscard]] ExitCode train_authored(const TrainFigureArguments& arguments);

struct TrainReportArguments : LabelledClips {
    TrainReportArguments() { min_confidence = 0.7; }

    motion::FigureFeatures features = motion::FigureFeatures::angles;
    std::vector<std::string> figures = {"basic"};  ///< two or more are also told apart
    std::string dance;                             ///< empty: the first of the list
    std::string role = "lead";                     ///< lead, follow or both
    std::string test_split;  ///< to tell figures apart in; empty: only with takes left out
    double test_confidence = 0.6;
    std::vector<double> scales;  ///< metres per unit, the follow's last; empty: guessed
    int most_states = 19;
    int states = 14;     ///< of the models that tell figures apart
    int iterations = 6;  ///< of Baum-Welch
    int threads = 0;     ///< 0: all cores
    Path output;         ///< .html
};
/// Writes a page about how figures were learnt: how many states they need, what the states mean,
/// and how well figures are told apart by them.
[[nodiscard]] ExitCode train_report(const TrainReportArguments& arguments);

/// What both training commands ask of these clips; the rest of the plan is theirs.
[[nodiscard]] motion::FigureTrainingPlan plan_of(const LabelledClips& clips);
/// The files that they are read from.
[[nodiscard]] std::vector<Path> inputs_of(const LabelledClips& clips);

/// The options of each command. `command`: the command line as it is kept in what it makes.
void add_train_figure(CommandTable& table);
void add_train_report(CommandTable& table);
void add_train_beats(CommandTable& table, const std::string& command);
void add_train_genre(CommandTable& table, const std::string& command);

}  // namespace raks::apps
