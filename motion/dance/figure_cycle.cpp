#include "motion/dance/figure_cycle.hpp"

#include <cmath>

#include "motion/dance/foot_lock.hpp"
#include "motion/dance/relaxed_hands.hpp"
#include "motion/dance/trajectory.hpp"

namespace raks::motion {
namespace {

// Poses between the model's samples, so that a pose every few ms needs no more than a straight
// line.
constexpr std::size_t kFiner = 4;

/// Poses of the figure, places spread so that it closes, centred on the stage.
std::vector<Pose> closed_poses(const FigureModel& model, const Skeleton& skeleton) {
    const double scale = static_cast<double>(skeleton.hips_height()) / model.source_hips_height;
    const int samples_per_beat = model.samples_per_beat * static_cast<int>(kFiner);
    std::array<FeatureTrack, 3> tracks;
    for (const Part part : kParts) {
        FeatureTrack track = most_likely_trajectory(model.part(part), model.samples());
        restore_variance(model.part(part), track);
        tracks[static_cast<std::size_t>(part)] = upsampled(track, kFiner);
    }
    const FeatureTrack& torso = tracks[static_cast<std::size_t>(Part::torso)];
    // A net motion of zero spreads the figure's drift over it: turn first, then place.
    const std::vector<RootPlace> places =
        integrate_root(torso, samples_per_beat, RootPlace{}, scale, NetMotion{});
    glm::dvec2 centre{0.0, 0.0};
    double heading = 0.0;
    for (std::size_t i = 0; i < torso.rows(); ++i) {
        centre += places[i].position / static_cast<double>(torso.rows());
        heading += places[i].heading / static_cast<double>(torso.rows());
    }
    std::vector<Pose> poses(torso.rows());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        RootPlace place = places[i];
        // On average in the middle of the stage, facing the audience.
        const glm::dvec2 out = place.position - centre;
        place.position = {std::cos(-heading) * out.x + std::sin(-heading) * out.y,
                          -std::sin(-heading) * out.x + std::cos(-heading) * out.y};
        place.heading -= heading;
        for (const Part part : kParts) {
            apply_features(tracks[static_cast<std::size_t>(part)].row(i),
                           model.part(part),
                           place,
                           scale,
                           poses[i]);
        }
        relax_hands(poses[i]);
    }
    return poses;
}

}  // namespace

FigureCycle::FigureCycle(const FigureModel& model, const Skeleton& skeleton)
    : name_(model.name),
      beats_(model.beats),
      learnt_tempo_(model.learnt_tempo),
      poses_(closed_poses(model, skeleton)) {
    const double samples_per_beat = static_cast<double>(poses_.size()) / model.beats;
    std::array<std::vector<ContactWindow>, 2> contacts;
    for (const Side side : kSides) {
        const std::size_t s = static_cast<std::size_t>(side);
        contacts[s] =
            start_at_landings(contact_windows(model.contact[s], model.beats, poses_.size()),
                              model.landings[s],
                              samples_per_beat,
                              poses_.size());
    }
    lock_feet(skeleton, contacts, samples_per_beat, poses_);
}

Pose FigureCycle::at(Beats phase) const noexcept {
    const double turns = phase.count() / beats_;
    const double at = (turns - std::floor(turns)) * static_cast<double>(poses_.size());
    const std::size_t i = static_cast<std::size_t>(at) % poses_.size();
    return interpolate(
        poses_[i], poses_[(i + 1) % poses_.size()], static_cast<float>(at - std::floor(at)));
}

}  // namespace raks::motion
