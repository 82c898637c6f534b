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

/// A capture: a folder with this file (TOML), from which each step reads and to which it writes.
///
///     format = "raks-capture"
///     version = 1
///     height = 1.72                 # of the dancer, metres; left out: found from the markers
///     body = "dance"                # or "paper": 22 degrees of freedom; or a file of joints
///     method = "positions"          # or "angles": how markers are followed
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
    bool is_by_angles = false;  ///< method = "angles"
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

/// The markers of a capture. Errors: those of its marker set.
[[nodiscard]] Expected<capture::MarkerSet> load_markers(const CapturePlan& plan);

}  // namespace raks::apps
