#include "motion/dance/baking/free_figure.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/baking/arms.hpp"
#include "motion/dance/baking/trajectory.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {
namespace {

// Poses for each sample of the model: so dense that linear interpolation between them suffices at
// run time.
constexpr int kFiner = 2;
// Low-pass bandwidths of figures of positions, cycles a beat.
constexpr double kArmBandwidth = 2.0;
constexpr double kTrunkBandwidth = 2.5;

using FeetByFrame = std::vector<std::array<SourceFoot, 2>>;

SourceFoot foot_of(const Skeleton& skeleton, const WorldPose& world, Side side) {
    return {glm::dvec3(world.position(on_side(Bone::left_foot, side))),
            glm::dvec3(foot_point(world, side, skeleton.toe_tip))};
}

FeetByFrame feet_of(const std::vector<Pose>& poses, const Skeleton& skeleton) {
    FeetByFrame feet;
    for (const Pose& pose : poses) {
        const WorldPose world = world_body(skeleton, pose);
        std::array<SourceFoot, 2>& both = feet.emplace_back();
        for (const Side side : kSides) {
            both[static_cast<std::size_t>(side)] = foot_of(skeleton, world, side);
        }
    }
    return feet;
}

/// Poses a second at the learnt tempo.
double rate_of(const FigureModel& model) {
    return static_cast<double>(model.samples_per_beat) * kFiner *
           model.learnt_tempo.beats_per_second();
}

/// Peak speed of the faster toe tip at the learnt tempo, feet not planted; metres a second.
/// Compared with FigureModel::peak_toe_speed, so it is filtered alike.
double peak_toe_speed(const FigureModel& model,
                      const FigureTracks& tracks,
                      const Skeleton& skeleton) {
    const FigurePath way{.move = {0.0, model.net_displacement}};
    const std::vector<Pose> poses = free_poses(model, tracks, way, skeleton);
    const double samples_per_beat = static_cast<double>(model.samples_per_beat) * kFiner;
    const FeetByFrame feet = feet_of(poses, skeleton);
    double peak = 0.0;
    const double rate = rate_of(model);
    for (const Side side : kSides) {
        const std::vector<double> speeds =
            toe_speed(feet, side, rate, FootRules{}.contact_low_pass_hz);
        // The ends are left out: there the figure joins a copy of itself.
        const auto around = static_cast<std::ptrdiff_t>(kBeatsAround * samples_per_beat);
        peak = std::max(peak, *std::max_element(speeds.begin() + around, speeds.end() - around));
    }
    return peak;
}

}  // namespace

std::vector<Pose> free_poses(const FigureModel& model,
                             const FigureTracks& tracks,
                             const FigurePath& way,
                             const Skeleton& skeleton) {
    const double scale = static_cast<double>(skeleton.hips_height()) / model.source_hips_height;
    const int samples_per_beat = model.samples_per_beat * kFiner;
    FigureTracks fine;
    for (std::size_t part = 0; part < fine.size(); ++part) {
        fine[part] = upsampled(tracks[part], kFiner);
    }
    const NetMotion net{way.move.offset / scale, way.turn};
    const FeatureTrack& root = root_of(model, fine);
    std::vector<RootPlace> places = integrate_root(root, samples_per_beat, {}, scale, net);
    const auto rows = static_cast<std::ptrdiff_t>(root.rows());
    // sin^2 and its slope are zero at both ends, so place and speed there stay.
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double half_way = std::sin(M_PI * static_cast<double>(i) / static_cast<double>(rows));
        places[i].position += half_way * half_way * way.aside;
    }
    std::vector<Pose> poses;
    const std::ptrdiff_t around = kBeatsAround * samples_per_beat;
    // Beats around the figure are its own, moved by its way: back before the start, on after the
    // end.
    for (std::ptrdiff_t i = -around; i < rows + around; ++i) {
        const FloorMove move = i < 0 ? inverse(way.move) : i >= rows ? way.move : FloorMove{};
        const auto row = static_cast<std::size_t>((i + rows) % rows);
        poses.push_back(move(pose_of_features(model, fine, row, places[row], scale, skeleton)));
    }
    return poses;
}

namespace {

// How much of the amplitude is restored; `legs`: as the toe speed allows, which says nothing of the
// arms. In rotations people's arms differ from take to take by the hold, not by a loss of
// amplitude: the mean moves at people's speed already (salsa: 0.48 m/s about the chest, theirs
// 0.57; restored 0.64 to 0.75). Places lose length besides, and written arms hardly differ.
double share_restored(const FigureModel& model, const PartModel& part, double legs) {
    if (part.part != Part::upper) {
        return legs;
    }
    return is_captured(model) && part.features == FigureFeatures::angles ? 0.0 : 1.0;
}

}  // namespace

FigureTracks learnt_tracks(const FigureModel& model, const Skeleton& skeleton) {
    FigureTracks likely;
    for (const PartModel& part : model.parts) {
        likely[static_cast<std::size_t>(part.part)] = most_likely_trajectory(part, model.samples());
    }
    const auto widened = [&](double amount) {
        FigureTracks tracks = likely;
        for (const PartModel& part : model.parts) {
            restore_variance(part,
                             share_restored(model, part, amount),
                             tracks[static_cast<std::size_t>(part.part)]);
        }
        if (model.features == FigureFeatures::positions) {
            restore_arms(model.part(Part::upper),
                         source_body(model),
                         tracks[static_cast<std::size_t>(Part::upper)]);
        }
        return tracks;
    };
    const double scale = static_cast<double>(skeleton.hips_height()) / model.source_hips_height;
    // Bisection: the toe speed grows with the amplitude.
    double low = 0.0;
    double high = 1.0;
    constexpr int kHalvings = 5;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        const double speed = peak_toe_speed(model, widened(middle), skeleton);
        (speed < scale * model.peak_toe_speed ? low : high) = middle;
    }
    return widened(0.5 * (low + high));
}

void steady_body(const FigureModel& model, std::vector<Pose>& poses) {
    if (model.features != FigureFeatures::positions) {
        return;
    }
    const auto steady = [&](double bandwidth) {
        return filtered(poses, low_pass_taps(bandwidth, model.samples_per_beat * kFiner));
    };
    const std::vector<Pose> arms = steady(kArmBandwidth);
    const std::vector<Pose> trunk = steady(kTrunkBandwidth);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (const Bone bone :
             {Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head}) {
            poses[i].rotation(bone) = trunk[i].rotation(bone);
        }
        for (const Bone left :
             {Bone::left_shoulder, Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand}) {
            for (const Side side : kSides) {
                poses[i].rotation(on_side(left, side)) = arms[i].rotation(on_side(left, side));
            }
        }
    }
}

FreeFigure free_figure(const FigureModel& model,
                       const FigureTracks& tracks,
                       const FigurePath& way,
                       const Skeleton& skeleton) {
    FreeFigure figure;
    figure.samples_per_beat = model.samples_per_beat * kFiner;
    figure.poses = free_poses(model, tracks, way, skeleton);
    FeetByFrame seen;
    for (const Pose& pose : figure.poses) {
        const WorldPose world = world_body(skeleton, pose);
        std::array<SourceFoot, 2>& both = seen.emplace_back();
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            const Bone foot = on_side(Bone::left_foot, side);
            figure.feet[s].push_back({world.position(foot), world.rotation(foot)});
            both[s] = foot_of(skeleton, world, side);
        }
    }
    for (const Side side : kSides) {
        figure.foot_speeds[static_cast<std::size_t>(side)] =
            foot_speed(seen, side, rate_of(model), FootRules{}.landing_low_pass_hz);
    }
    return figure;
}

}  // namespace raks::motion
