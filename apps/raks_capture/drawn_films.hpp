#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/studio/point_studio.hpp"

#include <glm/vec3.hpp>

namespace raks::apps {

/// How films are drawn.
struct DrawnFilmOptions {
    double frames_per_second = 30.0;     ///< of the cameras; 1 to 240
    bool is_draft = false;               ///< drawn at single size and without blur
    double shutter_seconds = 1.0 / 120;  ///< for which a picture gathers light
    double noise = 2.0;                  ///< of the sensors; grey levels, sd
    double least_gain = 0.5;             ///< of the cameras, drawn between both
    double greatest_gain = 1.5;
    double colour_cast = 0.05;    ///< red, green and blue differ by so much, at most
    std::string ending = ".mp4";  ///< or ".avi" (Motion JPEG), ".mkv", ".webm"
    /// What sounds in the room, from capture time 0 on; mono, 48,000 Hz. Empty: films without
    /// sound.
    std::span<const float> music{};
    glm::dvec3 loudspeaker{0.0, 1.0, -2.5};  ///< where; metres
    double reverberation = 0.5;              ///< of the room; seconds until 60 dB down
    double signal_to_noise_db = 20.0;        ///< of the microphones
    std::uint64_t seed = 1;                  ///< of all that is drawn by chance
    /// Told after each picture: camera (its index), pictures done, pictures of a film.
    std::function<void(std::size_t camera, std::size_t done, std::size_t all)> tell_progress =
        [](std::size_t, std::size_t, std::size_t) {};
    /// Asked before each picture; true ends the work with an error, and leaves whole films alone.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// The paint of a marker's colour, linear: green, blue, yellow, magenta, cyan, orange and red.
/// Errors: another name.
[[nodiscard]] Expected<glm::dvec3> marker_paint(std::string_view colour);

/// Draws the film of each camera of a rig (`raks capture simulate`): the mannequin with a lit
/// sphere at each marker, drawn by Raks' own renderer at twice the size and reduced; with the lens'
/// distortion, blur of what moves, gain, colour cast and noise of the sensor, 4:2:0 of the film's
/// codec, and a sound track as this camera would hear the room by its clock. Picture k is that of
/// clock.capture_time(k / rate). `motion` must be of the mannequin's body; `clocks`: one a camera.
/// Films are FOLDER/CAMERA.mp4, in the order of the cameras.
/// The same input gives the same films on the same machine. A picture of 640 x 480 takes about 0.13
/// s of one core with a software driver, as a draft 0.08. Errors: no OpenGL, a colour that there is
/// no paint of, a film that cannot be written, stopped.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> draw_films(
    const capture::StudioMotion& motion,
    const capture::Rig& rig,
    const capture::MarkerSet& markers,
    std::span<const capture::Clock> clocks,
    const std::filesystem::path& folder,
    const DrawnFilmOptions& options = {});

}  // namespace raks::apps
