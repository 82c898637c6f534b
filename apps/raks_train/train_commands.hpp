#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/clips/body_arguments.hpp"
#include "apps/clips/joint_arguments.hpp"
#include "apps/raks_train/genre_options.hpp"
#include "apps/terminal/program.hpp"
#include "audio/music/styles/style_book.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_network.hpp"
#include "training/figures/training_plan.hpp"

/// The commands of the program `raks-train`, which `raks train` starts, one function each. Threads:
/// main.
namespace raks::apps {

/// Labelled motion to learn from: what the two commands on figures have in common.
struct LabelledClips {
    std::vector<Path> clips;      ///< motion files, or one folder of them
    Path labels;                  ///< TSV
    Path counts;                  ///< TSV; empty: counts lie evenly between a label's start and end
    Path faults;                  ///< TSV of capture faults; empty: none
    std::string split;            ///< of the labels' splits, the one to use; empty: all labels
    double min_confidence = 0.9;  ///< [0, 1]; labels below it are not used
    double fps = 0.0;             ///< frames a second where the file is wrong; 0: the file's
    Path skeleton;                ///< .asf of the clips that are .amc; empty: looked for
    JointArguments joints;        ///< which joint of the clips is which bone
};

inline constexpr int kLongestPhrase = 1024;  ///< beats that --beats may say with --once

/// Arguments of `raks train figure`.
struct TrainFigureArguments : LabelledClips {
    Path music;             ///< danced to: its beats are the counts; empty: none
    double offset = 0.0;    ///< seconds of the music at a clip's first frame
    std::string figure;     ///< empty: "basic", of a written dance all
    std::string dance;      ///< empty: what `output` names, else the first of the list
    std::string extends;    ///< the dance that the figure joins; empty: none
    int beats_per_bar = 4;  ///< of the music of a dance that is new
    motion::DanceRole role = motion::DanceRole::lead;  ///< whose motion in the clips
    /// What of the joints is learnt.
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    BodyArguments body;  ///< how bodies lie in the clips' files
    int states = 0;      ///< 0: 16, of a written dance as many as its figures need
    int iterations = 0;  ///< of Baum-Welch
    motion::CovarianceKind covariance = motion::CovarianceKind::tied;  ///< of the states' Gaussians
    /// Where the states lie before Baum-Welch.
    motion::StatesStart start = motion::StatesStart::flat;
    Path propose;       ///< .tsv that the repeats found are written to; empty: learnt at once
    int beats = 0;      ///< of one repeat, or of a phrase, in clips without labels; 0: found
    bool once = false;  ///< learns each clip as one phrase
    double bpm = 0.0;   ///< of such phrases; 0: found
    motion::ClipTravel travel = motion::ClipTravel::file;  ///< how much of the clips' way is kept
    std::string source;  ///< "cmu": the model carries CMU's acknowledgement
    std::string output;  ///< X.json, a folder, or the name of a dance; empty: the dance's name
};
/// Learns a figure from clips, or passes a written dance (one .toml as clips) on to train_authored.
[[nodiscard]] ExitCode train_figure(const TrainFigureArguments& arguments);
/// Learns the figures of a written dance.
[[nodiscard]] ExitCode train_authored(const TrainFigureArguments& arguments);

/// Arguments of `raks train take`.
struct TrainTakeArguments {
    std::vector<Path> clips;           ///< motion files, or a folder of them
    Path counts;                       ///< .tsv: take, time, half, used
    std::vector<std::string> without;  ///< takes of the table that are left out
    bool lays_arms = false;            ///< over a robot's home pose, in place of leaving it out
    std::string dance;                 ///< its name, where `output` is a folder
    std::string licence;               ///< of the takes, and who made them
    BodyArguments body;                ///< how bodies lie in the clips' files
    std::string output;                ///< a folder, or the name of a dance
    Path propose;                  ///< .tsv that proposed beats are written to; empty: it is learnt
    Path music;                    ///< that the takes were danced to; empty: none
    std::optional<double> offset;  ///< seconds of it at a clip's first frame; none: found
};
/// Learns a dance of cells from whole takes.
[[nodiscard]] ExitCode train_take(const TrainTakeArguments& arguments);

/// Arguments of `raks train report`.
struct TrainReportArguments : LabelledClips {
    /// Uses labels of lower confidence than training does: it only judges.
    TrainReportArguments() { min_confidence = 0.7; }

    /// What of the joints is learnt.
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    std::vector<std::string> figures = {"basic"};  ///< two or more are also told apart
    std::string dance;                             ///< empty: the first of the list
    std::string role = "lead";                     ///< lead, follow or both
    std::string test_split;        ///< to tell figures apart in; empty: only with takes left out
    double test_confidence = 0.6;  ///< the min_confidence of test_split
    std::vector<double> scales;    ///< metres per unit, the follow's last; empty: guessed
    int most_states = 19;          ///< numbers of states are tried from 2 to this
    int states = 14;               ///< of the models that tell figures apart
    int iterations = 6;            ///< of Baum-Welch
    int threads = 0;               ///< 0: all cores
    Path output;                   ///< .html
};
/// Writes a page about how figures were learnt: how many states they need, what the states mean,
/// and how well the models tell figures apart.
[[nodiscard]] ExitCode train_report(const TrainReportArguments& arguments);

/// The dance of cells that a report is asked of: X.cells, or a folder of dances that has one, where
/// there are no labels; empty: none.
[[nodiscard]] Path cell_dance_of(const TrainReportArguments& arguments);
/// Writes a page about a dance of cells, and prints in some lines how it hangs together.
[[nodiscard]] ExitCode report_cells(const Path& file, const Path& output);

/// The part of the plan that both commands take from the clips' arguments; the rest is their own.
/// Errors: those of --joint and --joints.
[[nodiscard]] Expected<motion::FigureTrainingPlan> plan_of(const LabelledClips& clips);
/// The files that are read, none of which may be written over.
[[nodiscard]] std::vector<Path> inputs_of(const LabelledClips& clips);

/// Arguments of `raks train beats`.
struct TrainBeatsArguments {
    audio::StyleBook styles;  ///< that the corpus is written in
    audio::CorpusPlan corpus;
    std::filesystem::path corpus_file;  ///< where the rendered corpus is kept; empty: nowhere
    std::vector<std::filesystem::path> more_files;  ///< further corpora that were kept
    std::vector<std::string> left_out;              // families of music
    std::filesystem::path start;                    // network to go on from
    std::vector<std::filesystem::path> averaged;    // networks whose weights' mean is taken
    std::vector<std::filesystem::path> ensembled;   // networks whose outputs are averaged
    float trust = 1.0F;          // factor on that average before the sigmoid; below 1: less sure
    audio::NetworkPlan network;  ///< how the network is trained
    int bar_steps = 0;           // 0: learns beats
    int pulse_steps = 0;         // likewise
    std::vector<std::filesystem::path> judged;  ///< annotated music to learn confidence from
    std::filesystem::path output;
    std::filesystem::path music_folder;  ///< for --write
};

/// Learns the networks of beats and bars, or makes one of several. `command`: the command line,
/// which is stored in what it makes. Errors: no music; files.
[[nodiscard]] ExitCode train_beats(TrainBeatsArguments arguments, const std::string& command);

/// Learns to tell dances apart from music. `command`: as of train_beats. Errors: options that do
/// not go together; no music; files.
[[nodiscard]] ExitCode train_genre(GenreOptions options, const std::string& command);

}  // namespace raks::apps
