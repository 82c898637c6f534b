// Rig: the cameras of a capture, and what is implausible about them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"

namespace raks::capture {

/// How it is known where the floor of a rig's world lies, and which way is up.
enum class FloorOrigin : std::uint8_t {
    known,    ///< from a board on it, or from another program
    unknown,  ///< up is the cameras' mean up, heights are a guess
    feet,     ///< from where the dancer's feet stood (feet_floor.hpp)
};

/// The cameras that filmed one dance.
struct Rig {
    std::vector<Camera> cameras;             ///< names differ
    FloorOrigin floor = FloorOrigin::known;  ///< of its world

    /// The camera of a name. None: there is none.
    [[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) const noexcept;

    friend bool operator==(const Rig&, const Rig&) = default;
};

/// Checks what no rig may be, in one line that names the camera: fewer than two cameras, two of one
/// name, pictures without size, focal lengths that are not positive, numbers that are not finite, a
/// rotation that is none (R^T R off by more than 1e-3) or a mirror image (determinant -1).
[[nodiscard]] Expected<void> check_rig(const Rig& rig);

/// What is doubtful about a rig that passed check_rig, one line each: cameras more than 50 m or
/// less than 5 cm apart (which unit?), a principal point outside of the middle half of its picture,
/// a camera under the floor.
[[nodiscard]] std::vector<std::string> rig_doubts(const Rig& rig);

/// The cameras whose lens folds over where it is used, one line each. `used`: by camera, how far
/// from its principal point something was seen; pixels.
[[nodiscard]] std::vector<std::string> folding_doubts(const Rig& rig,
                                                      const std::vector<double>& used);

/// The expected error of a point in the middle, RMS in metres, for `views` cameras on a horizontal
/// ring at `distance` metres with focal length `f` and noise `sigma` pixels: (Z sigma / f)
/// sqrt(5 / n).
[[nodiscard]] double expected_error(double distance, double f, double sigma, double views) noexcept;

}  // namespace raks::capture
