#include "training/figures/authored_training.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "motion/choreography/figure_check.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/repeat_plan.hpp"
#include "motion/choreography/splines.hpp"

namespace raks::motion {
namespace {

// Beats evaluated before and after what is learnt, so that the ends have neighbouring samples.
constexpr double kMargin = 1.5;
constexpr double kFramesPerSecond = 120.0;  // quick movements keep their amplitude

// Poses and world positions of both feet, as a captured clip would give them. The clip has no
// faults.
TrainingClip clip_of(const EvaluatedFigure& evaluated, const Skeleton& skeleton, std::string name) {
    TrainingClip clip;
    clip.name = std::move(name);
    clip.frames_per_second = evaluated.frames_per_second;
    clip.poses = evaluated.poses;
    clip.hips_height = static_cast<double>(skeleton.hips_height());
    for (const Pose& pose : evaluated.poses) {
        const WorldPose world = world_body(skeleton, pose);
        std::array<SourceFoot, 2>& feet = clip.feet.emplace_back();
        for (const Side side : kSides) {
            feet[static_cast<std::size_t>(side)] = {
                glm::dvec3(world.position(on_side(Bone::left_foot, side))),
                glm::dvec3(toe_tip(skeleton, world, side))};
        }
    }
    return clip;
}

/// Joints that figures of captured motion do not learn, by Part.
std::array<std::vector<Bone>, 3> whole_body() {
    std::array<std::vector<Bone>, 3> more;
    more[static_cast<std::size_t>(Part::torso)] = {Bone::upper_chest, Bone::head};
    more[static_cast<std::size_t>(Part::upper)] = {Bone::left_hand, Bone::right_hand};
    return more;
}

/// The shortest period of anything that a figure moves, beats: waves by their period, keys by the
/// time of a move there and back.
double quickest(const AuthoredFigure& figure) noexcept {
    double shortest = figure.beats;
    for (const std::vector<Track>& tracks : figure.body) {
        for (const Track& track : tracks) {
            if (!track.has_keys() && track.wave != 0.0) {
                shortest = std::min(shortest, track.every);
            }
            for (std::size_t k = 1; k < track.keys.size(); ++k) {
                // There and back again takes two gaps; the share `snap` of each gap is spent still.
                const double gap = track.keys[k].beat - track.keys[k - 1].beat;
                shortest = std::min(shortest, 2.0 * gap * (1.0 - track.snap));
            }
        }
    }
    return shortest;
}

/// Rounds to so many significant digits. Goes through the decimal text, so that the shortest text
/// that reads back to the same double has no more digits than that.
void round_off(std::vector<double>& values, int digits) {
    for (double& value : values) {
        value = std::stod(fmt::format("{:.{}e}", value, digits - 1));
    }
}

/// Rounds what the model's file holds: a tenth of a millimetre or a hundredth of a degree is
/// precise enough for a mean, one percent for a variance.
void round_off(FigureModel& model) {
    constexpr int kMean = 5;
    constexpr int kSpread = 3;
    for (PartModel& part : model.parts) {
        for (FigureState& state : part.states) {
            round_off(state.mean, kMean);
            round_off(state.delta_mean, kMean - 1);
            round_off(state.delta_delta_mean, kMean - 1);
            round_off(state.variance, kSpread);
            round_off(state.delta_variance, kSpread);
            round_off(state.delta_delta_variance, kSpread);
        }
        for (std::vector<double>& row : part.covariance) {
            round_off(row, kMean);
        }
        round_off(part.global_variance, kMean);
    }
    for (auto& chances : model.contact) {
        for (double& chance : chances) {
            constexpr double kHundredth = 100.0;
            chance = std::round(kHundredth * chance) / kHundredth;
        }
    }
}

/// How far each hand is closed over one repetition (0 open, 1 a fist), kContactBins values over its
/// phase, without noise. Fingers are not joints of a figure: the player looks them up by phase.
std::array<std::vector<double>, 2> fists_of(const AuthoredDance& dance,
                                            const AuthoredFigure& figure) {
    constexpr double kStill = 0.02;  // a smaller range counts as no movement
    EvaluationOptions how;
    how.written = how.tempo = dance.written;
    how.repeats = figure.is_mirrored ? 2 : 1;
    how.margin = 0.0;
    how.noise = 0.0;
    const RepeatPlan plan = plan_repeats(figure, how);
    const double beats = static_cast<double>(how.repeats) * figure.beats;
    std::array<std::vector<double>, 2> fists;
    for (const Side side : kSides) {
        const std::vector<double> values =
            control_values(plan, on_side(Control::left_hand_fist, side));
        std::vector<double>& fist = fists[static_cast<std::size_t>(side)];
        // The value in the middle of each bin of the phase, rounded to hundredths.
        for (std::size_t bin = 0; bin < kContactBins; ++bin) {
            const double beat = (static_cast<double>(bin) + 0.5) * beats / kContactBins;
            const double value = value_at(values, plan.frames_of(beat));
            fist.push_back(std::clamp(std::round(100.0 * value) / 100.0, 0.0, 1.0));
        }
        // A fist that hardly changes is stored as one number.
        const auto [least, most] = std::minmax_element(fist.begin(), fist.end());
        if (*most - *least < kStill) {
            fist.resize(1);
        }
    }
    return fists;
}

/// Exponents of size by tempo, as the evaluation has them: waves and steps scale with the tempo,
/// keys do not. Arms with keys keep their size, because their hands have to reach a place, such as
/// the other hand.
SizeByTempo size_by_tempo_of(const AuthoredFigure& figure) noexcept {
    SizeByTempo size{figure.style.tempo_scale, figure.style.tempo_scale};
    for (std::size_t c = 0; c < kControlCount; ++c) {
        const ControlGroup group = info_of(static_cast<Control>(c)).group;
        const std::vector<Track>& tracks = figure.body[c];
        const bool has_keys = std::any_of(
            tracks.begin(), tracks.end(), [](const Track& one) { return one.has_keys(); });
        if (has_keys && (group == ControlGroup::arm || group == ControlGroup::elbow)) {
            size.arms = 0.0;
        }
    }
    return size;
}

}  // namespace

AuthoredMaterial authored_material(const AuthoredDance& dance,
                                   const AuthoredFigure& figure,
                                   const Skeleton& skeleton,
                                   const AuthoredTrainingOptions& options) {
    const int sides = figure.is_mirrored ? 2 : 1;
    AuthoredMaterial material;
    material.beats = sides * figure.beats;
    for (int take = 0; take < options.takes; ++take) {
        // Each take has a seed of its own, so takes differ, and `seed` moves all of them.
        EvaluationOptions how;
        how.written = how.tempo = dance.written;
        how.repeats = sides * options.repeats;
        how.margin = kMargin;
        how.frames_per_second = kFramesPerSecond;
        // So do both partners of a couple: they are no twins.
        constexpr std::uint64_t kRoles = 500;
        how.seed = options.seed * 1000 + kRoles * static_cast<std::uint64_t>(options.role) +
                   static_cast<std::uint64_t>(take);
        const EvaluatedFigure evaluated = evaluate_figure(figure, skeleton, how);
        material.clips.push_back(
            clip_of(evaluated, skeleton, fmt::format("{}, take {}", figure.name, take + 1)));
        for (int repeat = 0; repeat < options.repeats; ++repeat) {
            // The repetitions of a take follow each other without a gap: beats count through.
            FigureRepeat& one = material.repeats.emplace_back();
            one.clip = static_cast<std::size_t>(take);
            for (int beat = 0; beat <= material.beats; ++beat) {
                one.beat_frames.push_back(evaluated.frame_of(repeat * material.beats + beat));
            }
        }
    }
    return material;
}

int states_for(const AuthoredFigure& figure) noexcept {
    constexpr int kMostStates = 64;
    const double period = quickest(figure);
    // Half a wave holds at least three states at the limits, two where nothing moves quickly.
    const int a_beat = period <= 0.5 ? 12 : period <= 1.0 ? 6 : 4;
    const int sides = figure.is_mirrored ? 2 : 1;
    return std::clamp(a_beat * figure.beats * sides, 8, kMostStates);
}

Expected<AuthoredTrainingResult> train_authored_figure(const AuthoredDance& dance,
                                                       const AuthoredFigure& figure,
                                                       const Skeleton& skeleton,
                                                       const AuthoredTrainingOptions& options) {
    if (const auto faults = faults_in_motion(dance, figure, skeleton); !faults.empty()) {
        return fail(faults.front());
    }
    const AuthoredMaterial material = authored_material(dance, figure, skeleton, options);
    FigureTrainingOptions training;
    training.name = figure.name;
    training.dance = dance.dance;
    training.role = options.role;
    training.beats = material.beats;
    training.states = options.states > 0 ? options.states : states_for(figure);
    training.features = options.features;
    // A written figure defines head and hands, too; captured figures leave them out.
    if (options.features == FigureFeatures::angles) {
        training.more_joints = whole_body();
    }
    // No capture noise to remove: a cut-off at half the frame rate switches the filter off.
    training.low_pass_hz = 0.5 * kFramesPerSecond;
    auto trained = train_figure(material.clips, material.repeats, training);
    if (!trained) {
        return fail(std::move(trained.error()).in(where_in(dance, figure)));
    }
    AuthoredTrainingResult result{
        std::move(trained->model), trained->log_likelihood, material.repeats.size()};
    round_off(result.model);
    // Set after rounding: fists are rounded to hundredths already, and exponents stay as written.
    result.model.fist = fists_of(dance, figure);
    result.model.size_by_tempo = size_by_tempo_of(figure);
    return result;
}

}  // namespace raks::motion
