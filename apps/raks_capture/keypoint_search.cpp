#include "apps/raks_capture/keypoint_search.hpp"

#include <optional>
#include <utility>

#include "engine/films/film_reader.hpp"
#include "motion/capture/keypoints/pose_tracker.hpp"
#include "motion/capture/pictures/background.hpp"

#include <glm/common.hpp>

namespace raks::apps {
namespace {

constexpr double kBackgroundEvery = 0.5;  // seconds

// Of who is there, and a little more: hair, clothes and hands go beyond joints.
std::optional<capture::PictureBounds> bounds_of(const capture::KeypointPicture& seen) {
    if (seen.score <= 0.0) {
        return std::nullopt;
    }
    capture::PictureBounds bounds{seen.points[0].pixel, seen.points[0].pixel};
    for (const capture::Keypoint& point : seen.points) {
        bounds.least = glm::min(bounds.least, point.pixel);
        bounds.greatest = glm::max(bounds.greatest, point.pixel);
    }
    constexpr double kMore = 0.15;
    const glm::dvec2 more = kMore * (bounds.greatest - bounds.least);
    return capture::PictureBounds{bounds.least - more, bounds.greatest + more};
}

}  // namespace

Expected<FilmKeypoints> find_keypoints(const CameraFilm& film,
                                       const capture::PoseModels& models,
                                       const KeypointOptions& options) {
    auto network = capture::PoseNetwork::create(models);
    if (!network) {
        return fail(network.error());
    }
    const auto reader = open_film(film,
                                  {.folder_pictures_per_second = options.folder_pictures_per_second,
                                   .is_stop_requested = options.is_stop_requested});
    if (!reader) {
        return fail(reader.error());
    }
    const engine::FilmInfo& info = (*reader)->info();
    const std::size_t all = claimed_pictures(info);
    capture::PoseTracker tracker(std::move(*network));
    capture::BackgroundFollower background;
    double look_at = 0.0;  // the film's time
    FilmKeypoints found;
    found.seen = {film.camera, info.width, info.height, models.name, {}};
    for (std::size_t number = 0;; ++number) {
        const auto picture = (*reader)->next();
        if (!picture) {
            return fail(picture.error());
        }
        if (!*picture) {
            break;
        }
        if (number % options.every == 0) {
            const capture::PictureView view{(*picture)->width, (*picture)->height, (*picture)->rgb};
            capture::KeypointPicture& seen = found.seen.pictures.emplace_back(tracker.follow(view));
            seen.number = number;
            seen.time = (*picture)->seconds;
            if (number == 0 || seen.time >= look_at) {
                seen.background = background.look(view, bounds_of(seen));
                look_at = seen.time + kBackgroundEvery;
            }
        }
        options.tell_progress(number + 1, all);
    }
    found.warning = (*reader)->warning();
    return found;
}

}  // namespace raks::apps
