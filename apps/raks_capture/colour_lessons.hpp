#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/raks_capture/film_detections.hpp"
#include "base/expected.hpp"
#include "motion/capture/pictures/colour_model.hpp"

namespace raks::apps {

/// The colours of one camera, learnt from its film.
struct LearntColours {
    std::vector<capture::ColourModel> models;
    std::vector<std::size_t> colours;  ///< of each model: its index in MarkerSet::colours()
    std::vector<std::size_t> markers;  ///< of each model: how many of the set have its colour
};

/// Reads the film as far as its last label and learns each colour that is labelled. What is
/// doubtful is added to `doubts`. Errors: as detect_in_films.
[[nodiscard]] Expected<LearntColours> learn_colours(const CameraFilm& film,
                                                    const capture::MarkerSet& markers,
                                                    std::span<const capture::MarkerLabel> labels,
                                                    const DetectionOptions& options,
                                                    std::vector<std::string>& doubts);

}  // namespace raks::apps
