// VMD camera: what a camera of MikuMikuDance sees at a moment.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/mmd/vmd.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// Where a camera is, and where it looks: along -z of its turn, with +y up.
struct MmdView {
    glm::dvec3 target{};                  ///< metres
    double distance = 4.0;                ///< metres behind the target; below 0: before it
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< from the world's axes to the camera's
    double view_angle = 30.0;             ///< degrees, from the lower to the upper edge

    /// Where it stands.
    [[nodiscard]] glm::dvec3 eye() const { return target + turn * glm::dvec3(0.0, 0.0, distance); }
};

/// The keys of a camera, to be asked at any time.
class MmdCameraPath {
 public:
    /// Reads the camera's part of a VMD; `name` stands for the file in errors. Errors: those of
    /// read_vmd; a file without a camera.
    [[nodiscard]] static Expected<MmdCameraPath> parse(std::string_view bytes,
                                                       std::string_view name);
    /// `keys`: at least one, sorted, no frame twice.
    explicit MmdCameraPath(std::vector<MmdCameraKey> keys) : keys_(std::move(keys)) {}

    /// The view at seconds; each number by its curve between two keys, held before the first and
    /// behind the last. Between keys of neighbouring frames it is the first one's: a cut.
    [[nodiscard]] MmdView at(double seconds) const;
    /// The time of the last key, seconds.
    [[nodiscard]] double duration() const { return keys_.back().frame / kMmdRate; }

 private:
    std::vector<MmdCameraKey> keys_;
};

}  // namespace raks::motion
