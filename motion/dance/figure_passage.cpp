#include "motion/dance/figure_passage.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/arm_directions.hpp"
#include "motion/dance/contact_windows.hpp"
#include "motion/dance/trajectory.hpp"
#include "motion/figures/figure_trainer.hpp"
#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

// Poses between the model's samples: then a pose every few ms needs no more than a straight line.
constexpr int kFiner = 2;
// Danced beyond both ends while the feet are planted, so that those know what comes.
constexpr int kAround = 2;        // beats
constexpr float kAside = 0.035F;  // metres, deviation of a step's place between repeats

/// One figure and `kAround` beats of itself before and after, feet free.
struct Stretch {
    int samples_per_beat = 48;
    std::vector<Pose> poses;
    std::array<std::vector<PlannedContact>, 2> contacts;
};

std::vector<Pose> free_poses(const FigureModel& model,
                             const FigureTracks& tracks,
                             const FigureWay& way,
                             const Skeleton& skeleton) {
    const double scale = static_cast<double>(skeleton.hips_height()) / model.source_hips_height;
    const int samples_per_beat = model.samples_per_beat * kFiner;
    FigureTracks fine;
    for (std::size_t part = 0; part < fine.size(); ++part) {
        fine[part] = upsampled(tracks[part], kFiner);
    }
    const NetMotion net{way.move.offset / scale, M_PI * way.half_turns};
    const FeatureTrack& root = root_of(model, fine);
    std::vector<RootPlace> places = integrate_root(root, samples_per_beat, {}, scale, net);
    const auto rows = static_cast<std::ptrdiff_t>(root.rows());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double half_way = std::sin(M_PI * static_cast<double>(i) / static_cast<double>(rows));
        places[i].position += half_way * half_way * way.aside;
    }
    std::vector<Pose> poses;
    const std::ptrdiff_t around = kAround * samples_per_beat;
    for (std::ptrdiff_t i = -around; i < rows + around; ++i) {
        const FloorMove move = i < 0 ? inverse(way.move) : i >= rows ? way.move : FloorMove{};
        const auto row = static_cast<std::size_t>((i + rows) % rows);
        poses.push_back(move(pose_of_features(model, fine, row, places[row], scale, skeleton)));
    }
    return poses;
}

/// The faster toe tip at its fastest, at the learnt tempo, before feet are planted; metres a
/// second.
double peak_toe_speed(const FigureModel& model,
                      const FigureTracks& tracks,
                      const Skeleton& skeleton) {
    const FigureWay way{0, {0.0, model.net_displacement}};
    const std::vector<Pose> poses = free_poses(model, tracks, way, skeleton);
    const double samples_per_beat = static_cast<double>(model.samples_per_beat) * kFiner;
    std::vector<std::array<SourceFoot, 2>> feet;
    for (const Pose& pose : poses) {
        const WorldPose world = world_pose(skeleton, pose);
        std::array<SourceFoot, 2> both;
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            both[s].ankle = glm::dvec3(world.position(on_side(Bone::left_foot, side)));
            both[s].toe_tip = glm::dvec3(foot_point(world, side, skeleton.toe_tip));
        }
        feet.push_back(both);
    }
    double peak = 0.0;
    const double rate = samples_per_beat * model.learnt_tempo.beats_per_second();
    for (const Side side : kSides) {
        const std::vector<double> speeds =
            toe_speed(feet, side, rate, FootRules{}.contact_low_pass_hz);
        // Not where the figure joins itself.
        const auto around = static_cast<std::ptrdiff_t>(kAround * samples_per_beat);
        peak = std::max(peak, *std::max_element(speeds.begin() + around, speeds.end() - around));
    }
    return peak;
}

/// The contact of a foot that lies nearest to the figure's start; `size`: none near it.
std::size_t contact_at_start(const std::vector<ContactWindow>& windows,
                             double samples_per_beat,
                             std::size_t samples) {
    std::size_t best = windows.size();
    double most = 0.0;
    for (std::size_t w = 0; w < windows.size(); ++w) {
        double shared = 0.0;  // samples of it within the margin around the start
        for (std::size_t k = 0; k < windows[w].length; ++k) {
            const double at = static_cast<double>((windows[w].first + k) % samples);
            const double away = std::min(at, static_cast<double>(samples) - at);
            shared += away < FigurePassage::kMargin * samples_per_beat ? 1.0 : 0.0;
        }
        if (shared > most) {
            most = shared;
            best = w;
        }
    }
    return best;
}

/// The figure's contacts, also those of the beats around it.
std::vector<PlannedContact> contacts_of(const FigureModel& model,
                                        Side side,
                                        const FigureWay& way,
                                        const std::optional<glm::vec2>& start_place,
                                        int samples_per_beat) {
    const auto s = static_cast<std::size_t>(side);
    const auto samples = static_cast<std::size_t>(model.beats * samples_per_beat);
    const std::vector<ContactWindow> windows =
        start_at_landings(contact_windows(model.contact[s], model.beats, samples),
                          model.landings[s],
                          samples_per_beat,
                          samples);
    const std::size_t at_start = contact_at_start(windows, samples_per_beat, samples);
    const auto whole = static_cast<std::ptrdiff_t>(samples);
    const std::ptrdiff_t around = kAround * samples_per_beat;
    std::vector<PlannedContact> planned;
    if (!windows.empty() && windows.front().length == samples) {  // it never leaves the floor
        planned.push_back({{0, samples + 2 * static_cast<std::size_t>(around)}, start_place, {}});
        return planned;
    }
    for (int turn = -2; turn <= 1; ++turn) {
        for (std::size_t w = 0; w < windows.size(); ++w) {
            const auto first = static_cast<std::ptrdiff_t>(windows[w].first) + turn * whole;
            const std::ptrdiff_t end = first + static_cast<std::ptrdiff_t>(windows[w].length);
            const std::ptrdiff_t from = std::max(first, -around);
            const std::ptrdiff_t to = std::min(end, whole + around);
            if (to - from < samples_per_beat / 4) {
                continue;
            }
            PlannedContact contact{
                {static_cast<std::size_t>(from + around), static_cast<std::size_t>(to - from)},
                std::nullopt};
            const std::ptrdiff_t centre = (first + end) / 2;
            if (w == at_start && start_place) {
                if (std::abs(centre) < whole / 2) {
                    contact.place = *start_place;
                } else if (std::abs(centre - whole) < whole / 2) {
                    contact.place = glm::vec2(way.move(glm::dvec2(*start_place)));
                }
            }
            planned.push_back(contact);
        }
    }
    std::sort(planned.begin(), planned.end(), [](const auto& a, const auto& b) {
        return a.window.first < b.window.first;
    });
    return planned;
}

Stretch free_stretch(const FigureModel& model,
                     const FigureTracks& tracks,
                     const FigureWay& way,
                     const StartPlaces& places,
                     const Skeleton& skeleton) {
    Stretch stretch;
    stretch.samples_per_beat = model.samples_per_beat * kFiner;
    stretch.poses = free_poses(model, tracks, way, skeleton);
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        stretch.contacts[s] = contacts_of(model, side, way, places[s], stretch.samples_per_beat);
    }
    return stretch;
}

/// Steps of one repeat do not fall where those of the last did.
void step_aside(const CounterRandom& random, Side side, std::vector<PlannedContact>& contacts) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        if (!contacts[c].place) {
            const std::uint64_t draw = 4 * c + 2 * static_cast<std::uint64_t>(side);
            contacts[c].aside = {kAside * static_cast<float>(random.normal(draw)),
                                 kAside * static_cast<float>(random.normal(draw + 1))};
        }
    }
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
            // Arms follow the hold, not the count: their speed is no measure.
            restore_variance(part,
                             part.part == Part::upper ? 1.0 : amount,
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

StartPlaces learnt_places(const FigureModel& model,
                          const FigureTracks& tracks,
                          const FigureWay& way,
                          const Skeleton& skeleton) {
    const Stretch stretch = free_stretch(model, tracks, way, {}, skeleton);
    StartPlaces places;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const std::ptrdiff_t start = kAround * stretch.samples_per_beat;
        const auto margin =
            static_cast<std::ptrdiff_t>(FigurePassage::kMargin * stretch.samples_per_beat);
        glm::vec2 sum{};
        float count = 0.0F;
        for (const PlannedContact& contact : stretch.contacts[s]) {
            for (std::size_t k = 0; k < contact.window.length; ++k) {
                const auto i = static_cast<std::ptrdiff_t>(contact.window.first + k);
                if (std::abs(i - start) > margin) {
                    continue;
                }
                const WorldPose world =
                    world_pose(skeleton, stretch.poses[static_cast<std::size_t>(i)]);
                const glm::vec3 ball = foot_point(world, side, skeleton.ball);
                sum += glm::vec2(ball.x, ball.z);
                count += 1.0F;
            }
        }
        if (count > 0.0F) {
            places[s] = sum / count;
        }
    }
    return places;
}

FigurePassage::FigurePassage(const FigureModel& model,
                             const FigureTracks& steps,
                             const FigureTracks& tracks,
                             const FigureWay& way,
                             const StartPlaces& places,
                             const CounterRandom* random,
                             const Skeleton& skeleton) {
    Stretch stretch = free_stretch(model, steps, way, places, skeleton);
    const std::vector<Pose> stepping = stretch.poses;
    if (random != nullptr) {
        stretch.poses = free_poses(model, tracks, way, skeleton);
        for (const Side side : kSides) {
            step_aside(*random, side, stretch.contacts[static_cast<std::size_t>(side)]);
        }
    }
    lock_feet(skeleton, stretch.contacts, stretch.samples_per_beat, stepping, stretch.poses);
    keep(stretch.poses, stretch.samples_per_beat);
}

FigurePassage::FigurePassage(const FigureModel& model,
                             const FigureTracks& tracks,
                             const FigureWay& way,
                             const Skeleton& skeleton) {
    keep(free_poses(model, tracks, way, skeleton), model.samples_per_beat * kFiner);
}

void FigurePassage::keep(const std::vector<Pose>& poses, int samples_per_beat) {
    samples_per_beat_ = samples_per_beat;
    const auto skipped = static_cast<std::size_t>((kAround - kMargin) * samples_per_beat);
    for (std::size_t i = skipped; i < poses.size() - skipped + 1; ++i) {
        const Pose& pose = poses[i];
        Sample sample;
        for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
            sample.rotations[bone] = pose.rotation(kBones[bone]);
        }
        sample.hips = pose.hips_position;
        sample.contact = pose.foot_contact;
        samples_.push_back(sample);
    }
}

FigurePassage::Place FigurePassage::place_of(double beat) const noexcept {
    const double last = static_cast<double>(samples_.size() - 1);
    const double at = std::clamp((beat + kMargin) * samples_per_beat_, 0.0, last);
    const auto i = std::min(static_cast<std::size_t>(at), samples_.size() - 2);
    return {samples_[i], samples_[i + 1], static_cast<float>(at - static_cast<double>(i))};
}

void FigurePassage::at(double beat, Pose& pose) const noexcept {
    const Place place = place_of(beat);
    for (std::size_t bone = 0; bone < kBones.size(); ++bone) {
        pose.rotation(kBones[bone]) =
            interpolate(place.before.rotations[bone], place.after.rotations[bone], place.share);
    }
    pose.hips_position = glm::mix(place.before.hips, place.after.hips, place.share);
    pose.foot_contact = place.share < 0.5F ? place.before.contact : place.after.contact;
}

void FigurePassage::arms_at(double beat, Pose& pose) const noexcept {
    const Place place = place_of(beat);
    for (std::size_t bone = kBones.size() - kArmBones; bone < kBones.size(); ++bone) {
        pose.rotation(kBones[bone]) =
            interpolate(place.before.rotations[bone], place.after.rotations[bone], place.share);
    }
}

}  // namespace raks::motion
