#include "apps/raks_capture/film_detections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>
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

/// Told of the progress by one thread at a time.
class Listener {
 public:
    explicit Listener(const DetectionOptions& options) : options_(options) {}

    void tell(std::size_t camera, std::size_t done, std::size_t all) {
        const std::lock_guard lock(mutex_);
        options_.tell_progress(camera, done, all);
    }
    [[nodiscard]] Expected<void> take(std::size_t camera, const capture::SeenFilm& film) {
        const std::lock_guard lock(mutex_);
        return options_.take_film(camera, film);
    }

 private:
    std::mutex mutex_;
    const DetectionOptions& options_;
};

Expected<capture::SeenFilm> detect_in_film(const CameraFilm& film,
                                           std::size_t number,
                                           Listener& listener,
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
            listener.tell(number, seen.pictures.size(), all);
        }
    }
    listener.tell(number, seen.pictures.size(), seen.pictures.size());
    if (!(*reader)->warning().empty()) {
        doubts.push_back((*reader)->warning());
    }
    return seen;
}

const capture::SeenFilm* kept_of(const CameraFilm& film, const DetectionOptions& options) {
    const auto kept = std::find_if(options.kept.begin(),
                                   options.kept.end(),
                                   [&film](const auto& one) { return one.camera == film.camera; });
    return kept != options.kept.end() ? &*kept : nullptr;
}

/// A film that is to be read, and what comes of it.
struct FilmWork {
    std::size_t number = 0;  // among all films
    LearntColours learnt;
    Expected<capture::SeenFilm> seen = capture::SeenFilm{};
    std::vector<std::string> doubts;
};

// The colours of all films that are to be read. A label that shows none is blamed only where no
// other order of the films explains it.
Expected<std::vector<FilmWork>> learn_all(std::span<const CameraFilm> films,
                                          const capture::MarkerSet& markers,
                                          std::span<const capture::MarkerLabel> labels,
                                          const DetectionOptions& options) {
    std::vector<FilmWork> works;
    for (std::size_t i = 0; i < films.size(); ++i) {
        if (kept_of(films[i], options) != nullptr) {
            continue;
        }
        FilmWork work;
        work.number = i;
        auto learnt = learn_colours(films[i], markers, labels, options, work.doubts);
        if (!learnt) {
            const std::string exchanged = exchanged_films(films, markers, labels, options);
            return exchanged.empty() ? fail(std::move(learnt.error())) : fail(exchanged);
        }
        work.learnt = std::move(*learnt);
        works.push_back(std::move(work));
    }
    return works;
}

// Reads films, several at once, each by one thread.
void read_all(std::span<const CameraFilm> films,
              const std::vector<std::string>& colours,
              const DetectionOptions& options,
              std::vector<FilmWork>& works) {
    Listener listener(options);
    std::atomic<std::size_t> next = 0;
    const auto read = [&] {
        for (;;) {
            const std::size_t i =
                next.fetch_add(1, std::memory_order_relaxed);  // relaxed: a ticket
            if (i >= works.size()) {
                return;
            }
            FilmWork& work = works[i];
            const CameraFilm& film = films[work.number];
            work.seen =
                detect_in_film(film, work.number, listener, work.learnt, options, work.doubts);
            if (!work.seen) {
                continue;
            }
            tell_rare_colours(film, *work.seen, work.learnt, colours, work.doubts);
            if (auto taken = listener.take(work.number, *work.seen); !taken) {
                work.seen = fail(std::move(taken.error()));
            }
        }
    };
    const std::size_t cores = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                                  : std::thread::hardware_concurrency();
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(std::max<std::size_t>(cores, 1), works.size()); ++i) {
        helpers.emplace_back(read);
    }
    read();
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
    auto works = learn_all(films, markers, labels, options);
    if (!works) {
        return fail(std::move(works.error()));
    }
    read_all(films, found.seen.colours, options, *works);
    for (std::size_t i = 0; i < films.size(); ++i) {
        if (const capture::SeenFilm* const kept = kept_of(films[i], options)) {
            found.seen.films.push_back(*kept);
            continue;
        }
        const auto work = std::find_if(
            works->begin(), works->end(), [i](const FilmWork& one) { return one.number == i; });
        if (!work->seen) {
            return fail(std::move(work->seen.error()));
        }
        found.seen.films.push_back(std::move(*work->seen));
        found.doubts.insert(found.doubts.end(), work->doubts.begin(), work->doubts.end());
    }
    return found;
}

}  // namespace raks::apps
