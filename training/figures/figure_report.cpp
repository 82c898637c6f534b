#include "training/figures/figure_report.hpp"

#include <algorithm>
#include <numeric>

#include "motion/figures/figure_hmm.hpp"
#include "training/figures/repeat_features.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kShownRepeats = 4;   // realizations, as in the paper's Fig. 12
constexpr std::size_t kShownFeatures = 2;  // of each part

/// The repeats of highest weight, first one from each take, then more from takes already shown.
std::vector<std::size_t> repeats_to_show(std::span<const FigureRepeat> repeats) {
    std::vector<std::size_t> by_weight(repeats.size());
    std::iota(by_weight.begin(), by_weight.end(), 0);
    std::stable_sort(by_weight.begin(), by_weight.end(), [&](std::size_t a, std::size_t b) {
        return repeats[a].weight > repeats[b].weight;
    });
    std::vector<std::size_t> shown;
    // First pass: only takes that are not shown yet. Second pass: any repeat that is not shown yet.
    for (const bool needs_new_take : {true, false}) {
        for (const std::size_t r : by_weight) {
            const bool is_known = std::any_of(shown.begin(), shown.end(), [&](std::size_t s) {
                return needs_new_take ? repeats[s].clip == repeats[r].clip : s == r;
            });
            if (!is_known && shown.size() < kShownRepeats) {
                shown.push_back(r);
            }
        }
    }
    return shown;
}

/// A feature's variance over all samples, and the part of it that lies between the states.
struct Variance {
    double all = 0.0;
    double between = 0.0;
};

// One pass over counts, sums and squares. Between-state variance: the variance of the states'
// means, weighted by the samples in each. Rounding may bring it below 0, hence the clamps.
Variance variance_of(std::span<const models::Frames> repeats,
                     std::span<const std::vector<std::size_t>> paths,
                     Eigen::Index feature,
                     std::size_t states) {
    std::vector<double> count(states, 0.0);
    std::vector<double> sum(states, 0.0);
    double square = 0.0;
    for (std::size_t r = 0; r < repeats.size(); ++r) {
        for (std::size_t t = 0; t < paths[r].size(); ++t) {
            const double value = repeats[r](static_cast<Eigen::Index>(t), feature);
            count[paths[r][t]] += 1.0;
            sum[paths[r][t]] += value;
            square += value * value;
        }
    }
    const double samples = std::accumulate(count.begin(), count.end(), 0.0);
    const double mean = std::accumulate(sum.begin(), sum.end(), 0.0) / samples;
    double of_states = 0.0;
    for (std::size_t k = 0; k < states; ++k) {
        of_states += count[k] > 0.0 ? sum[k] * sum[k] / count[k] : 0.0;
    }
    return {std::max(0.0, square / samples - mean * mean),
            std::max(0.0, of_states / samples - mean * mean)};
}

/// A key that is the same for all features of one joint; each root feature has its own.
std::size_t joint_of(const PartModel& part, std::size_t feature) {
    const std::size_t root = part.root_features();
    return feature < root ? feature : root + (feature - root) / 3;
}

// The features with the largest variance between the states, one of each joint: two axes of one
// joint would show the same movement twice.
std::vector<std::size_t> features_to_show(const PartModel& part,
                                          std::span<const Variance> variances) {
    std::vector<std::size_t> by_variance(variances.size());
    std::iota(by_variance.begin(), by_variance.end(), 0);
    std::stable_sort(by_variance.begin(), by_variance.end(), [&](std::size_t a, std::size_t b) {
        return variances[a].between > variances[b].between;
    });
    std::vector<std::size_t> shown;
    for (const std::size_t feature : by_variance) {
        const bool is_known = std::any_of(shown.begin(), shown.end(), [&](std::size_t other) {
            return joint_of(part, other) == joint_of(part, feature);
        });
        if (!is_known && shown.size() < kShownFeatures) {
            shown.push_back(feature);
        }
    }
    return shown;
}

std::vector<double> column_of(const models::Frames& frames, std::size_t column) {
    const auto values = frames.col(static_cast<Eigen::Index>(column));
    return {values.begin(), values.end()};
}

// Fills part.curves. part.paths must be set: they say which sample belongs to which state.
void add_curves(const PartModel& joints,
                std::span<const models::Frames> repeats,
                std::span<const std::size_t> shown,
                const models::GaussianHmm& hmm,
                PartReport& part) {
    std::vector<Variance> variances;
    for (Eigen::Index i = 0; i < hmm.dimension(); ++i) {
        variances.push_back(
            variance_of(repeats, part.paths, i, static_cast<std::size_t>(hmm.states())));
    }
    for (const std::size_t feature : features_to_show(joints, variances)) {
        FeatureCurve curve;
        curve.name = feature_name(joints, feature);
        curve.unit = feature_unit(joints, feature);
        const Variance& variance = variances[feature];
        curve.explained = variance.all > 0.0 ? variance.between / variance.all : 0.0;
        for (const std::size_t r : shown) {
            curve.repeats.push_back(column_of(repeats[r], feature));
        }
        curve.state_means = column_of(hmm.means, feature);
        part.curves.push_back(std::move(curve));
    }
}

// Trains one part on all repeats with the chosen number of states, then reads its timing from the
// Viterbi paths.
Expected<void> report_part(Part which,
                           std::span<const std::vector<Pose>> phased,
                           std::span<const FigureRepeat> repeats,
                           const FigureTrainingOptions& training,
                           FigureReport& report) {
    PartReport& part = report.parts[static_cast<std::size_t>(which)];
    models::TrainingSet set;
    for (const FigureRepeat& repeat : repeats) {
        set.weights.push_back(repeat.weight);
    }
    const PartModel joints = mean_joints(which, phased, set.weights, training.features);
    for (const std::vector<Pose>& poses : phased) {
        set.sequences.push_back(part_frames(poses, joints, training.samples_per_beat));
    }
    StateLearning learning = training.learning();
    learning.states = part.selection.chosen;
    const Expected<models::TrainingResult> learnt = learn_states(set, learning);
    if (!learnt) {
        return fail(learnt.error());
    }
    Expected<FollowedStates> followed =
        follow_states(learnt->model, set, training.covariance_floor);
    if (!followed) {
        return fail(std::move(followed.error()));
    }
    // Paths come before the curves, which need them.
    part.paths = std::move(followed->paths);
    const auto states = static_cast<std::size_t>(learning.states);
    part.occurrence = count_occurrence(part.paths, report.beats, report.samples_per_beat, states);
    part.stays = state_lengths(part.paths, report.samples_per_beat, states);
    add_curves(joints, set.sequences, report.shown, learnt->model, part);
    return {};
}

}  // namespace

Expected<FigureReport> report_figure(std::span<const TrainingClip> clips,
                                     std::span<const FigureRepeat> repeats,
                                     const FigureTrainingOptions& training,
                                     const StateSelectionOptions& options) {
    Expected<StateSelection> selection = select_states(clips, repeats, training, options);
    if (!selection) {
        return fail(std::move(selection.error()));
    }
    FigureReport report;
    report.figure = training.name;
    report.role = training.role;
    report.features = training.features;
    report.beats = training.beats;
    report.samples_per_beat = training.samples_per_beat;
    for (const FigureRepeat& repeat : repeats) {
        report.takes.push_back(clips[repeat.clip].name);
    }
    report.folds = std::move(selection->folds);
    report.shown = repeats_to_show(repeats);
    // The selection has done the same on each fold; here all repeats teach.
    const std::vector<std::vector<Pose>> phased =
        phased_repeats(clips, repeats, training.samples_per_beat, training.low_pass_hz);
    for (const Part which : parts_of(training.features)) {
        const std::size_t p = static_cast<std::size_t>(which);
        report.parts[p].selection = std::move(selection->parts[p]);
        if (auto ok = report_part(which, phased, repeats, training, report); !ok) {
            return fail(std::move(ok.error()).in(std::string(kPartNames[p])));
        }
    }
    return report;
}

std::string feature_name(const PartModel& part, std::size_t feature) {
    constexpr std::array<const char*, kRootFeatures> kRootNames = {"hips to the left",
                                                                   "hips forward",
                                                                   "turn",
                                                                   "hips' height",
                                                                   "hips' tilt, x",
                                                                   "hips' tilt, z"};
    const std::size_t root = part.root_features();
    if (feature < root) {
        return kRootNames[feature];
    }
    const Bone bone = part.joints[(feature - root) / 3].bone;
    // "leftLowerLeg" as words
    std::string words;
    for (const char c : kBoneNames[index_of(bone)]) {
        if (c >= 'A' && c <= 'Z') {
            words += ' ';
            words += static_cast<char>(c - 'A' + 'a');
        } else {
            words += c;
        }
    }
    return words + ", " + "xyz"[(feature - root) % 3];
}

std::string feature_unit(const PartModel& part, std::size_t feature) {
    constexpr std::array<const char*, kRootFeatures> kRootUnits = {
        "m a beat", "m a beat", "rad a beat", "m", "rad", "rad"};
    if (feature < part.root_features()) {
        return kRootUnits[feature];
    }
    return part.features == FigureFeatures::positions ? "m" : "rad";
}

}  // namespace raks::motion
