// Keypoints: the joints of a person in the pictures of a camera, as a pose network sees them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/pictures/background.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// The joints that BlazePose finds, in its order. Left and right are the person's own.
enum class BodyPoint : std::size_t {
    nose,
    left_eye_inner,
    left_eye,
    left_eye_outer,
    right_eye_inner,
    right_eye,
    right_eye_outer,
    left_ear,
    right_ear,
    mouth_left,
    mouth_right,
    left_shoulder,
    right_shoulder,
    left_elbow,
    right_elbow,
    left_wrist,
    right_wrist,
    left_pinky,
    right_pinky,
    left_index,
    right_index,
    left_thumb,
    right_thumb,
    left_hip,
    right_hip,
    left_knee,
    right_knee,
    left_ankle,
    right_ankle,
    left_heel,
    right_heel,
    left_foot_index,
    right_foot_index,
};
inline constexpr std::size_t kBodyPoints = 33;

/// Name of a joint in files: that of the enumerator.
[[nodiscard]] std::string_view name_of(BodyPoint point) noexcept;
/// All these names, by BodyPoint.
[[nodiscard]] std::span<const std::string_view> body_point_names() noexcept;
/// The joint with that name; nothing: there is none.
[[nodiscard]] std::optional<BodyPoint> body_point_named(std::string_view name) noexcept;

/// One joint in one picture.
struct Keypoint {
    /// Pixels of the picture as it is shown upright (after the film's rotation), with the lens'
    /// distortion; (0, 0) is the centre of the top left pixel, x right, y down. Finite; may lie
    /// outside the picture. (0, 0) where visibility is 0.
    glm::dvec2 pixel{};
    /// How sure it is that the joint is in the picture and not hidden; [0, 1]. 0: not found.
    double visibility = 0.0;

    friend bool operator==(const Keypoint&, const Keypoint&) = default;
};

/// The joints of the dancer in one picture.
struct KeypointPicture {
    std::size_t number = 0;  ///< of the picture in its film, from 0
    double time = 0.0;       ///< by the camera's own clock (the film's time stamps); seconds
    double score = 0.0;      ///< how sure it is that somebody is there; [0, 1]. 0: nobody
    /// How many people are in the picture; nothing: it was not looked for others.
    std::optional<std::size_t> people;
    /// Where the background is; nothing: it was not looked at, or shows too little.
    std::optional<BackgroundPlace> background;
    std::array<Keypoint, kBodyPoints> points{};  ///< by BodyPoint; all of visibility 0: nobody

    [[nodiscard]] const Keypoint& operator[](BodyPoint point) const noexcept {
        return points[static_cast<std::size_t>(point)];
    }
    [[nodiscard]] Keypoint& operator[](BodyPoint point) noexcept {
        return points[static_cast<std::size_t>(point)];
    }
    friend bool operator==(const KeypointPicture&, const KeypointPicture&) = default;
};

/// What one camera saw.
struct KeypointFilm {
    std::string camera;                     ///< its name in capture.toml
    int width = 0;                          ///< of the upright pictures; pixels
    int height = 0;                         ///< likewise
    std::string network;                    ///< that found them, "full" or "openpose"
    std::vector<KeypointPicture> pictures;  ///< numbers and times go on; some may be left out

    friend bool operator==(const KeypointFilm&, const KeypointFilm&) = default;
};

/// Keypoints of one camera as a table (`keypoints/CAMERA.csv`). First line
/// `# raks-keypoints 1 WIDTH HEIGHT NETWORK CAMERA`, then a head, then a row a picture:
/// picture,time,score,people,nose_x,nose_y,nose_v,... (four numbers and three a joint), and
/// background_x,background_y,background_size, which files of other programs may leave out. `people`
/// is empty where it was not looked for others, the background's where it was not looked at. Pixels
/// are written to a hundredth, visibilities and scores to a thousandth, sizes to a hundred
/// thousandth, times read back to the same bits.
[[nodiscard]] std::string keypoints_text(const KeypointFilm& film);
/// Reads it. Errors, one line with its number: not such a file, another version, cut off, numbers
/// that are none or not finite or out of range, pictures or times that do not go on.
[[nodiscard]] Expected<KeypointFilm> read_keypoints(std::string_view text, const std::string& file);

}  // namespace raks::capture
