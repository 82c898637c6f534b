#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "apps/raks_capture/camera_film.hpp"
#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/studio/point_studio.hpp"

#include <glm/vec3.hpp>

namespace raks::apps {

/// The paint of a marker's colour, linear: green, blue, yellow, magenta, cyan, orange and red.
/// Errors: another name.
[[nodiscard]] Expected<glm::dvec3> marker_paint(std::string_view colour);

/// Draws the film of each camera of a rig (`raks capture simulate`): the mannequin with a lit
/// sphere at each marker, drawn by Raks' own renderer at twice the size and reduced; with the lens'
/// distortion, blur of what moves, gain, colour cast and noise of the sensor, 4:2:0 of the film's
/// codec, and a sound track as this camera would hear the room by its clock. Picture k is that of
/// clock.capture_time(k / rate). Without a marker the dancer wears clothes instead of
/// one plain colour. `motion` must be of the mannequin's body; `clocks`: one a camera.
/// Films are FOLDER/CAMERA.mp4, in the order of the cameras. Of `studio` what differs from camera
/// to camera counts, and how many people there are. The same input gives the same films on the same
/// machine. Errors: no OpenGL, a colour that there is no paint of, a film that cannot be written,
/// stopped.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> draw_films(
    const capture::StudioMotion& motion,
    const capture::Rig& rig,
    const capture::MarkerSet& markers,
    std::span<const capture::Clock> clocks,
    const std::filesystem::path& folder,
    const DrawnFilmOptions& options = {},
    const capture::StudioOptions& studio = {});

}  // namespace raks::apps
