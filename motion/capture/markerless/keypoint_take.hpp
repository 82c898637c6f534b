// Keypoint take: what all cameras saw of a dancer's joints, at common moments.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::capture {

/// Keypoints of all cameras at the frames of one clock. Pixels are as filmed.
struct KeypointTake {
    double frames_per_second = 30.0;                        ///< > 0
    double first_time = 0.0;                                ///< capture time of frame 0; seconds
    std::size_t cameras = 0;                                ///< how many there are
    std::size_t frame_count = 0;                            ///< at least 1
    std::vector<std::array<Keypoint, kBodyPoints>> sights;  ///< frames x cameras, row-major

    /// What a camera sees at a frame, by BodyPoint; all of visibility 0: nobody.
    [[nodiscard]] std::array<Keypoint, kBodyPoints>& at(std::size_t frame,
                                                        std::size_t camera) noexcept {
        return sights[frame * cameras + camera];
    }
    /// The same.
    [[nodiscard]] const std::array<Keypoint, kBodyPoints>& at(std::size_t frame,
                                                              std::size_t camera) const noexcept {
        return sights[frame * cameras + camera];
    }
    /// One keypoint.
    [[nodiscard]] const Keypoint& point(std::size_t frame,
                                        std::size_t camera,
                                        BodyPoint which) const noexcept {
        return at(frame, camera)[static_cast<std::size_t>(which)];
    }
    /// Capture time of a frame; seconds.
    [[nodiscard]] double time_of(std::size_t frame) const noexcept {
        return first_time + static_cast<double>(frame) / frames_per_second;
    }
};

/// Where the joints of one camera were at a moment of its own clock: between two pictures that are
/// no more than 0.12 s apart what lies between them, as sure as the less sure one. Else nobody.
[[nodiscard]] std::array<Keypoint, kBodyPoints> keypoints_at(const KeypointFilm& film,
                                                             double camera_time);

/// Puts the films onto one clock, for the time that two of them or more film. `clocks`: by film.
/// Errors, one line: fewer than two films, films that share no moment, nobody in a film.
[[nodiscard]] Expected<KeypointTake> keypoint_take(const std::vector<KeypointFilm>& films,
                                                   const std::vector<Clock>& clocks,
                                                   double frames_per_second);

/// How far a keypoint of this camera is usually off, pixels: a fortieth of the body's height in
/// its pictures (measured on rendered dancers: 10 to 20 pixels of 620). 0: it sees nobody.
[[nodiscard]] double usual_error(const KeypointTake& take, std::size_t camera);
/// The body's height in its pictures, by the usual error of a camera; pixels.
[[nodiscard]] double body_size(double usual_error) noexcept;

}  // namespace raks::capture
