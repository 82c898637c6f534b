// Keypoint search: the joints of the dancer in the films of a capture.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/raks_capture/film_detections.hpp"
#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/keypoints/pose_network.hpp"

namespace raks::apps {

/// How joints are looked for.
struct KeypointOptions {
    std::size_t every = 1;                     ///< picture; >= 1
    double folder_pictures_per_second = 30.0;  ///< of folders of pictures; > 0
    /// Told from time to time: pictures looked at, and in all as the film claims (0: unknown).
    std::function<void(std::size_t done, std::size_t all)> tell_progress = [](std::size_t,
                                                                              std::size_t) {};
    /// Asked before each picture; true ends the work with an error.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// What was found in a film.
struct FilmKeypoints {
    capture::KeypointFilm seen;
    std::string warning;  ///< one line: the film is damaged or cut off; empty: it is not
};

/// Finds the dancer in the pictures of one film. The same film gives the same bits. Errors: those
/// of the reader and of the networks; stopped. Threads: any, one film each.
[[nodiscard]] Expected<FilmKeypoints> find_keypoints(const CameraFilm& film,
                                                     const capture::PoseModels& models,
                                                     const KeypointOptions& options = {});

}  // namespace raks::apps
