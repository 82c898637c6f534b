#include "motion/capture/markerless/keypoint_take.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kLongestStep = 0.12;  // seconds between pictures that say what lies between them
constexpr double kErrorShare = 1.0 / 40.0;  // of the body's height in the picture
// From nose to ankles is so much of a standing body.
constexpr double kSeenShare = 0.85;
constexpr double kSeen = 0.5;  // visibility

bool is_anybody(const KeypointPicture& picture) {
    return std::any_of(picture.points.begin(), picture.points.end(), [](const Keypoint& point) {
        return point.visibility > 0.0;
    });
}

// The time that two cameras or more film.
struct Stretch {
    double first = 0.0;
    double last = 0.0;
};

Stretch shared_time(const std::vector<KeypointFilm>& films, const std::vector<Clock>& clocks) {
    std::vector<double> starts;
    std::vector<double> ends;
    for (std::size_t i = 0; i < films.size(); ++i) {
        starts.push_back(clocks[i].capture_time(films[i].pictures.front().time));
        ends.push_back(clocks[i].capture_time(films[i].pictures.back().time));
    }
    std::sort(starts.begin(), starts.end());
    std::sort(ends.begin(), ends.end());
    return {starts[1], ends[ends.size() - 2]};
}

}  // namespace

std::array<Keypoint, kBodyPoints> keypoints_at(const KeypointFilm& film, double camera_time) {
    const auto after = std::lower_bound(
        film.pictures.begin(),
        film.pictures.end(),
        camera_time,
        [](const KeypointPicture& picture, double time) { return picture.time < time; });
    if (after == film.pictures.end() || after == film.pictures.begin()) {
        const bool is_first = after == film.pictures.begin() && !film.pictures.empty() &&
                              std::abs(after->time - camera_time) < 1e-9;
        return is_first ? after->points : std::array<Keypoint, kBodyPoints>{};
    }
    const KeypointPicture& before = *(after - 1);
    const double step = after->time - before.time;
    std::array<Keypoint, kBodyPoints> points{};
    if (step > kLongestStep) {
        return points;
    }
    const double share = (camera_time - before.time) / step;
    for (std::size_t i = 0; i < kBodyPoints; ++i) {
        const Keypoint& one = before.points[i];
        const Keypoint& other = after->points[i];
        if (one.visibility > 0.0 && other.visibility > 0.0) {
            points[i] = {glm::mix(one.pixel, other.pixel, share),
                         std::min(one.visibility, other.visibility)};
        }
    }
    return points;
}

Expected<KeypointTake> keypoint_take(const std::vector<KeypointFilm>& films,
                                     const std::vector<Clock>& clocks,
                                     double frames_per_second) {
    if (films.size() < 2) {
        return fail("one camera is too few: a second one tells how far away things are");
    }
    for (const KeypointFilm& film : films) {
        if (std::none_of(film.pictures.begin(), film.pictures.end(), is_anybody)) {
            return fail(
                fmt::format("{}: nobody is seen in its film; the dancer's whole body and "
                            "feet must be in view",
                            film.camera));
        }
    }
    const Stretch shared = shared_time(films, clocks);
    const double seconds = shared.last - shared.first;
    if (!(seconds > 1.0)) {
        return fail("the films share no second of time; are the clocks right (clocks.toml)?");
    }
    KeypointTake take;
    take.frames_per_second = frames_per_second;
    take.first_time = shared.first;
    take.cameras = films.size();
    take.frame_count = static_cast<std::size_t>(seconds * frames_per_second) + 1;
    take.sights.reserve(take.cameras * take.frame_count);
    for (std::size_t frame = 0; frame < take.frame_count; ++frame) {
        for (std::size_t camera = 0; camera < films.size(); ++camera) {
            take.sights.push_back(
                keypoints_at(films[camera], clocks[camera].camera_time(take.time_of(frame))));
        }
    }
    return take;
}

double usual_error(const KeypointTake& take, std::size_t camera) {
    std::vector<double> heights;
    for (std::size_t frame = 0; frame < take.frame_count; ++frame) {
        const Keypoint& nose = take.point(frame, camera, BodyPoint::nose);
        const Keypoint& left = take.point(frame, camera, BodyPoint::left_ankle);
        const Keypoint& right = take.point(frame, camera, BodyPoint::right_ankle);
        if (left.visibility > kSeen && right.visibility > kSeen && nose.visibility > 0.0) {
            heights.push_back(glm::distance(nose.pixel, 0.5 * (left.pixel + right.pixel)));
        }
    }
    if (heights.empty()) {
        return 0.0;
    }
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return kErrorShare * *middle / kSeenShare;
}

double body_size(double usual_error) noexcept { return usual_error / kErrorShare; }

}  // namespace raks::capture
