// Camera views: small questions about the cameras of a capture that its windows ask.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/film_detections.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// Names of the cameras, in order.
[[nodiscard]] std::vector<std::string> camera_names(const CapturePlan& plan);

/// One film for each camera; without a path where the plan names none.
[[nodiscard]] std::vector<CameraFilm> films_by_camera(const CapturePlan& plan);

/// What a camera saw; null: nothing is known.
[[nodiscard]] const capture::SeenFilm* film_of(const capture::Observations& seen,
                                               std::string_view camera);

/// Width and height of a camera's pictures without looking at a film: the lens', else as large as
/// its spots need; pixels, >= 16.
[[nodiscard]] std::pair<int, int> size_of_picture(std::string_view camera,
                                                  const capture::Rig& rig,
                                                  const capture::Observations& seen);

/// The spots of a picture with the colours of a marker set instead of those of the table; spots of
/// other colours are left out.
[[nodiscard]] std::vector<capture::Detection> spots_in_colours_of(
    const capture::SeenPicture& picture,
    const std::vector<std::string>& colours,
    const capture::MarkerSet& markers);

}  // namespace raks::apps
