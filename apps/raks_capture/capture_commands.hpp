#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "apps/clips/body_arguments.hpp"
#include "apps/raks_capture/calibration_choices.hpp"
#include "apps/raks_capture/taken_keypoints.hpp"
#include "apps/terminal/program.hpp"
#include "motion/capture/studio/point_studio.hpp"

/// The commands of the program `raks-capture`, one function each. Arguments are checked for their
/// form only; the command checks the rest and does the work. Threads: main.
namespace raks::apps {

/// Arguments of `raks capture run`.
struct RunArguments {
    Path folder;
    bool is_markerless = false;  ///< whatever capture.toml says
    double height = 0.0;         ///< metres, where a capture.toml is written; 0: not said
    Path music;                  ///< likewise; empty: none
};
/// Does every step that is missing or older than what it is made from. Without markers a folder of
/// films needs no capture.toml: one is written. Errors: those of the steps.
[[nodiscard]] ExitCode run_capture(const RunArguments& arguments);

/// Arguments of `raks capture simulate`.
struct SimulateArguments {
    Path motion;
    Path output;
    Path rig;      ///< empty: the studio's
    Path markers;  ///< empty: the shipped set
    bool points = false;
    bool is_draft = false;        ///< of the films
    bool is_rig_known = false;    ///< no calibration films
    bool has_no_board = false;    ///< neither calibration films nor a rig
    bool has_no_markers = false;  ///< films of a dancer in plain clothes
    Path music;                   ///< that sounds in the room; empty: none
    bool unique = false;          ///< each marker has a colour of its own
    int cameras = 6;              ///< of the studio's rig
    double camera_angle = 0.0;    ///< degrees between neighbours of it; 0: evenly around
    double fps = 0.0;             ///< of the motion; 0: the file's
    /// Pictures a second: "30" of all cameras, "cam2=24" of one; empty: the motion's.
    std::vector<std::string> rates;
    std::vector<std::string> bumps;  ///< "cam2=12.5": when a camera is bumped; seconds
    double shutter = 0.0;            ///< milliseconds for which a picture gathers light; 0: usual
    double rolling_shutter = 0.0;    ///< milliseconds from a picture's first row to its last
    double light = 1.0;              ///< of the room, as a share of the usual
    double seconds = 0.0;            ///< of the motion to film; 0: all
    double tempo = 1.0;              ///< how much faster than recorded the dance is danced
    capture::StudioOptions studio;
    BodyArguments body;

    [[nodiscard]] bool has_board_films() const { return !points && !is_rig_known && !has_no_board; }
    [[nodiscard]] bool has_sound() const { return !points && !music.empty(); }
};
/// Films a known dance with cameras that there are not. Errors: those of reading and of the
/// folder.
[[nodiscard]] ExitCode simulate(const SimulateArguments& arguments);

/// Arguments of `raks capture board`; lengths in millimetres.
struct BoardArguments {
    Path capture;  ///< folder whose board it is; empty: of the options
    Path output;
    std::string kind = "charuco";
    int columns = 8;
    int rows = 6;
    double square = 80.0;
    double marker = 0.0;  ///< 0: three quarters of a square
    std::string dictionary = "DICT_4X4_1000";
    bool is_inverted = false;
    int pixels = 200;  ///< a square, of a picture
};
/// Draws the board that calibrates the cameras. Errors: a board that cannot be; the file.
[[nodiscard]] ExitCode draw_board(const BoardArguments& arguments);

/// Arguments of `raks capture calibrate`.
struct CalibrationArguments {
    Path folder;
    Path output;  ///< empty: rig.toml of the folder
    CalibrationChoices choices;
    Path rig;                   ///< of another program; empty: the board is looked for
    std::string unit;           ///< of that rig; empty: as it says
    std::string up;             ///< likewise
    bool is_by_dancer = false;  ///< from keypoints, without a board
    double height = 0.0;        ///< of the dancer, metres; 0: capture.toml's
    bool as_json = false;
};
/// Finds lenses and places of the cameras by a board, or by the dancer. Errors: films that show it
/// too seldom; files.
[[nodiscard]] ExitCode calibrate(const CalibrationArguments& arguments);

/// Arguments of `raks capture sync`.
struct SyncArguments {
    std::string folder = {};
    std::string music = {};
    std::string offsets = {};
    /// seconds within which all cameras were started
    double within = std::numeric_limits<double>::infinity();
    bool is_of_boards = false;  ///< the calibration films, not those of the dance
    bool as_json = false;
};
/// Tells the clocks of the films from their sound. Errors: films without it, or of other songs;
/// files.
[[nodiscard]] ExitCode sync_capture(const SyncArguments& arguments);

/// Arguments of `raks capture label`.
struct LabelArguments {
    Path folder;
    Path labels;  ///< empty: in a window
};
/// Says which marker is where in first pictures. Errors: a bad table; no display; files.
[[nodiscard]] ExitCode label_capture(const LabelArguments& arguments);

/// Arguments of `raks capture track`.
struct TrackArguments {
    Path folder;
    Path labels;  ///< empty: labels.tsv of the folder
    Path truth;   ///< folder with tracks.csv; empty: none
    std::string colour = "normalised";
    double sigma = 1.0;
    double acceleration = 20.0;
    double smoothing = 12.0;
    bool is_as_named = false;  ///< the order of the films is not checked
    std::string method;        ///< empty: capture.toml's
    std::string body;          ///< dance, paper or a file; empty: capture.toml's
    std::string likelihood = "reprojection";
    std::string filter = "partitioned";
    int particles = 300;
    int layers = 10;
    bool is_unpolished = false;
    bool is_body_kept = false;  ///< the body is not fitted first
    double body_error = 0.0;    ///< share of each length
    std::uint64_t seed = 1;
    int threads = 0;  ///< 0: as many as there are cores
};
/// Follows the markers through all films. Errors: no rig, no labels; files.
[[nodiscard]] ExitCode track(const TrackArguments& arguments);

/// Arguments of `raks capture keypoints`.
struct KeypointArguments {
    Path folder;
    std::string network = "full";  ///< lite, full or heavy, or a file
    bool is_preview = false;       ///< every third picture, and the network lite
    int threads = 0;               ///< 0: as many as there are cores
    TakenKeypoints taken;          ///< instead of looking at films
};
/// Finds the joints of a dancer without markers in all films. Errors: no film; no network; no film
/// that shows a whole body; files.
[[nodiscard]] ExitCode keypoints(const KeypointArguments& arguments);
/// Says of keypoints that were found before whether a dance can be got from them, as keypoints()
/// does. Errors: no film that shows a whole body; files.
[[nodiscard]] ExitCode judge_kept_keypoints(const std::string& folder);

/// Arguments of `raks capture correct`.
struct CorrectArguments {
    Path folder;
};
/// Shows the tracks in a window, where they are put right. Errors: no tracks; no display; files.
[[nodiscard]] ExitCode correct(const CorrectArguments& arguments);

/// Arguments of `raks capture solve`.
struct SolveArguments {
    Path folder;                     ///< or a file of points
    Path output;                     ///< of such a file's dance; empty: beside it
    std::string unit;                ///< of such a file; empty: as it says
    std::string up;                  ///< likewise
    Path names;                      ///< of its points; empty: as they are
    Path markers;                    ///< that its points are; empty: joints
    double height = 0.0;             ///< metres; 0: capture.toml's
    double frames_per_second = 0.0;  ///< 0: capture.toml's
    std::string body;                ///< dance, paper or a file; empty: capture.toml's
    double smoothness = 1.0;
    bool as_json = false;
};
/// Finds the dancer's body and its dance in the tracks, or in the points of a file. Errors: no
/// tracks; too few markers; files.
[[nodiscard]] ExitCode solve_capture(const SolveArguments& arguments);

/// Arguments of `raks capture report`.
struct ReportArguments {
    Path folder;
    Path truth;   ///< folder with tracks.csv; empty: none
    Path output;  ///< empty: report.html of the folder
};
/// Writes a page of what came of a capture. Errors: nothing was tracked yet; files.
[[nodiscard]] ExitCode report_capture(const ReportArguments& arguments);

/// Arguments of `raks capture compare`.
struct CompareArguments {
    Path one;
    Path other;
    double shift = 0.0;       ///< seconds
    bool is_aligned = false;  ///< turned about the vertical and moved to fit best
    bool as_json = false;
};
/// Prints how far two motions of the same dance are apart. Errors: those of reading them.
[[nodiscard]] ExitCode compare(const CompareArguments& arguments);

/// Runs a command line of this program, its words without the program's name, in this process: what
/// it prints, its signals and its exit code are those of the command itself.
[[nodiscard]] ExitCode run_command_line(std::vector<std::string> words);

}  // namespace raks::apps
