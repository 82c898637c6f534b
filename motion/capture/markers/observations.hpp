// Observations: what the cameras saw, as points in pictures, and the clocks of the cameras.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// One spot of a marker's colour in a picture.
struct Detection {
    glm::dvec2 pixel{};      ///< its centre, as filmed (with the lens' distortion)
    std::size_t colour = 0;  ///< index in Observations::colours
    double area = 0.0;       ///< pixels; 0: not known

    friend bool operator==(const Detection&, const Detection&) = default;
};

/// What was found in one picture.
struct SeenPicture {
    double time = 0.0;  ///< by the camera's own clock; seconds
    std::vector<Detection> detections;

    friend bool operator==(const SeenPicture&, const SeenPicture&) = default;
};

/// What one camera saw.
struct SeenFilm {
    std::string camera;                 ///< its name in the rig
    std::vector<SeenPicture> pictures;  ///< times go on

    friend bool operator==(const SeenFilm&, const SeenFilm&) = default;
};

/// What all cameras saw.
struct Observations {
    std::vector<std::string> colours;  ///< names
    std::vector<SeenFilm> films;

    friend bool operator==(const Observations&, const Observations&) = default;
};

/// The clock of one camera against that of the capture:
/// capture time = offset + (1 + drift_ppm / 1e6) * camera time.
struct Clock {
    std::string camera;       ///< its name in the rig
    double offset = 0.0;      ///< seconds
    double drift_ppm = 0.0;   ///< parts in a million
    double confidence = 1.0;  ///< [0, 1]; 1: known or set by hand

    /// The capture's time of a moment by the camera's clock; seconds.
    [[nodiscard]] double capture_time(double camera_time) const noexcept {
        return offset + (1.0 + drift_ppm * 1e-6) * camera_time;
    }
    /// The camera's time of a moment of the capture; seconds.
    [[nodiscard]] double camera_time(double capture_time) const noexcept {
        return (capture_time - offset) / (1.0 + drift_ppm * 1e-6);
    }

    friend bool operator==(const Clock&, const Clock&) = default;
};

/// The moment from which all cameras film, each from 0 by its own clock; seconds of the capture.
/// Without a clock 0.
[[nodiscard]] double common_start(const std::vector<Clock>& clocks) noexcept;

/// Observations as a table (`detections.csv`): camera,picture,time,colour,u,v,area; a picture in
/// which nothing was found has one row with an empty colour. Numbers read back to the same bits.
[[nodiscard]] std::string observations_text(const Observations& observations);
/// Reads it. Errors, one line with its number: no such head, words that are no numbers or not
/// finite, times that do not go on, pictures out of order, more than 100 cameras or 256 colours.
[[nodiscard]] Expected<Observations> read_observations(std::string_view text,
                                                       const std::string& file);

/// Clocks as a TOML file (`clocks.toml`).
[[nodiscard]] std::string clocks_text(const std::vector<Clock>& clocks);
/// Reads it. Errors, one line with its number: not TOML, another format or version, a camera twice,
/// a drift beyond 5,000 ppm, offsets beyond a day.
[[nodiscard]] Expected<std::vector<Clock>> read_clocks(std::string_view text,
                                                       const std::string& file);

}  // namespace raks::capture
