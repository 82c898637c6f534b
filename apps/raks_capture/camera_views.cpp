#include "apps/raks_capture/camera_views.hpp"

#include <algorithm>
#include <cmath>

namespace raks::apps {

std::vector<std::string> camera_names(const CapturePlan& plan) {
    std::vector<std::string> names;
    for (const PlannedCamera& camera : plan.cameras) {
        names.push_back(camera.name);
    }
    return names;
}

std::vector<CameraFilm> films_by_camera(const CapturePlan& plan) {
    std::vector<CameraFilm> films;
    for (const PlannedCamera& camera : plan.cameras) {
        films.push_back({camera.name, camera.film.empty() ? camera.film : plan.file(camera.film)});
    }
    return films;
}

const capture::SeenFilm* film_of(const capture::Observations& seen, std::string_view camera) {
    const auto film = std::find_if(seen.films.begin(), seen.films.end(), [&](const auto& one) {
        return one.camera == camera;
    });
    return film != seen.films.end() ? &*film : nullptr;
}

std::pair<int, int> size_of_picture(std::string_view camera,
                                    const capture::Rig& rig,
                                    const capture::Observations& seen) {
    if (const auto index = rig.index_of(camera)) {
        const capture::Lens& lens = rig.cameras[*index].lens;
        return {lens.width, lens.height};
    }
    constexpr double kLeast = 15.0;
    constexpr double kMost = 1e5;
    glm::dvec2 farthest(kLeast);
    if (const capture::SeenFilm* const film = film_of(seen, camera)) {
        for (const capture::SeenPicture& picture : film->pictures) {
            for (const capture::Detection& spot : picture.detections) {
                farthest = {std::max(farthest.x, spot.pixel.x), std::max(farthest.y, spot.pixel.y)};
            }
        }
    }
    return {static_cast<int>(std::min(farthest.x, kMost)) + 1,
            static_cast<int>(std::min(farthest.y, kMost)) + 1};
}

std::vector<capture::Detection> spots_in_colours_of(const capture::SeenPicture& picture,
                                                    const std::vector<std::string>& colours,
                                                    const capture::MarkerSet& markers) {
    const std::vector<std::string> known = markers.colours();
    std::vector<capture::Detection> spots;
    for (capture::Detection spot : picture.detections) {
        const auto colour = std::find(known.begin(), known.end(), colours[spot.colour]);
        if (colour != known.end()) {
            spot.colour = static_cast<std::size_t>(colour - known.begin());
            spots.push_back(spot);
        }
    }
    return spots;
}

}  // namespace raks::apps
