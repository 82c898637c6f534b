// Pose network: the networks of BlazePose, run by OpenCV.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/keypoints/pose_square.hpp"
#include "motion/capture/pictures/chroma.hpp"

namespace raks::capture {

/// The networks' files, read: what every camera makes its own networks from.
struct PoseModels {
    std::string detector;  ///< ONNX
    std::string joints;    ///< ONNX
    std::string name;      ///< of the network that finds joints: "full"
};
/// Reads both files. Errors, one line with the file's name: those of reading, of
/// known_pose_network, a detector where the other must be.
[[nodiscard]] Expected<PoseModels> load_pose_models(const std::filesystem::path& detector,
                                                    const std::filesystem::path& joints);

/// A person that the detector sees.
struct DetectedPerson {
    PoseSquare square;
    double score = 0.0;  ///< how sure it is; [0, 1]
};

/// Joints in a square.
struct FoundJoints {
    double score = 0.0;  ///< how sure it is that somebody is there; [0, 1]
    std::array<Keypoint, kBodyPoints> points{};
    PoseSquare next;  ///< where to look in the next picture; its side may be 0: nowhere
};

/// Finds people in pictures, and the joints of one. The same picture gives the same bits, whatever
/// runs beside it. Threads: one (its networks keep their memory); several side by side. Real-time:
/// no.
class PoseNetwork {
 public:
    /// Errors: models that OpenCV does not take.
    [[nodiscard]] static Expected<PoseNetwork> create(const PoseModels& models);
    PoseNetwork(PoseNetwork&& other) noexcept;             ///< takes it over
    PoseNetwork& operator=(PoseNetwork&& other) noexcept;  ///< likewise
    ~PoseNetwork();

    /// The people in a picture, the surest first; those that the detector is not sure of by half
    /// are left out. About 35 ms.
    [[nodiscard]] std::vector<DetectedPerson> detect(const PictureView& picture);
    /// The joints of the person in a square. About 40 ms with the network "full".
    [[nodiscard]] FoundJoints find_joints(const PictureView& picture, const PoseSquare& square);

 private:
    struct Networks;
    explicit PoseNetwork(std::unique_ptr<Networks> networks);

    std::unique_ptr<Networks> networks_;
};

}  // namespace raks::capture
