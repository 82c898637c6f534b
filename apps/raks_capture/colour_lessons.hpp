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

/// One line that names two films whose labels lie on markers once they are exchanged, and hardly as
/// they are; empty: there are none. To be asked where labels show no colour. Reads each film once
/// for each camera, as far as its labels.
[[nodiscard]] std::string exchanged_films(std::span<const CameraFilm> films,
                                          const capture::MarkerSet& markers,
                                          std::span<const capture::MarkerLabel> labels,
                                          const DetectionOptions& options);

}  // namespace raks::apps
