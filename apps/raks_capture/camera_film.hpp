// Camera film: the film that one camera of the test studio makes of what is drawn for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "apps/raks_capture/filmed_picture.hpp"
#include "base/expected.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"
#include "motion/capture/markers/observations.hpp"
#include "render/scene/placed_camera.hpp"

#include <glm/vec3.hpp>

namespace raks::apps {

/// How films are drawn.
struct DrawnFilmOptions {
    double frames_per_second = 30.0;     ///< of the cameras; 1 to 240
    bool is_draft = false;               ///< drawn at single size and without blur
    double shutter_seconds = 1.0 / 120;  ///< for which a picture gathers light
    double rolling_shutter = 0.0;        ///< seconds between a picture's first row and its last
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
    /// Told each film that is whole.
    std::function<void(const std::filesystem::path& film)> tell_film =
        [](const std::filesystem::path&) {};
    /// Asked before each picture; true ends the work with an error, and leaves whole films alone.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// A picture of an event, as it is drawn.
struct EventPicture {
    std::span<const std::uint8_t> rgba;  ///< of the whole view; gamma 2.2
    DrawnPart part;                      ///< beyond it the picture is as it is when nothing happens
};

/// Something that happens before the cameras, and is drawn for one of them after the other.
class DrawnEvent {
 public:
    DrawnEvent() = default;
    DrawnEvent(const DrawnEvent&) = delete;             ///< used where it was made
    DrawnEvent& operator=(const DrawnEvent&) = delete;  ///< likewise
    virtual ~DrawnEvent() = default;

    /// From here on it is drawn for this view. What the view shows when nothing happens: RGBA with
    /// gamma 2.2, of the view's size, good until the next call.
    [[nodiscard]] virtual Expected<std::span<const std::uint8_t>> aim(
        const render::PinholeView& view) = 0;
    /// What the view shows at a moment of the capture; good until the next call. Precondition: aim.
    [[nodiscard]] virtual Expected<EventPicture> draw(double capture_time) = 0;
};

/// Who films, and how long.
struct FilmingCamera {
    const capture::Camera& camera;
    const capture::Clock& clock;
    std::size_t number = 0;    ///< among the cameras; its gain, noise and echo follow from it
    std::size_t pictures = 0;  ///< picture k is that of clock.capture_time(k / rate)
    /// When it is bumped (capture::bumped), by its own clock; seconds.
    std::optional<double> bump{};
};

/// Films an event with one camera: blur of what moves, the lens' distortion, gain, colour cast and
/// noise of the sensor, 4:2:0 of the film's codec, and a sound track as this camera would hear the
/// room by its clock. Errors: those of the event, a film that cannot be written, stopped.
[[nodiscard]] Expected<void> film_event(DrawnEvent& event,
                                        const FilmingCamera& filming,
                                        const std::filesystem::path& path,
                                        const DrawnFilmOptions& options);

}  // namespace raks::apps
