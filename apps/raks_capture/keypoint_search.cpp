#include "apps/raks_capture/keypoint_search.hpp"

#include <utility>

#include "engine/films/film_reader.hpp"
#include "motion/capture/keypoints/pose_tracker.hpp"

namespace raks::apps {
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
            capture::KeypointPicture& seen = found.seen.pictures.emplace_back(
                tracker.follow({(*picture)->width, (*picture)->height, (*picture)->rgb}));
            seen.number = number;
            seen.time = (*picture)->seconds;
        }
        options.tell_progress(number + 1, all);
    }
    found.warning = (*reader)->warning();
    return found;
}

}  // namespace raks::apps
