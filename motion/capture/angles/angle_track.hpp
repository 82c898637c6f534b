// Angle track: the postures of a body over time, as the angle tracker finds them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// Postures of a model, frame after frame.
struct AngleTrack {
    double frames_per_second = 0.0;  ///< > 0
    double first_time = 0.0;         ///< capture time of frame 0; seconds
    std::vector<BodyState> states;   ///< by frame; where lost, the nearest in time
    std::vector<bool> is_lost;       ///< by frame: the body was not found there
    /// By frame and variable: how far the particles were spread; metres and radians.
    std::vector<std::vector<double>> deviations;

    /// Capture time of a frame; seconds.
    [[nodiscard]] double time_of(std::size_t frame) const noexcept {
        return first_time + static_cast<double>(frame) / frames_per_second;
    }
};

/// Postures as a table (`angles.csv`): frame,time,joint,x,y,z,deviation. The first row of a frame
/// is `place`, that of the hips in the world, metres. Then each joint of the model: axis times
/// angle of its turn from the T-pose in radians, of a hinge the angle alone; `deviation`: of the
/// variable that is least sure. Where the body is lost, cells are blank.
[[nodiscard]] std::string angles_text(const AngleTrack& track, const BodyModel& model);

/// Whether the joints that such a table names are the model's, by its first frame. True as well for
/// what is no such table: read_angles says what is wrong with that.
[[nodiscard]] bool is_of_body(std::string_view text, const BodyModel& model);

/// Reads it. Errors, one line with its number: no such head, words that are no numbers, frames out
/// of order or not complete, other joints than the model's, angles beyond three turns, no frame in
/// which the body is found.
[[nodiscard]] Expected<AngleTrack> read_angles(std::string_view text,
                                               const std::string& file,
                                               const BodyModel& model);

}  // namespace raks::capture
