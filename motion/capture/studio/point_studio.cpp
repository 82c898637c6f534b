#include "motion/capture/studio/point_studio.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "motion/capture/studio/occlusion.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// The body at one moment.
struct FilmedBody {
    std::vector<glm::dvec3> markers;
    std::vector<motion::Capsule> capsules;
};

FilmedBody body_at(const StudioMotion& motion,
                   const MarkerSet& markers,
                   double time,
                   int people = 1) {
    const motion::Pose pose = motion::pose_between(motion.poses, time * motion.frames_per_second);
    const motion::WorldPose world = motion::world_pose(motion.skeleton, pose);
    FilmedBody body{marker_places(markers, motion.skeleton, world),
                    hiding_capsules(motion.skeleton, world)};
    if (people > 1) {
        const auto others = hiding_capsules(
            motion.skeleton, motion::world_pose(motion.skeleton, passer_by(motion, time)));
        body.capsules.insert(body.capsules.end(), others.begin(), others.end());
    }
    return body;
}

bool is_seen(const FilmedBody& body, std::size_t marker, const Camera& camera) {
    const auto pixel = project(camera, body.markers[marker]);
    return pixel && is_in_picture(camera.lens, *pixel) &&
           !is_hidden(body.capsules, glm::vec3(body.markers[marker]), glm::vec3(camera.centre()));
}

/// A detection whose marker is known; none: clutter, or several in one.
struct KnownDetection {
    Detection detection;
    std::optional<std::size_t> marker;
};

/// Films with one camera.
class FilmingCamera {
 public:
    FilmingCamera(const StudioMotion& motion,
                  const Camera& camera,
                  const MarkerSet& markers,
                  const StudioOptions& options,
                  std::size_t index)
        : motion_(motion),
          camera_(camera),
          bump_(options.bump_of(index)),
          markers_(markers),
          options_(options),
          classes_(markers.classes()),
          colours_(static_cast<int>(markers.colours().size())),
          dice_(options.seed, 1 + index) {}

    /// Of the picture at `time` by the camera's own clock.
    std::vector<KnownDetection> detections_at(double time, const Clock& clock) {
        if (bump_ && time >= *bump_) {
            camera_ = bumped(camera_);
            bump_.reset();
        }
        const FilmedBody body =
            body_at(motion_, markers_, clock.capture_time(time), options_.people);
        std::vector<KnownDetection> found;
        for (std::size_t marker = 0; marker < markers_.markers.size(); ++marker) {
            if (!is_seen(body, marker, camera_) || dice_.chance(options_.drop)) {
                continue;
            }
            const glm::dvec2 pixel =
                rolled(marker, time, clock, *project(camera_, body.markers[marker])) + noise();
            const double depth = camera_.in_camera(body.markers[marker]).z;
            const double radius = camera_.lens.fx * markers_.radius / depth;
            found.push_back({{pixel, classes_[marker], kPi * radius * radius}, marker});
        }
        merge(found);
        add_clutter(body, found);
        return found;
    }

 private:
    static constexpr double kPi = 3.141592653589793;

    // Where a marker is at the moment at which its row of the picture is read.
    [[nodiscard]] glm::dvec2 rolled(std::size_t marker,
                                    double time,
                                    const Clock& clock,
                                    const glm::dvec2& pixel) const {
        if (options_.rolling_shutter <= 0.0) {
            return pixel;
        }
        const double late =
            options_.rolling_shutter * (pixel.y / (camera_.lens.height - 1.0) - 0.5);
        const FilmedBody body = body_at(motion_, markers_, clock.capture_time(time + late));
        return project(camera_, body.markers[marker]).value_or(pixel);
    }

    glm::dvec2 noise() { return {dice_.normal(options_.noise), dice_.normal(options_.noise)}; }

    // Detections of a colour that touch become one between them.
    void merge(std::vector<KnownDetection>& found) const {
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (std::size_t j = found.size(); j-- > i + 1;) {
                Detection& one = found[i].detection;
                const Detection& other = found[j].detection;
                if (one.colour == other.colour &&
                    glm::distance(one.pixel, other.pixel) < options_.merge) {
                    one.pixel = 0.5 * (one.pixel + other.pixel);
                    one.area += other.area;
                    found[i].marker.reset();
                    found.erase(found.begin() + static_cast<std::ptrdiff_t>(j));
                }
            }
        }
    }

    // Strewn over the box of the body's markers and 60 pixels around it.
    void add_clutter(const FilmedBody& body, std::vector<KnownDetection>& found) {
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const glm::dvec3& place : body.markers) {
            if (const auto pixel = project(camera_, place)) {
                low = glm::min(low, *pixel);
                high = glm::max(high, *pixel);
            }
        }
        constexpr double kAround = 60.0;
        const double around = kAround * camera_.lens.fx / 600.0;
        for (int i = 0; i < options_.clutter && low.x < high.x; ++i) {
            const glm::dvec2 pixel(dice_.uniform(low.x - around, high.x + around),
                                   dice_.uniform(low.y - around, high.y + around));
            const auto colour = static_cast<std::size_t>(dice_.whole(0, colours_ - 1));
            found.push_back({{pixel, colour, 0.0}, std::nullopt});
        }
    }

    const StudioMotion& motion_;
    Camera camera_;
    std::optional<double> bump_;
    const MarkerSet& markers_;
    const StudioOptions& options_;
    std::vector<std::size_t> classes_;
    int colours_;
    Dice dice_;
};

std::vector<Clock> draw_clocks(const Rig& rig, const StudioOptions& options) {
    Dice dice(options.seed, 0);
    std::vector<Clock> clocks;
    for (const Camera& camera : rig.cameras) {
        clocks.push_back({camera.name,
                          dice.uniform(-1.0, 1.0) * options.clock_error,
                          dice.uniform(-1.0, 1.0) * options.drift_ppm,
                          1.0});
    }
    if (options.first_clock_is_true) {
        clocks.front() = {rig.cameras.front().name, 0.0, 0.0, 1.0};
    }
    return clocks;
}

// A camera of a ring that looks at the dancer; `apart` as of studio_rig.
Camera on_circle(int index, int cameras, const Lens& lens, double apart) {
    constexpr double kTurn = 6.283185307179586;
    constexpr double kDistance = 4.0;
    const bool is_even = index % 2 == 0;
    double angle = kTurn * (index + 0.5) / cameras;
    double height = is_even ? 1.55 : 2.25;
    if (apart > 0.0) {
        angle = kTurn / 360.0 * apart * (index - 0.5 * (cameras - 1));
        height = is_even ? 1.35 : 1.5;
    }
    return looking_at("cam" + std::to_string(index + 1),
                      lens,
                      {kDistance * std::sin(angle), height, kDistance * std::cos(angle)},
                      {0.0, 0.95, 0.0});
}

Tracks true_tracks(const StudioMotion& motion,
                   const Rig& rig,
                   const MarkerSet& markers,
                   double rate) {
    Tracks tracks;
    for (const Marker& marker : markers.markers) {
        tracks.markers.push_back(marker.name);
    }
    tracks.frames_per_second = rate;
    tracks.frame_count = picture_count(motion, rate);
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        const FilmedBody body = body_at(motion, markers, static_cast<double>(frame) / rate);
        for (std::size_t marker = 0; marker < markers.markers.size(); ++marker) {
            const auto views =
                std::count_if(rig.cameras.begin(), rig.cameras.end(), [&](const Camera& camera) {
                    return is_seen(body, marker, camera);
                });
            tracks.places.push_back(
                {body.markers[marker], 0.0, static_cast<std::uint8_t>(views), PlaceSource::seen});
        }
    }
    return tracks;
}

// The picture that shows a moment of the capture best, of `count` at this rate.
std::size_t picture_at(const Clock& clock, double moment, double rate, std::size_t count) {
    const double number = std::round(clock.camera_time(moment) * rate);
    return static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(count - 1)));
}

// What a person would click: each marker in the pictures of the first moment at which two cameras
// see it, found by a detector or not.
std::vector<MarkerLabel> first_labels(const StudioMotion& motion,
                                      const Rig& rig,
                                      const MarkerSet& markers,
                                      const StudioTake& take,
                                      const StudioOptions& options) {
    Dice dice(options.seed, 1 + rig.cameras.size());
    std::vector<MarkerLabel> labels;
    std::vector<bool> is_labelled(markers.markers.size());
    const double start = common_start(take.clocks);
    for (std::size_t k = 0; k < take.truth.frame_count; ++k) {
        const double moment = start + static_cast<double>(k) / options.frames_per_second;
        std::vector<std::size_t> pictures;  // by camera
        std::vector<FilmedBody> bodies;     // by camera, at the moment of its picture
        for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
            pictures.push_back(picture_at(
                take.clocks[i], moment, options.rate_of(i), take.seen.films[i].pictures.size()));
            const double time = take.seen.films[i].pictures[pictures.back()].time;
            bodies.push_back(body_at(motion, markers, take.clocks[i].capture_time(time)));
        }
        for (std::size_t marker = 0; marker < markers.markers.size(); ++marker) {
            std::vector<std::size_t> cameras;
            for (std::size_t i = 0; i < rig.cameras.size() && !is_labelled[marker]; ++i) {
                if (is_seen(bodies[i], marker, rig.cameras[i])) {
                    cameras.push_back(i);
                }
            }
            if (cameras.size() < 2) {
                continue;
            }
            is_labelled[marker] = true;
            for (const std::size_t i : cameras) {
                const glm::dvec2 noise(dice.normal(options.noise), dice.normal(options.noise));
                labels.push_back({rig.cameras[i].name,
                                  pictures[i],
                                  markers.markers[marker].name,
                                  *project(rig.cameras[i], bodies[i].markers[marker]) + noise});
            }
        }
        if (std::find(is_labelled.begin(), is_labelled.end(), false) == is_labelled.end()) {
            break;
        }
    }
    // Noise may carry a point at the edge out of the picture.
    std::erase_if(labels, [&](const MarkerLabel& label) {
        return !is_in_picture(rig.cameras[*rig.index_of(label.camera)].lens, label.pixel);
    });
    return labels;
}

}  // namespace

std::size_t picture_count(const StudioMotion& motion, double rate) noexcept {
    const double seconds = static_cast<double>(motion.poses.size() - 1) / motion.frames_per_second;
    return static_cast<std::size_t>(std::floor(seconds * rate + 1e-9)) + 1;
}

Camera bumped(const Camera& camera) {
    constexpr double kDegree = 3.141592653589793 / 180.0;
    Camera after = camera;
    const glm::dmat3 turn = rotation_of({-kDegree, 2.0 * kDegree, 0.0});
    after.rotation = turn * camera.rotation;
    after.translation = turn * camera.translation;
    return after;
}

motion::Pose passer_by(const StudioMotion& motion, double time) {
    constexpr double kAgo = 2.0;      // seconds
    constexpr double kThere = 5.0;    // seconds from one side to the other
    constexpr double kReach = 2.0;    // metres to each side
    constexpr float kBehind = -0.9F;  // metres
    motion::Pose pose =
        motion::pose_between(motion.poses, std::max(0.0, time - kAgo) * motion.frames_per_second);
    const double phase = std::fmod(std::max(time, 0.0), 2.0 * kThere) / kThere;  // 0 to 2
    const double along = phase < 1.0 ? phase : 2.0 - phase;
    pose.hips_position.x = static_cast<float>(kReach * (2.0 * along - 1.0));
    pose.hips_position.z = kBehind;
    return pose;
}

std::vector<glm::dvec3> marker_places(const MarkerSet& markers,
                                      const motion::Skeleton& skeleton,
                                      const motion::WorldPose& world) {
    // Places are those on the mannequin; another body's are as much larger as it is.
    const float scale = skeleton.hips_height() / motion::mannequin_skeleton().hips_height();
    std::vector<glm::dvec3> places;
    places.reserve(markers.markers.size());
    for (const Marker& marker : markers.markers) {
        places.emplace_back(world.point(marker.bone, scale * glm::vec3(marker.place)));
    }
    return places;
}

StudioTake film_points(const StudioMotion& motion,
                       const Rig& rig,
                       const MarkerSet& markers,
                       const StudioOptions& options) {
    StudioTake take;
    take.seen.colours = markers.colours();
    take.clocks = draw_clocks(rig, options);
    take.truth = true_tracks(motion, rig, markers, options.frames_per_second);
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        FilmingCamera filming(motion, rig.cameras[i], markers, options, i);
        SeenFilm film{rig.cameras[i].name, {}};
        const std::size_t pictures = picture_count(motion, options.rate_of(i));
        for (std::size_t k = 0; k < pictures; ++k) {
            const double time = static_cast<double>(k) / options.rate_of(i);
            SeenPicture picture{time, {}};
            for (const KnownDetection& known : filming.detections_at(time, take.clocks[i])) {
                picture.detections.push_back(known.detection);
            }
            film.pictures.push_back(std::move(picture));
        }
        take.seen.films.push_back(std::move(film));
    }
    take.labels = first_labels(motion, rig, markers, take, options);
    return take;
}

Rig studio_rig(int cameras, int width, int height, double apart) {
    const double f = 600.0 / 640.0 * width;
    const Lens lens{width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1), {}};
    Rig rig;
    for (int i = 0; i < cameras; ++i) {
        rig.cameras.push_back(on_circle(i, cameras, lens, apart));
    }
    return rig;
}

Rig unlike_cameras_rig(int cameras, int width, int height, double apart) {
    Rig rig;
    for (int i = 0; i < cameras; ++i) {
        const double f = 950.0 / 1280.0 * width * (1.0 + 0.04 * std::sin(2.1 * i + 0.7));
        Lens lens{width, height, f, f, 0.5 * (width - 1), 0.5 * (height - 1), {}};
        lens.cx += 0.006 * width * std::sin(1.3 * i + 0.4);
        lens.cy += 0.006 * width * std::cos(2.3 * i);
        lens.distortion = {-0.09 + 0.03 * std::cos(1.7 * i),
                           0.02 * std::sin(0.9 * i + 1.0),
                           0.0006 * std::sin(3.1 * i),
                           0.0006 * std::cos(1.9 * i)};
        rig.cameras.push_back(on_circle(i, cameras, lens, apart));
    }
    return rig;
}

}  // namespace raks::capture
