#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/dice.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

#include <glm/common.hpp>

namespace raks::capture::test {
namespace {

/// The network's view of one camera over time.
class Network {
 public:
    Network(const SceneDance& dance,
            const Rig& rig,
            std::size_t camera,
            const Clock& clock,
            const NetworkErrors& errors)
        : dance_(dance),
          camera_(rig.cameras[camera]),
          index_(camera),
          clock_(clock),
          errors_(errors),
          dice_(errors.seed, 100 + camera),
          markers_(keypoint_markers()) {
        // Where it takes joints to be is the same in all views, and alike on both sides.
        Dice body(errors.seed, 7);
        std::map<std::string, glm::dvec3> shifts;
        for (Marker& marker : markers_.markers) {
            const bool is_right = marker.name.substr(0, 5) == "right";
            const glm::dvec3 drawn(
                body.normal(errors.joints), body.normal(errors.joints), body.normal(errors.joints));
            const std::string key = marker.name.substr(marker.name.find('_') + 1);
            const glm::dvec3 shift = shifts.emplace(key, drawn).first->second;
            marker.place += glm::dvec3(is_right ? -shift.x : shift.x, shift.y, shift.z);
        }
        slow_.resize(markers_.markers.size());
    }

    KeypointFilm film() {
        KeypointFilm film{camera_.name, camera_.lens.width, camera_.lens.height, "full", {}};
        const double seconds =
            static_cast<double>(dance_.poses.size() - 1) / dance_.frames_per_second;
        for (std::size_t number = 0;; ++number) {
            const double time = static_cast<double>(number) / errors_.rate;
            const double at = clock_.capture_time(time);
            if (at > seconds) {
                return film;
            }
            if (at >= 0.0) {
                film.pictures.push_back(look(number, time, at));
            }
        }
    }

 private:
    [[nodiscard]] std::vector<glm::dvec3> places_at(double at) const {
        const double frame = at * dance_.frames_per_second;
        const auto before = static_cast<std::size_t>(frame);
        const std::size_t after = std::min(before + 1, dance_.poses.size() - 1);
        const auto one = marker_places(
            markers_, dance_.skeleton, motion::world_pose(dance_.skeleton, dance_.poses[before]));
        const auto other = marker_places(
            markers_, dance_.skeleton, motion::world_pose(dance_.skeleton, dance_.poses[after]));
        std::vector<glm::dvec3> places;
        for (std::size_t i = 0; i < one.size(); ++i) {
            places.push_back(glm::mix(one[i], other[i], frame - static_cast<double>(before)));
        }
        return places;
    }

    KeypointPicture look(std::size_t number, double time, double at) {
        KeypointPicture picture;
        picture.number = number;
        picture.time = time;
        picture.score = 1.0;
        const auto places = places_at(at);
        const auto is_within = [&](const std::optional<std::pair<double, double>>& stretch) {
            return stretch && at >= stretch->first && at < stretch->second;
        };
        const bool is_exchanged = index_ == 0 && is_within(errors_.exchanged);
        // Somebody else, who walks by.
        const glm::dvec3 away = index_ == 1 && is_within(errors_.stranger)
                                    ? glm::dvec3(0.3 * (at - errors_.stranger->first), 0.0, 0.9)
                                    : glm::dvec3();
        constexpr double kSlow = 0.9;  // of the last picture's error stays
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double half = errors_.pixels / std::sqrt(2.0);
            const double fresh = half * std::sqrt(1.0 - kSlow * kSlow);
            slow_[i] = kSlow * slow_[i] + glm::dvec2(dice_.normal(fresh), dice_.normal(fresh));
            const glm::dvec2 noise(dice_.normal(half), dice_.normal(half));
            const bool is_dropped = dice_.chance(errors_.drop);
            const auto pixel = project(camera_, places[i] + away);
            if (!pixel) {
                continue;
            }
            const BodyPoint point = followed_points()[i];
            picture[is_exchanged ? other_side(point) : point] = {
                *pixel + slow_[i] + noise, is_dropped ? 0.2 : dice_.uniform(0.8, 1.0)};
        }
        return picture;
    }

    const SceneDance& dance_;
    const Camera& camera_;
    std::size_t index_;
    const Clock& clock_;
    const NetworkErrors& errors_;
    Dice dice_;
    MarkerSet markers_;
    std::vector<glm::dvec2> slow_;
};

}  // namespace

SceneDance written_dance(const std::string& file, std::size_t figure, double seconds, double size) {
    SceneDance dance;
    BodySize body;
    body.whole = size;
    dance.skeleton = skeleton_of(body);
    const auto written =
        motion::load_authored_dance(std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" /
                                    "choreography" / (file + ".toml"));
    EXPECT_TRUE(written) << written.error().message;
    motion::EvaluationOptions options;
    options.written = options.tempo = written->written;
    options.repeats = 60;
    dance.poses = motion::evaluate_figure(written->figures[figure], dance.skeleton, options).poses;
    const auto frames = static_cast<std::size_t>(60.0 * seconds);
    dance.poses.resize(std::min(frames, dance.poses.size()));
    return dance;
}

std::optional<SceneDance> dance_of(const std::filesystem::path& bvh, double seconds) {
    const auto clip = motion::read_skeleton_motion(bvh, {.frames_per_second = 60.0});
    if (!clip) {
        return std::nullopt;
    }
    SceneDance dance;
    dance.skeleton = motion::mannequin_skeleton();
    const auto retargeted = motion::retarget(*clip, dance.skeleton);
    if (!retargeted) {
        return std::nullopt;
    }
    dance.poses = retargeted->poses;
    const auto frames = static_cast<std::size_t>(60.0 * seconds);
    dance.poses.resize(std::min(frames, dance.poses.size()));
    return dance;
}

Rig ring(const std::vector<double>& angles, double distance, double focal, int size) {
    Rig rig;
    for (const double angle : angles) {
        Lens lens;
        lens.width = lens.height = size;
        lens.fx = lens.fy = focal;
        lens.cx = lens.cy = 0.5 * (size - 1);
        const double a = angle * M_PI / 180.0;
        rig.cameras.push_back(looking_at("camera" + std::to_string(rig.cameras.size() + 1),
                                         lens,
                                         {distance * std::sin(a), 1.3, distance * std::cos(a)},
                                         {0.0, 0.95, 0.0}));
    }
    return rig;
}

std::vector<KeypointFilm> filmed(const SceneDance& dance,
                                 const Rig& rig,
                                 const std::vector<Clock>& clocks,
                                 const NetworkErrors& errors) {
    std::vector<KeypointFilm> films;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
        films.push_back(Network(dance, rig, camera, clocks[camera], errors).film());
    }
    return films;
}

std::vector<Clock> true_clocks(const Rig& rig) {
    std::vector<Clock> clocks;
    for (const Camera& camera : rig.cameras) {
        clocks.push_back({camera.name, 0.0, 0.0, 1.0});
    }
    return clocks;
}

}  // namespace raks::capture::test
