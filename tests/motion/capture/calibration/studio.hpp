// Boards before simulated cameras, and those that others filmed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/rig_start.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture::test {

/// A studio of which all is known: a ring of cameras that look at its middle, and a board that is
/// carried about in it.
struct Studio {
    Rig rig;  ///< the truth
    Board board;
    BoardPlaces places;
    std::vector<Sighting> sightings;
};

/// How to set it up.
struct StudioPlan {
    int cameras = 6;
    int poses = 60;
    double noise = 0.3;  ///< of each coordinate; pixels
    std::uint64_t seed = 1;
};

/// Cameras on a ring of 4 m, heights 1.55 and 2.25 m, f 600 +- 4 %, 640 x 480 pixels; a board
/// of 9 x 6 inner corners and squares of 80 mm. It is shown to two neighbouring cameras in
/// turn, tilted by chance, and is seen from the front only, whole, and not from more than 60
/// degrees to the side.
[[nodiscard]] Studio make_studio(const StudioPlan& plan);

/// Sightings whose moments are, or are not, each fifth one.
enum class Share { used, held_out };
[[nodiscard]] std::vector<Sighting> share_of(const std::vector<Sighting>& sightings, Share share);

/// The rotation and shift that bring the points onto the others best (Kabsch): same counts, three
/// or more points.
[[nodiscard]] RigidMotion best_motion(const std::vector<glm::dvec3>& from,
                                      const std::vector<glm::dvec3>& onto);

/// Reads a table of Caliscope: sync_index, cam_id, keypoint_id, img_loc_x, img_loc_y. Empty where
/// the file is not.
[[nodiscard]] std::vector<Sighting> read_sightings(const std::filesystem::path& path);

}  // namespace raks::capture::test
