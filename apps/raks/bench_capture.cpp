// `raks bench capture`: how quickly a body is followed by its angles.
#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "apps/raks/bench.hpp"
#include "base/random.hpp"
#include "motion/capture/angles/angle_tracker.hpp"
#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/studio/point_studio.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::apps {
namespace {

using motion::Bone;

constexpr double kDanced = 10.0;         // seconds that are followed
constexpr double kPoseRate = 60.0;       // of the dance
constexpr double kWeighed = 2.0;         // seconds of the processor that postures are weighed
constexpr std::size_t kPostures = 4096;  // at once

// Somebody who steps, turns and swings the arms, at the speed of a quick salsa.
std::vector<motion::Pose> bench_dance() {
    std::vector<motion::Pose> poses;
    for (int i = 0; i < static_cast<int>(kDanced * kPoseRate); ++i) {
        const auto at = static_cast<float>(i / kPoseRate);
        const float step = 9.7F * at;  // radians: 185 BPM, two beats a turn of the phase
        const auto about = [](float angle, glm::vec3 axis) { return glm::angleAxis(angle, axis); };
        motion::Pose pose;
        pose.hips_position = {0.2F * std::sin(0.5F * step), 0.9F, 0.15F * std::cos(0.5F * step)};
        pose.rotation(Bone::hips) = about(0.8F * at, {0, 1, 0});
        for (const motion::Side side : motion::kSides) {
            const float out = side == motion::Side::left ? 1.0F : -1.0F;
            const float swing = out * std::sin(step);
            const auto bone = [side](Bone left) { return motion::on_side(left, side); };
            pose.rotation(bone(Bone::left_upper_arm)) =
                about(out * -1.0F, {0, 0, 1}) * about(0.3F * swing, {0, 1, 0});
            pose.rotation(bone(Bone::left_lower_arm)) =
                about(-out * (0.9F + 0.3F * swing), {0, 1, 0});
            pose.rotation(bone(Bone::left_upper_leg)) = about(-0.3F + 0.25F * swing, {1, 0, 0});
            pose.rotation(bone(Bone::left_lower_leg)) = about(0.4F - 0.25F * swing, {1, 0, 0});
        }
        poses.push_back(pose);
    }
    return poses;
}

/// A dance that six cameras filmed: 18 markers of five colours, six false spots in each picture.
struct BenchTake {
    BenchTake() {
        std::erase_if(markers.markers, [](const capture::Marker& marker) {
            return marker.name.find("toe") != std::string::npos;
        });
        capture::StudioOptions options;
        options.clutter = 6;
        take = capture::film_points(
            {motion::mannequin_skeleton(), poses, kPoseRate}, rig, markers, options);
    }

    std::vector<motion::Pose> poses = bench_dance();
    capture::Rig rig = capture::studio_rig();
    capture::MarkerSet markers = capture::default_markers();
    capture::StudioTake take;
    capture::BodyModel model{capture::BodyKind::paper};
};

// The spots of the first picture of every camera.
std::vector<capture::SeenSpot> first_spots(const BenchTake& bench) {
    const std::vector<std::string> colours = bench.markers.colours();
    std::vector<capture::SeenSpot> spots;
    for (const capture::SeenFilm& film : bench.take.seen.films) {
        const std::size_t camera = *bench.rig.index_of(film.camera);
        for (const capture::Detection& spot : film.pictures.front().detections) {
            const auto colour =
                std::find(colours.begin(), colours.end(), bench.take.seen.colours[spot.colour]);
            spots.push_back({camera,
                             static_cast<std::size_t>(colour - colours.begin()),
                             spot.pixel,
                             capture::direction_of(bench.rig.cameras[camera].lens, spot.pixel)});
        }
    }
    return spots;
}

// Whole postures that are weighed in a second of one core.
double evaluations_a_second(const BenchTake& bench, capture::Likelihood likelihood) {
    const capture::BodyShape shape = capture::shape_of({}, bench.markers);
    std::vector<motion::Bone> bones;
    for (const capture::Marker& marker : bench.markers.markers) {
        bones.push_back(marker.bone);
    }
    const capture::BodyLinks links = capture::links_of(bench.model, shape, bones);
    const capture::BodyDivision division = capture::divide(bench.model, links, bones);
    const std::vector<capture::SeenSpot> spots = first_spots(bench);
    const std::vector<std::size_t> classes = bench.markers.classes();
    const capture::FrameMarks marks(bench.rig, spots, classes, std::vector<bool>(bones.size()), {});
    const capture::BodyState reference = bench.model.usual_state(shape);
    constexpr double kBound = 12.0;  // pixels, as the filter has it
    const capture::PostureWeigher weigher(bench.model, links, marks, reference, likelihood, kBound);
    capture::PostureChanges changes(bench.model.variables(), kPostures);
    const CounterRandom random(1, 62);
    for (std::size_t i = 0; i < changes.values.size(); ++i) {
        changes.values[i] = static_cast<float>(0.05 * random.normal(i));
    }
    std::vector<float> costs(kPostures);
    double weighed = 0.0;
    const double start = thread_cpu_seconds();
    double taken = 0.0;
    while (taken < kWeighed) {
        for (std::size_t first = 0; first < kPostures; first += capture::kPostureBlock) {
            weigher.weigh(division.whole, changes, first, costs.data() + first);
        }
        weighed += static_cast<double>(kPostures);
        taken = thread_cpu_seconds() - start;
    }
    return weighed / taken;
}

}  // namespace

Expected<BenchReport> bench_capture() {
    const BenchTake bench;
    BenchReport report;
    report.notes.emplace_back(
        "scene", "6 cameras, 18 markers of 5 colours, 6 false spots a picture; the paper's body");
    report.values.emplace_back("evaluations_per_cpu_s",
                               evaluations_a_second(bench, capture::Likelihood::reprojection));
    report.values.emplace_back("epipolar_evaluations_per_cpu_s",
                               evaluations_a_second(bench, capture::Likelihood::epipolar));
    capture::AngleTrackerOptions angles;
    angles.body = bench.model;
    angles.fits_body = false;
    angles.filter.threads = static_cast<int>(std::thread::hardware_concurrency());
    capture::TrackerOptions options;
    options.frames_per_second = bench.take.truth.frames_per_second;
    options.first_time = 0.0;
    options.check_order = false;
    const double cpu_start = process_cpu_seconds();
    const HostTime start = HostClock::now();
    const auto followed = capture::track_angles(
        {bench.rig, bench.markers, bench.take.seen, bench.take.clocks, bench.take.labels, {}},
        options,
        angles);
    if (!followed) {
        return fail(followed.error());
    }
    const double seconds = to_seconds(HostClock::now() - start);
    const double cpu = process_cpu_seconds() - cpu_start;
    const auto frames = static_cast<double>(followed->angles.states.size());
    report.values.emplace_back("threads", static_cast<double>(angles.filter.threads));
    report.values.emplace_back("frames_per_s", frames / seconds);
    report.values.emplace_back("frames_per_cpu_s", frames / cpu);
    return report;
}

}  // namespace raks::apps
