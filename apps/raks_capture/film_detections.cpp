#include "apps/raks_capture/film_detections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "apps/raks_capture/colour_lessons.hpp"
#include "engine/films/film_reader.hpp"
#include "motion/capture/pictures/marker_finder.hpp"

namespace raks::apps {
namespace {

constexpr std::size_t kTellEvery = 10;     // pictures
constexpr double kSmallest = 0.12;         // of a spot, of the labelled markers' area
constexpr double kLargest = 8.0;           // likewise
constexpr double kLeastSpot = 4.0;         // pixels
constexpr double kTypicalDistance2 = 2.0;  // of a spot whose mean its colour may follow
constexpr double kFarthestLight2 = 1.0;    // from the mean that was learnt
constexpr double kRarely = 0.05;           // of the pictures

Expected<void> check_labels(std::span<const CameraFilm> films,
                            const capture::MarkerSet& markers,
                            std::span<const capture::MarkerLabel> labels) {
    for (const capture::MarkerLabel& label : labels) {
        const bool is_known =
            std::any_of(films.begin(), films.end(), [&label](const CameraFilm& film) {
                return film.camera == label.camera;
            });
        if (!is_known) {
            return fail("a label is of camera \"" + label.camera + "\", which there is none of");
        }
        if (!markers.index_of(label.marker)) {
            return fail("a label is of marker \"" + label.marker +
                        "\", which the marker set does not have");
        }
    }
    return {};
}

capture::FinderOptions finder_options(const LearntColours& learnt) {
    double smallest = learnt.models.front().area;
    double largest = smallest;
    for (const capture::ColourModel& model : learnt.models) {
        smallest = std::min(smallest, model.area);
        largest = std::max(largest, model.area);
    }
    return {.least_area = std::max(kLeastSpot, kSmallest * smallest),
            .greatest_area = std::max(kLargest * largest, 100.0)};
}

// Means follow the light by those spots that are surely of their colour, unless there are more of
// them than markers. They stay within what the colour varied by when it was learnt: by the pale
// edges of the spots a mean would else wander into the background, and find more of it each time.
void follow_light(capture::MarkerFinder& finder,
                  const LearntColours& learnt,
                  const std::vector<capture::Spot>& spots) {
    for (std::size_t colour = 0; colour < finder.models().size(); ++colour) {
        const capture::ColourModel& model = finder.models()[colour];
        glm::dvec2 sum{};
        std::size_t count = 0;
        for (const capture::Spot& spot : spots) {
            if (spot.detection.colour == colour &&
                model.distance2(spot.mean_chroma) < kTypicalDistance2) {
                sum += spot.mean_chroma;
                ++count;
            }
        }
        if (count == 0 || count > learnt.markers[colour]) {
            continue;
        }
        const glm::dvec2 seen = sum / static_cast<double>(count);
        const glm::dvec2 next = model.mean + capture::kMostAdaption * (seen - model.mean);
        if (learnt.models[colour].distance2(next) <= kFarthestLight2) {
            finder.adapt_colour(colour, seen, capture::kMostAdaption);
        }
    }
}

void tell_rare_colours(const CameraFilm& film,
                       const capture::SeenFilm& seen,
                       const LearntColours& learnt,
                       const std::vector<std::string>& names,
                       std::vector<std::string>& doubts) {
    for (const std::size_t colour : learnt.colours) {
        const auto with_it = std::count_if(
            seen.pictures.begin(), seen.pictures.end(), [colour](const auto& picture) {
                return std::any_of(picture.detections.begin(),
                                   picture.detections.end(),
                                   [colour](const capture::Detection& detection) {
                                       return detection.colour == colour;
                                   });
            });
        if (static_cast<double>(with_it) < kRarely * static_cast<double>(seen.pictures.size())) {
            doubts.push_back(fmt::format("camera {}: {} was found in {} of {} pictures",
                                         film.camera,
                                         names[colour],
                                         with_it,
                                         seen.pictures.size()));
        }
    }
}

Expected<capture::SeenFilm> detect_in_film(const CameraFilm& film,
                                           std::size_t number,
                                           const LearntColours& learnt,
                                           const DetectionOptions& options,
                                           std::vector<std::string>& doubts) {
    auto finder = capture::MarkerFinder::create(learnt.models, finder_options(learnt));
    if (!finder) {
        return fail("camera " + film.camera + ": " + finder.error().message);
    }
    const auto reader = open_film(film, options);
    if (!reader) {
        return fail(reader.error());
    }
    const std::size_t all = claimed_pictures((*reader)->info());
    capture::SeenFilm seen{.camera = film.camera, .pictures = {}};
    for (;;) {
        const auto picture = (*reader)->next();
        if (!picture) {
            return fail(picture.error());
        }
        if (!*picture) {
            break;
        }
        const std::vector<capture::Spot> spots =
            finder->find({(*picture)->width, (*picture)->height, (*picture)->rgb});
        follow_light(*finder, learnt, spots);
        capture::SeenPicture& found = seen.pictures.emplace_back();
        found.time = (*picture)->seconds;
        for (const capture::Spot& spot : spots) {
            found.detections.push_back(spot.detection);
            found.detections.back().colour = learnt.colours[spot.detection.colour];
        }
        if (seen.pictures.size() % kTellEvery == 0) {
            options.tell_progress(number, seen.pictures.size(), all);
        }
    }
    options.tell_progress(number, seen.pictures.size(), seen.pictures.size());
    if (!(*reader)->warning().empty()) {
        doubts.push_back((*reader)->warning());
    }
    return seen;
}

}  // namespace

Expected<std::unique_ptr<engine::FilmReader>> open_film(const CameraFilm& film,
                                                        const DetectionOptions& options) {
    auto reader =
        engine::FilmReader::open(film.path,
                                 {.folder_pictures_per_second = options.folder_pictures_per_second,
                                  .is_stop_requested = options.is_stop_requested});
    if (!reader || film.width == 0) {
        return reader;
    }
    const engine::FilmInfo& info = (*reader)->info();
    if (info.width == film.width && info.height == film.height) {
        return reader;
    }
    const bool is_turned = info.width == film.height && info.height == film.width;
    return fail(
        fmt::format("camera {}: {} has pictures of {} x {}, but {} x {} were calibrated: {}",
                    film.camera,
                    film.path.string(),
                    info.width,
                    info.height,
                    film.width,
                    film.height,
                    is_turned ? "the camera was turned; film board and dance alike"
                              : "film board and dance with the same settings"));
}

std::size_t claimed_pictures(const engine::FilmInfo& info) {
    return static_cast<std::size_t>(std::lround(
        std::clamp(info.claimed_seconds.value_or(0.0) * info.pictures_per_second, 0.0, 1e9)));
}

Expected<FilmDetections> detect_in_films(std::span<const CameraFilm> films,
                                         const capture::MarkerSet& markers,
                                         std::span<const capture::MarkerLabel> labels,
                                         const DetectionOptions& options) {
    if (films.empty()) {
        return fail("there is no film to find markers in");
    }
    if (auto checked = check_labels(films, markers, labels); !checked) {
        return fail(checked.error());
    }
    FilmDetections found;
    found.seen.colours = markers.colours();
    for (std::size_t i = 0; i < films.size(); ++i) {
        const auto learnt = learn_colours(films[i], markers, labels, options, found.doubts);
        if (!learnt) {
            return fail(learnt.error());
        }
        auto seen = detect_in_film(films[i], i, *learnt, options, found.doubts);
        if (!seen) {
            return fail(seen.error());
        }
        tell_rare_colours(films[i], *seen, *learnt, found.seen.colours, found.doubts);
        found.seen.films.push_back(std::move(*seen));
    }
    return found;
}

}  // namespace raks::apps
