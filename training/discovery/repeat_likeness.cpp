#include "training/discovery/repeat_likeness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/figures/motion_features.hpp"
#include "training/figures/repeat_features.hpp"

namespace raks::motion {
namespace {

constexpr double kSameTurn = M_PI / 3.0;  // radians

constexpr std::array kJoints = {Bone::left_foot,
                                Bone::right_foot,
                                Bone::left_lower_leg,
                                Bone::right_lower_leg,
                                Bone::chest,
                                Bone::head,
                                Bone::left_lower_arm,
                                Bone::right_lower_arm,
                                Bone::left_hand,
                                Bone::right_hand};

using Shape =
    std::array<glm::dvec3, kJoints.size()>;  // places seen from the hips, in their heading
using Shapes = std::array<Shape, kRepeatPhases>;

Shape shape_of(const Pose& pose) {
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    const double heading = heading_of(glm::dquat(pose.rotation(Bone::hips)));
    const glm::dquat back = glm::angleAxis(-heading, glm::dvec3(0.0, 1.0, 0.0));
    Shape shape;
    for (std::size_t j = 0; j < kJoints.size(); ++j) {
        shape[j] = back * glm::dvec3(world.position(kJoints[j]) - pose.hips_position);
    }
    return shape;
}

double square_between(const Shape& a, const Shape& b) {
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
        const glm::dvec3 d = a[j] - b[j];
        sum += glm::dot(d, d);
    }
    return sum;
}

Shapes shapes_of(const TrainingClip& clip, const RepeatSpan& repeat) {
    Shapes shapes;
    for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
        const double share = (static_cast<double>(phase) + 0.5) / kRepeatPhases;
        shapes[phase] = shape_of(pose_between(clip.poses, repeat.start + share * repeat.length));
    }
    return shapes;
}

/// Mean square between all phases of the repeats: what two random moments differ by.
double square_by_chance(const std::vector<Shapes>& repeats) {
    // The mean over all pairs is twice the mean square about the mean.
    Shape mean{};
    const double n = static_cast<double>(repeats.size() * kRepeatPhases);
    for (const Shapes& shapes : repeats) {
        for (const Shape& shape : shapes) {
            for (std::size_t j = 0; j < shape.size(); ++j) {
                mean[j] += shape[j] / n;
            }
        }
    }
    double sum = 0.0;
    for (const Shapes& shapes : repeats) {
        for (const Shape& shape : shapes) {
            sum += square_between(shape, mean) / n;
        }
    }
    return 2.0 * sum;
}

double square_between(const Shapes& a, const Shapes& b) {
    double sum = 0.0;
    for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
        sum += square_between(a[phase], b[phase]) / kRepeatPhases;
    }
    return sum;
}

/// How far the hips turn, radians.
double turn_of_span(const TrainingClip& clip, const RepeatSpan& repeat) {
    FigureRepeat figure;
    figure.beat_frames = {std::max(0.0, repeat.start), repeat.end()};
    return turn_of(clip, figure);
}

}  // namespace

RepeatLikeness compare_repeats(std::span<const ClipRepeat> repeats) {
    std::vector<Shapes> shapes;
    std::vector<double> turns;
    for (const ClipRepeat& repeat : repeats) {
        shapes.push_back(shapes_of(*repeat.clip, repeat.frames));
        turns.push_back(turn_of_span(*repeat.clip, repeat.frames));
    }
    const double chance = std::max(square_by_chance(shapes), 1e-9);
    const std::size_t n = repeats.size();
    std::vector<double> distances(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double d = std::sqrt(square_between(shapes[i], shapes[j]) / chance);
            distances[i * n + j] = distances[j * n + i] = d;
        }
    }
    const auto is_alike = [&](std::size_t i, std::size_t j) {
        return repeats[i].beats == repeats[j].beats && distances[i * n + j] < kAlikeDistance &&
               std::abs(turns[i] - turns[j]) < kSameTurn;
    };
    RepeatLikeness likeness;
    std::size_t most = 0;
    double nearest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t count = 0;
        double sum = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
            count += is_alike(i, j) ? std::size_t{1} : std::size_t{0};
            sum += is_alike(i, j) ? distances[i * n + j] : 0.0;
        }
        if (count > most || (count == most && sum < nearest)) {
            most = count;
            nearest = sum;
            likeness.commonest = i;
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        likeness.distance.push_back(distances[likeness.commonest * n + i]);
        likeness.is_alike.push_back(is_alike(likeness.commonest, i));
    }
    return likeness;
}

}  // namespace raks::motion
