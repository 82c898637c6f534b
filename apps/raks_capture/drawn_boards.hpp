// Drawn boards: the calibration films of the test studio.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "apps/raks_capture/camera_film.hpp"
#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::apps {

/// Films of a board.
struct BoardFilms {
    std::vector<std::filesystem::path> films;  ///< FOLDER/CAMERA_board.mp4, as the rig's cameras
    double floor = 0.0;  ///< capture time at which the board lies on the floor; seconds
};

/// Films with each camera of a rig how a board is carried about (carried_board.hpp), in a grey hall
/// in which people talk and clap: `options.music` does not sound. `clocks`: one a camera.
/// The same input gives the same films. 16 s of film for each camera of the rig; a picture of
/// 1280 x 720 takes 0.12 s of one core. Errors: a film that cannot be written, stopped.
[[nodiscard]] Expected<BoardFilms> draw_board_films(const capture::Rig& rig,
                                                    const capture::Board& board,
                                                    std::span<const capture::Clock> clocks,
                                                    const std::filesystem::path& folder,
                                                    const DrawnFilmOptions& options);

}  // namespace raks::apps
