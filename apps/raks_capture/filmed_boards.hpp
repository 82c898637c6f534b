// Filmed boards: what the cameras of a capture saw of the board in their calibration films.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/calibration/rig_calibration.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// How to look.
struct BoardSearch {
    double every = 0.5;  ///< between the pictures of a film that are looked at; s
    /// When the board lay on the floor, in steps; it is looked for there more closely.
    std::optional<std::size_t> floor_moment{};
    std::vector<capture::Clock> clocks;  ///< of the calibration films; empty: all began at once
    /// Told the share that is done, [0, 1].
    std::function<void(double)> on_progress = [](double) {};
    /// Told the name of each camera whose film shows the board, once it is read, and in how many
    /// pictures.
    std::function<void(const std::string& camera, std::size_t found)> on_camera =
        [](const std::string&, std::size_t) {};
    /// Asked picture by picture; true ends the search with an error.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// What was found.
struct FilmedBoards {
    std::vector<capture::FilmedCamera> cameras;  ///< in the plan's order
    /// Moments count the search's steps; of folders of pictures, the pictures.
    std::vector<capture::Sighting> sightings;
    std::vector<std::size_t> pictures;  ///< looked at, by camera
    std::vector<std::string> warnings;  ///< one line each
};

/// Looks for the board in every camera's calibration film or folder of pictures. Cameras take their
/// pictures at different times: where a moment lies between two of a film, corners are taken
/// between theirs, unless the board moves so far meanwhile that nobody knows. Errors: clocks that
/// leave out a camera, a camera without one, a film that cannot be read, a camera that never saw
/// the board, with what its pictures show instead. Threads: one at a time; it uses one.
[[nodiscard]] Expected<FilmedBoards> find_filmed_boards(const CapturePlan& plan,
                                                        const BoardSearch& search);

}  // namespace raks::apps
