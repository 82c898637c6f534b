#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/terminal/exit_code.hpp"
#include "engine/setup/settings.hpp"
#include "motion/figures/figure_model.hpp"

/// The commands of the program `raks`. Each takes its arguments, checked for form only, and does
/// its work.
namespace raks::apps {

/// A stretch of a file, in seconds.
struct Section {
    double start = 0.0;              ///< >= 0
    std::optional<double> duration;  ///< > 0; to the end when absent
};

struct PlayArguments {
    engine::Settings settings;
    std::vector<Path> files;  ///< files and folders; empty: the demo salsa
    Section section;
    bool is_headless = false;   ///< no window
    bool is_soundless = false;  ///< no loudspeaker; paced by the clock
    bool is_fullscreen = false;
};
[[nodiscard]] ExitCode play(const PlayArguments& arguments);

struct LiveArguments {
    engine::Settings settings;
    std::optional<double> duration;  ///< seconds to listen; until stopped when absent
    bool is_headless = false;
    bool is_fullscreen = false;
};
[[nodiscard]] ExitCode live(const LiveArguments& arguments);

struct DevicesArguments {
    bool as_json = false;
    bool asks_for_output = false;  ///< only the exit code: is there a loudspeaker?
};
[[nodiscard]] ExitCode devices(const DevicesArguments& arguments);

struct RenderArguments {
    engine::Settings settings;
    Path input;   ///< empty: the demo salsa
    Path output;  ///< .mp4, .avi, or a folder for .png
    Section section;
};
[[nodiscard]] ExitCode render(const RenderArguments& arguments);

/// The trackers of audio::BeatMethod, and the paper's method with the whole file before it.
enum class FileBeatMethod : std::uint8_t { pointer, paper, paper_whole };

struct AnalyzeArguments {
    Path input;
    bool as_json = false;
    FileBeatMethod beat = FileBeatMethod::pointer;
    Path plot;       ///< .svg; empty: none
    Path reference;  ///< beats to compare with in the plot; empty: none
};
[[nodiscard]] ExitCode analyze(const AnalyzeArguments& arguments);

struct EvalBeatsArguments {
    Path corpus;  ///< folder: index.tsv, NAME.beats, NAME.ogg
    std::vector<FileBeatMethod> methods = {FileBeatMethod::pointer};
    std::vector<Path> peers;  ///< folders of other trackers' beats, or folders of such
    Path network;             ///< for the pointer; empty: what comes with Raks; "none": none
    Path left_out;            ///< folder of CLASS.json, networks that never heard that class
    std::string category;     ///< only excerpts of this class; empty: all
    Path output;              ///< folder for what was heard; empty: not written
    bool as_json = false;
    bool asks_for_each = false;  ///< a row for each excerpt
};
/// Scores our trackers, and others', against annotated excerpts.
[[nodiscard]] ExitCode eval_beats(const EvalBeatsArguments& arguments);

struct EvalDanceArguments {
    engine::Settings settings;
    motion::DanceRole role = motion::DanceRole::lead;
    std::vector<std::string> trials;  ///< by name; empty: all
    Path clips;                       ///< folder of people's clips, TAKE.bvh; empty: none
    Path labels;                      ///< TSV; needed with clips
    Path counts;                      ///< TSV; empty: counts lie evenly in a label, no BAS
    Path faults;                      ///< TSV of capture faults; empty: none
    double fps = 0.0;                 ///< of the clips; 0: the files'
    double scale = 1.0;               ///< metres per unit of the clips
    bool as_json = false;
};
/// Measures the dancer, from generated music to poses, beside people's clips.
[[nodiscard]] ExitCode eval_dance(const EvalDanceArguments& arguments);

struct DanceArguments {
    engine::Settings settings;
    Path input;
    Path output;        ///< x.bvh; of several dancers x_1.bvh, x_2.bvh, ...
    double fps = 60.0;  ///< [1, 240]
};
[[nodiscard]] ExitCode dance(const DanceArguments& arguments);

struct EvalGenreArguments {
    Path folder;
    Path groups;               ///< table of its clips; empty: one folder a genre
    Path model;                ///< .json; empty: the one that comes with Raks
    std::string labels;        ///< only clips whose label is one of these letters; empty: all
    bool with_damage = false;  ///< also quieter, low-passed, with noise, in a room
    bool as_json = false;
    int threads = 2;
};
/// How well a model tells dances apart on a folder of music, by each kind of evidence.
[[nodiscard]] ExitCode eval_genre(const EvalGenreArguments& arguments);

struct DancesArguments {
    bool as_json = false;
};
/// Lists all dances with their figures, where each lies, and why one that is broken is left out.
[[nodiscard]] ExitCode dances(const DancesArguments& arguments);

struct SheetArguments {
    engine::Settings settings;
    Path output;         ///< .png: a sheet; else a film
    std::string figure;  ///< of the dance; empty: its first
    double bpm = 180.0;  ///< [50, 230]
};
/// A figure from the front and the side: every 1/8 beat of 8 on a sheet, or a film of 16 beats.
[[nodiscard]] ExitCode sheet(const SheetArguments& arguments);

struct StickArguments {
    engine::Settings settings;
    Path input;                        ///< .bvh, or a written dance (.toml)
    Path output;                       ///< .png: front and side views; empty: a window
    std::string figure;                ///< of a written dance; empty: all
    double bpm = 0.0;                  ///< to dance it at; 0: as it is written
    double fps = 0.0;                  ///< frames a second of the clip; 0: the file's
    double scale = 0.0;                ///< metres per unit; 0: guessed
    std::optional<std::size_t> frame;  ///< to stand at, or to draw alone
};
/// Plays a motion clip's own skeleton as a stick figure; without a display draws a sheet.
[[nodiscard]] ExitCode stick(const StickArguments& arguments);
/// The same of a written dance, on the mannequin.
[[nodiscard]] ExitCode stick_dance(const StickArguments& arguments);

struct SynthArguments {
    std::string style;    ///< of the generator, or a dance; empty: the first dance's
    Path output;          ///< .wav
    double bpm = 180.0;   ///< [50, 230]
    double seconds = 60;  ///< (0, 3600]
    std::int64_t seed = 1;
};
/// Writes music of our own generator.
[[nodiscard]] ExitCode synth(const SynthArguments& arguments);

struct BenchArguments {
    std::string what;  ///< latency, analysis, motion, render or train
    bool as_json = false;
    double seconds = 20.0;
};
[[nodiscard]] ExitCode bench(const BenchArguments& arguments);

struct ConfigArguments {
    std::string action = "show";  ///< show, path or init
};
[[nodiscard]] ExitCode config(const ConfigArguments& arguments);

}  // namespace raks::apps
