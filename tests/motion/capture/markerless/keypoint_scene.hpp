// A known dance as a pose network would see it: joints projected, with the network's errors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::capture::test {

/// A dance of which everything is known.
struct SceneDance {
    motion::Skeleton skeleton;
    std::vector<motion::Pose> poses;
    double frames_per_second = 60.0;
};

/// How a network errs.
struct NetworkErrors {
    double pixels = 15.0;  ///< of each coordinate, half of it changing slowly; at 620 px of body
    double joints = 0.02;  ///< where it takes joints to be, each axis; metres
    double drop = 0.02;    ///< share of the joints that it is not sure of
    double rate = 30.0;    ///< pictures a second
    std::uint64_t seed = 1;
    /// Sides exchanged in camera 0 between these seconds, and another person in camera 1.
    std::optional<std::pair<double, double>> exchanged{};
    std::optional<std::pair<double, double>> stranger{};
};

/// A written figure of tests/data/choreography, danced so long that it has these seconds.
[[nodiscard]] SceneDance written_dance(const std::string& file,
                                       std::size_t figure,
                                       double seconds,
                                       double size = 1.0);
/// A BVH on its own body turned into the mannequin's poses, at most these seconds.
[[nodiscard]] std::optional<SceneDance> dance_of(const std::filesystem::path& bvh, double seconds);

/// Cameras around the origin at these angles (degrees, 0 at +z), 1.3 m high, `distance` metres
/// away.
[[nodiscard]] Rig ring(const std::vector<double>& angles,
                       double distance = 4.3,
                       double focal = 1559.0,
                       int size = 720);

/// What a network sees of it. `clocks`: by camera.
[[nodiscard]] std::vector<KeypointFilm> filmed(const SceneDance& dance,
                                               const Rig& rig,
                                               const std::vector<Clock>& clocks,
                                               const NetworkErrors& errors);

/// Clocks that all tell the capture's time.
[[nodiscard]] std::vector<Clock> true_clocks(const Rig& rig);

}  // namespace raks::capture::test
