#include "motion/capture/tracking/frame_views.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

double focal_length(const Camera& camera) noexcept {
    return 0.5 * (camera.lens.fx + camera.lens.fy);
}

/// Where a marker is expected in a picture.
struct Expectation {
    glm::dvec2 direction{};
    glm::dmat2 information{};  ///< inverse covariance, of directions
};

std::optional<Expectation> expectation_of(const Camera& camera,
                                          const MarkerBelief& belief,
                                          double late,
                                          double sigma) {
    const glm::dvec3 at = camera.in_camera(belief.place + late * belief.velocity);
    if (!(at.z > 0.01)) {
        return std::nullopt;
    }
    const glm::dmat3 rows = glm::transpose(camera.rotation);
    const glm::dvec2 direction(at.x / at.z, at.y / at.z);
    const glm::dvec3 x = (rows[0] - direction.x * rows[2]) / at.z;
    const glm::dvec3 y = (rows[1] - direction.y * rows[2]) / at.z;
    const glm::dvec3 px = belief.place_covariance * x;
    const glm::dvec3 py = belief.place_covariance * y;
    const double noise = sigma / focal_length(camera);
    const glm::dmat2 covariance(glm::dot(x, px) + noise * noise,
                                glm::dot(x, py),
                                glm::dot(x, py),
                                glm::dot(y, py) + noise * noise);
    return Expectation{direction, glm::inverse(covariance)};
}

// The unused spot of a camera that is nearest to a place's projection, and not further than so.
std::optional<std::size_t> nearest_spot(const Rig& rig,
                                        const std::vector<SeenSpot>& spots,
                                        std::size_t camera,
                                        std::size_t colour,
                                        const glm::dvec3& place,
                                        double farthest) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        if (spots[i].camera != camera || spots[i].colour != colour || spots[i].is_used) {
            continue;
        }
        const double apart = view_residual(rig, view_of(spots[i], {}), place);
        if (apart < farthest) {
            farthest = apart;
            nearest = i;
        }
    }
    return nearest;
}

// The spots of all cameras that agree with a pair's place, and where they put it.
std::optional<SpotAgreement> grown(const Rig& rig,
                                   const std::vector<SeenSpot>& spots,
                                   std::size_t one,
                                   std::size_t other,
                                   double sigma) {
    const std::vector<PointView> pair = {view_of(spots[one], {}), view_of(spots[other], {})};
    const auto start = triangulate(rig, pair, sigma);
    const double farthest = 3.0 * sigma + 1.0;
    if (!start || start->residual > farthest) {
        return std::nullopt;
    }
    SpotAgreement agreement;
    std::vector<PointView> views;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
        const auto spot =
            nearest_spot(rig, spots, camera, spots[one].colour, start->place, 2.0 * farthest);
        if (spot) {
            agreement.spots.push_back(*spot);
            views.push_back(view_of(spots[*spot], {}));
        }
    }
    auto point = triangulate(rig, views, sigma);
    if (!point || point->residual > farthest) {
        return std::nullopt;
    }
    std::vector<std::size_t> kept;
    for (const std::size_t view : point->views) {
        kept.push_back(agreement.spots[view]);
    }
    agreement.spots = std::move(kept);
    agreement.point = std::move(*point);
    return agreement;
}

}  // namespace

FrameViews::FrameViews(const Rig& rig,
                       const Observations& seen,
                       const std::vector<std::size_t>& cameras,
                       const std::vector<Clock>& clocks,
                       const std::vector<std::optional<std::size_t>>& classes,
                       double first_time,
                       double frames_per_second,
                       std::size_t frame_count)
    : spots_(frame_count) {
    for (std::size_t film = 0; film < seen.films.size(); ++film) {
        for (const SeenPicture& picture : seen.films[film].pictures) {
            const double time = clocks[film].capture_time(picture.time);
            const double frame = std::round((time - first_time) * frames_per_second);
            if (!(frame >= 0.0 && frame < static_cast<double>(frame_count))) {
                continue;
            }
            const double late = time - first_time - frame / frames_per_second;
            for (const Detection& detection : picture.detections) {
                if (!classes[detection.colour]) {
                    continue;
                }
                spots_[static_cast<std::size_t>(frame)].push_back(
                    {cameras[film],
                     *classes[detection.colour],
                     detection.pixel,
                     direction_of(rig.cameras[cameras[film]].lens, detection.pixel),
                     late});
            }
        }
    }
}

void FrameViews::forget(std::size_t camera, std::size_t first, std::size_t last) {
    for (std::size_t frame = first; frame <= last && frame < spots_.size(); ++frame) {
        std::erase_if(spots_[frame],
                      [camera](const SeenSpot& spot) { return spot.camera == camera; });
    }
}

PointView view_of(const SeenSpot& spot, const glm::dvec3& velocity) {
    return {spot.camera, spot.direction, spot.late * velocity, 1.0};
}

std::vector<std::vector<std::size_t>> match_spots(
    const Rig& rig,
    const std::vector<std::optional<MarkerBelief>>& beliefs,
    const std::vector<std::size_t>& classes,
    double sigma,
    double gate,
    std::vector<SeenSpot>& spots) {
    constexpr double kFarthest = 0.1;  // 60 pixels at a focal length of 600
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        for (std::size_t marker = 0; marker < beliefs.size(); ++marker) {
            if (spots[i].is_used || !beliefs[marker] || classes[marker] != spots[i].colour) {
                continue;
            }
            const auto expected = expectation_of(
                rig.cameras[spots[i].camera], *beliefs[marker], spots[i].late, sigma);
            if (!expected) {
                continue;
            }
            const glm::dvec2 miss = spots[i].direction - expected->direction;
            const double distance = glm::dot(miss, expected->information * miss);
            if (distance < gate && glm::length(miss) < kFarthest) {
                pairs.emplace_back(distance, marker, i);
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<std::vector<std::size_t>> matched(beliefs.size());
    for (const auto& [distance, marker, spot] : pairs) {
        const auto has_camera = [&spots, camera = spots[spot].camera](std::size_t other) {
            return spots[other].camera == camera;
        };
        if (!spots[spot].is_used &&
            std::none_of(matched[marker].begin(), matched[marker].end(), has_camera)) {
            spots[spot].is_used = true;
            matched[marker].push_back(spot);
        }
    }
    return matched;
}

std::vector<SpotAgreement> agreements(const Rig& rig,
                                      const std::vector<SeenSpot>& spots,
                                      std::size_t colour,
                                      double sigma,
                                      std::size_t least_views) {
    std::vector<SpotAgreement> found;
    for (std::size_t i = 0; i < spots.size(); ++i) {
        for (std::size_t j = i + 1; j < spots.size(); ++j) {
            const bool is_pair = spots[i].camera != spots[j].camera && !spots[i].is_used &&
                                 !spots[j].is_used && spots[i].colour == colour &&
                                 spots[j].colour == colour;
            if (!is_pair || epipolar_distance(rig.cameras[spots[i].camera],
                                              spots[i].direction,
                                              rig.cameras[spots[j].camera],
                                              spots[j].direction) > 4.0 * sigma + 1.0) {
                continue;
            }
            auto agreement = grown(rig, spots, i, j, sigma);
            if (!agreement || agreement->spots.size() < least_views) {
                continue;
            }
            if (std::none_of(found.begin(), found.end(), [&](const SpotAgreement& other) {
                    return other.spots == agreement->spots;
                })) {
                found.push_back(std::move(*agreement));
            }
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& one, const auto& other) {
        return one.spots.size() > other.spots.size();
    });
    return found;
}

}  // namespace raks::capture
