// Capture plan: what capture.toml says, and where the files of a capture lie.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/markers/marker_set.hpp"

namespace raks::apps {

/// One camera of a capture. Paths are as the file has them: relative to the capture's folder.
struct PlannedCamera {
    std::string name;
    std::filesystem::path film;         ///< a film or a folder of pictures; empty: points alone
    std::filesystem::path calibration;  ///< the same of the board; empty: none
    /// Where the loudspeaker is from it, metres; 0: not known.
    double loudspeaker = 0.0;
};

/// How markers are followed: each by itself, or by the angles of a whole body.
enum class TrackingMethod { positions, angles };

/// A capture: a folder with this file (TOML), from which each step reads and to which it writes.
///
///     format = "raks-capture"
///     version = 1
///     height = 1.72                 # of the dancer, metres; left out: found from the markers
///     body = "dance"                # or "paper": 22 degrees of freedom; or a file of joints
///     method = "positions"          # or "angles": how markers are followed; left out: by what
///                                   # the cameras can tell apart; or "markerless"
///     music = "song.mp3"            # left out: none
///     markers = "markers.toml"      # left out: the shipped set
///     frames_per_second = 60.0      # of the dance that comes out; left out: 60
///     start = 0.0                   # capture time of its first frame; left out: the earliest
///
///     [board]
///     kind = "charuco"              # or "chessboard"
///     columns = 8
///     rows = 6
///     square = 0.08                 # metres
///     marker = 0.06                 # metres
///     dictionary = "DICT_4X4_1000"
///     inverted = false
///
///     [[camera]]
///     name = "left"
///     film = "left.mp4"
///     calibration = "left_board.mp4"
///     loudspeaker = 3.2             # metres from it
struct CapturePlan {
    std::filesystem::path folder;  ///< that capture.toml lies in
    double height = 0.0;           ///< metres; 0: not said
    /// Which joints move: "dance", "paper", or a file, relative to the folder.
    std::string body = "dance";
    std::optional<TrackingMethod> method{};  ///< none: by what the cameras can tell apart
    bool is_markerless = false;              ///< method = "markerless": no markers, no board
    std::filesystem::path music;
    std::filesystem::path markers;
    double frames_per_second = 60.0;
    std::optional<double> start;  ///< seconds
    capture::Board board;
    std::vector<PlannedCamera> cameras;

    /// A file of the capture.
    [[nodiscard]] std::filesystem::path file(const std::filesystem::path& name) const {
        return folder / name;
    }
};

/// Reads capture.toml. `file`: its name, for messages; `folder` is stored. Errors, one line with
/// its number: not TOML, another format or version, unknown keys (with the nearest), values out of
/// range, no camera or two of one name, a board that check_board refuses.
[[nodiscard]] Expected<CapturePlan> parse_capture_plan(std::string_view text,
                                                       const std::string& file,
                                                       const std::filesystem::path& folder);
/// The same of a folder. Errors: also no folder, no capture.toml in it.
[[nodiscard]] Expected<CapturePlan> load_capture_plan(const std::filesystem::path& folder);

/// A plan as the text of such a file, which reads back to the same values.
[[nodiscard]] std::string capture_plan_text(const CapturePlan& plan);

/// Whether markers are followed by the angles of a body: as it was said, or else where `films`
/// cameras are too few to tell markers of one colour apart, and the trunk has the three markers
/// that a body is found by.
[[nodiscard]] bool is_body_followed(std::optional<TrackingMethod> said,
                                    const capture::MarkerSet& markers,
                                    std::size_t films);

/// That so few cameras cannot follow markers that share colours, not even by a body, in one line;
/// empty: they can.
[[nodiscard]] std::string too_few_for_colours(const capture::MarkerSet& markers, std::size_t films);

/// That a capture has cameras enough to tell where something is. Error: it has one.
[[nodiscard]] Expected<void> check_cameras(const CapturePlan& plan);
/// The names of its cameras.
[[nodiscard]] std::vector<std::string> plan_names(const CapturePlan& plan);

/// The markers of a capture. Errors: those of its marker set.
[[nodiscard]] Expected<capture::MarkerSet> load_markers(const CapturePlan& plan);

}  // namespace raks::apps
