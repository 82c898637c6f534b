#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "base/plain_name.hpp"
#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/range_check.hpp"

namespace raks::motion {
namespace {

// Limits of any number in a figure, far beyond what a body does: metres, radians, and those a beat.
constexpr double kLargest = 1e4;
// The smallest variance. A trajectory is found by equations that divide by variances: with smaller
// ones they overflow, and loops that compare their results never end. Learnt figures have 1e-10 or
// more.
constexpr double kLeastVariance = 1e-12;
constexpr std::size_t kMostSamples = 2048;  // of a figure: smoothing takes its square
constexpr std::size_t kMaxStates = 512;     // of one part: 64 beats, 8 a beat
constexpr double kUnitTolerance = 1e-6;     // of unit quaternions and sums of probabilities

// In all checks `name` is the field's path, such as "parts[0].states[3]", for the error.
Expected<void> check_size(const std::string& name, std::size_t found, std::size_t wanted) {
    if (found != wanted) {
        return fail(fmt::format("{} has {} numbers, must have {}", name, found, wanted));
    }
    return {};
}

/// Exactly `wanted` numbers in [-kLargest, kLargest]; NaN fails.
Expected<void> check_numbers(const std::string& name,
                             const std::vector<double>& values,
                             std::size_t wanted) {
    if (auto ok = check_size(name, values.size(), wanted); !ok) {
        return ok;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        // Written so that NaN fails as well.
        if (!(std::abs(values[i]) <= kLargest)) {
            return fail(
                fmt::format("{}[{}] is {}, must lie within +-{}", name, i, values[i], kLargest));
        }
    }
    return {};
}

// The same, but at least kLeastVariance.
Expected<void> check_variances(const std::string& name,
                               const std::vector<double>& values,
                               std::size_t wanted) {
    if (auto ok = check_numbers(name, values, wanted); !ok) {
        return ok;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] >= kLeastVariance)) {
            return fail(fmt::format(
                "{}[{}] is {}, must be {} or more", name, i, values[i], kLeastVariance));
        }
    }
    return {};
}

/// The covariance matrix of D features: numbers in range, variances on its diagonal, definite.
Expected<void> check_covariance(const std::string& name,
                                const std::vector<std::vector<double>>& rows,
                                std::size_t d) {
    if (auto ok = check_size(name, rows.size(), d); !ok) {
        return ok;
    }
    for (std::size_t i = 0; i < d; ++i) {
        if (auto ok = check_numbers(fmt::format("{}[{}]", name, i), rows[i], d); !ok) {
            return ok;
        }
        if (!(rows[i][i] >= kLeastVariance)) {
            return fail(fmt::format(
                "{}[{}][{}] is {}, must be {} or more", name, i, i, rows[i][i], kLeastVariance));
        }
    }
    // Draws and likelihoods need its Cholesky factor.
    if (!models::is_positive_definite(matrix_of(rows))) {
        return fail(fmt::format("{} is not positive definite", name));
    }
    return {};
}

// Means and variances of value, delta and delta-delta: D numbers each.
Expected<void> check_state(const std::string& name, const FigureState& state, std::size_t d) {
    // The three windows have the same shape, so one loop checks them.
    const struct {
        const char* name;
        const std::vector<double>& mean;
        const std::vector<double>& variance;
    } windows[] = {{"", state.mean, state.variance},
                   {"delta_", state.delta_mean, state.delta_variance},
                   {"delta_delta_", state.delta_delta_mean, state.delta_delta_variance}};
    for (const auto& window : windows) {
        if (auto ok = check_numbers(fmt::format("{}.{}mean", name, window.name), window.mean, d);
            !ok) {
            return ok;
        }
        if (auto ok = check_variances(
                fmt::format("{}.{}variance", name, window.name), window.variance, d);
            !ok) {
            return ok;
        }
    }
    return {};
}

/// Joints of positions: the whole body is built from them, so each must be there, once and in its
/// order.
Expected<void> check_places(const std::string& name, const PartModel& part) {
    // Compared joint by joint, so that the error names the first that differs.
    const std::vector<Bone> bones = default_joints(part.part, part.features);
    for (std::size_t j = 0; j < bones.size(); ++j) {
        if (j >= part.joints.size() || part.joints[j].bone != bones[j]) {
            return fail(
                fmt::format("{}.joints[{}] must be {}", name, j, kBoneNames[index_of(bones[j])]));
        }
    }
    return check_size(name + ".joints", part.joints.size(), bones.size());
}

// Joints of angles: means must be unit quaternions.
Expected<void> check_joints(const std::string& name, const PartModel& part) {
    if (part.features == FigureFeatures::positions) {
        return check_places(name, part);
    }
    if (part.joints.size() > std::size_t{kBoneCount}) {
        return fail(fmt::format("{}.joints has {} entries, must have at most {}",
                                name,
                                part.joints.size(),
                                kBoneCount));
    }
    for (std::size_t j = 0; j < part.joints.size(); ++j) {
        const glm::dquat& q = part.joints[j].mean;
        const double length = std::sqrt(glm::dot(q, q));
        // A quaternion of another length would scale the bone as well as turn it.
        if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
            return fail(
                fmt::format("{}.joints[{}].mean has length {}, must be 1", name, j, length));
        }
    }
    return {};
}

/// Covariances of the states, which must be there unless the covariance is tied: number, shape and
/// definiteness.
Expected<void> check_state_covariances(const std::string& name, const PartModel& part) {
    const bool is_tied = part.covariance_kind == CovarianceKind::tied;
    const std::size_t d = part.dimension();
    const std::size_t wanted = is_tied ? 0 : part.states.size();
    // A diagonal is stored as its one row of variances.
    const std::size_t rows = part.covariance_kind == CovarianceKind::diagonal ? 1 : d;
    if (part.state_covariances.size() != wanted) {
        return fail(fmt::format("{}.state_covariances has {} entries, must have {}",
                                name,
                                part.state_covariances.size(),
                                wanted));
    }
    for (std::size_t k = 0; k < wanted; ++k) {
        const std::string which = fmt::format("{}.state_covariances[{}]", name, k);
        if (part.state_covariances[k].size() != rows) {
            return fail(fmt::format(
                "{} has {} rows, must have {}", which, part.state_covariances[k].size(), rows));
        }
        const bool is_full = part.covariance_kind == CovarianceKind::full;
        if (auto ok = is_full
                          ? check_covariance(which, part.state_covariances[k], d)
                          : check_variances(which + "[0]", part.state_covariances[k].front(), d);
            !ok) {
            return ok;
        }
    }
    return {};
}

/// Occurrence table (beats x states, rows sum to 1) and lengths of the states.
Expected<void> check_timing(const std::string& name, const PartModel& part, int beats) {
    const std::size_t n = part.states.size();
    if (part.occurrence.size() != static_cast<std::size_t>(beats)) {
        return fail(fmt::format(
            "{}.occurrence has {} rows, must have {}", name, part.occurrence.size(), beats));
    }
    for (std::size_t c = 0; c < part.occurrence.size(); ++c) {
        const std::string row = fmt::format("{}.occurrence[{}]", name, c);
        if (auto ok = check_size(row, part.occurrence[c].size(), n); !ok) {
            return ok;
        }
        // Each count's shares over all states.
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const double share = part.occurrence[c][k];
            if (!(share >= 0.0 && share <= 1.0 + kUnitTolerance)) {
                return fail(fmt::format("{}[{}] is {}, must lie in [0, 1]", row, k, share));
            }
            sum += share;
        }
        if (!(std::abs(sum - 1.0) <= kUnitTolerance)) {
            return fail(fmt::format("{} sums to {:.6g}, must be 1", row, sum));
        }
    }
    if (auto ok = check_size(name + ".stays", part.stays.size(), n); !ok) {
        return ok;
    }
    for (std::size_t k = 0; k < n; ++k) {
        // No state lasts longer than the figure.
        const double lengths[] = {part.stays[k].mean.count(), part.stays[k].deviation.count()};
        for (std::size_t i = 0; i < 2; ++i) {
            if (!(lengths[i] >= 0.0 && lengths[i] <= beats)) {
                return fail(fmt::format("{}.stays[{}].{} is {}, must lie in [0, {}]",
                                        name,
                                        k,
                                        i == 0 ? "mean" : "deviation",
                                        lengths[i],
                                        beats));
            }
        }
    }
    return {};
}

// Shapes before values: the HMM's own validation needs matrices of the right size.
Expected<void> check_part(const std::string& name, const PartModel& part, int samples) {
    const std::size_t n = part.states.size();
    const std::size_t d = part.dimension();
    if (auto ok = check_joints(name, part); !ok) {
        return ok;
    }
    // More states than samples would leave some of them without a slice.
    if (n < 1 || n > kMaxStates || n > static_cast<std::size_t>(samples)) {
        return fail(
            fmt::format("{}.states has {} entries, must have 1 to {}",
                        name,
                        n,
                        std::min<std::size_t>(
                            kMaxStates, samples > 0 ? static_cast<std::size_t>(samples) : 1)));
    }
    // Without features there is nothing to draw.
    if (d == 0) {
        return fail(fmt::format("{}.joints is empty, must name at least one joint", name));
    }
    // Gaussians of all states, by window.
    for (std::size_t k = 0; k < n; ++k) {
        if (auto ok = check_state(fmt::format("{}.states[{}]", name, k), part.states[k], d); !ok) {
            return ok;
        }
    }
    if (auto ok = check_variances(name + ".global_variance", part.global_variance, d); !ok) {
        return ok;
    }
    if (auto ok = check_size(name + ".initial", part.initial.size(), n); !ok) {
        return ok;
    }
    if (auto ok = check_size(name + ".transition", part.transition.size(), n); !ok) {
        return ok;
    }
    for (std::size_t k = 0; k < n; ++k) {
        if (auto ok =
                check_size(fmt::format("{}.transition[{}]", name, k), part.transition[k].size(), n);
            !ok) {
            return ok;
        }
    }
    if (auto ok = check_size(name + ".exit", part.exit.size(), n); !ok) {
        return ok;
    }
    if (auto ok = check_covariance(name + ".covariance", part.covariance, d); !ok) {
        return ok;
    }
    if (auto ok = check_state_covariances(name, part); !ok) {
        return ok;
    }
    // Probabilities: in [0, 1], and each state's row and exit sum to 1.
    if (auto ok = models::validate(hmm_of(part)); !ok) {
        return fail(fmt::format("{}.{}", name, ok.error().message));
    }
    return {};
}

// Single numbers of the figure.
Expected<void> check_head(const FigureModel& model) {
    if (model.beats < 1 || model.beats > 64) {
        return fail(fmt::format("beats is {}, must be 1 to 64", model.beats));
    }
    if (model.samples_per_beat < 4 || model.samples_per_beat > 200) {
        return fail(
            fmt::format("samples_per_beat is {}, must be 4 to 200", model.samples_per_beat));
    }
    if (model.samples() > kMostSamples) {
        return fail(
            fmt::format("samples_per_beat is {}: {} samples in {} beats, must be at most {}",
                        model.samples_per_beat,
                        model.samples(),
                        model.beats,
                        kMostSamples));
    }
    for (const std::string* const name : {&model.name, &model.dance}) {
        if (!is_plain_name(*name)) {
            return fail(why_no_plain_name(*name));
        }
    }
    // Bounds far beyond any dance: they catch wrong units and damaged files.
    const RangeCheck ranges[] = {{"learnt_tempo", model.learnt_tempo.bpm(), 20.0, 400.0},
                                 {"net_displacement[0]", model.net_displacement.x, -100.0, 100.0},
                                 {"net_displacement[1]", model.net_displacement.y, -100.0, 100.0},
                                 {"net_turn", model.net_turn, -100.0, 100.0},
                                 {"source_hips_height", model.source_hips_height, 0.1, 10.0},
                                 {"peak_toe_speed", model.peak_toe_speed, 0.0, 100.0}};
    return check(ranges);
}

// Fists: none for both hands, or for each a constant or a curve.
Expected<void> check_hands(const FigureModel& model) {
    for (std::size_t side = 0; side < kSideNames.size(); ++side) {
        const std::vector<double>& fist = model.fist[side];
        // Both hands or none, or one would be drawn shaped and the other relaxed.
        if (fist.empty() != model.fist[0].empty() ||
            (fist.size() > 1 && fist.size() != kContactBins)) {
            return fail(fmt::format("fist.{} has {} numbers, must have 1 or {}, or both hands none",
                                    kSideNames[side],
                                    fist.size(),
                                    kContactBins));
        }
        for (std::size_t j = 0; j < fist.size(); ++j) {
            if (!(fist[j] >= 0.0 && fist[j] <= 1.0)) {
                return fail(fmt::format(
                    "fist.{}[{}] is {}, must lie in [0, 1]", kSideNames[side], j, fist[j]));
            }
        }
    }
    return {};
}

// Exponents of both laws must be finite and in range; size_at() limits their effect.
Expected<void> check_size_by_tempo(const SizeByTempo& size) {
    constexpr double kSteepest = 2.0;
    for (const auto& [name, exponent] : {std::pair("body", size.body), {"arms", size.arms}}) {
        if (!(exponent >= 0.0 && exponent <= kSteepest)) {
            return fail(fmt::format(
                "size_by_tempo.{} is {}, must lie in [0, {}]", name, exponent, kSteepest));
        }
    }
    return {};
}

// Contact probabilities, and one landing offset for each count.
Expected<void> check_feet(const FigureModel& model) {
    for (std::size_t side = 0; side < 2; ++side) {
        if (auto ok = check_size(fmt::format("contact.{}", kSideNames[side]),
                                 model.contact[side].size(),
                                 std::max<std::size_t>(model.contact[0].size(), 1));
            !ok) {
            return ok;
        }
        for (std::size_t j = 0; j < model.contact[side].size(); ++j) {
            const double chance = model.contact[side][j];
            if (!(chance >= 0.0 && chance <= 1.0)) {
                return fail(fmt::format(
                    "contact.{}[{}] is {}, must lie in [0, 1]", kSideNames[side], j, chance));
            }
        }
        const std::vector<LandingOffset>& landings = model.landings[side];
        const std::string name = fmt::format("landings.{}", kSideNames[side]);
        if (auto ok = check_size(name, landings.size(), static_cast<std::size_t>(model.beats));
            !ok) {
            return ok;
        }
        for (std::size_t c = 0; c < landings.size(); ++c) {
            // A landing lies within the figure before or after its count.
            if (!(std::abs(landings[c].median.count()) <= model.beats)) {
                return fail(fmt::format("{}[{}].median is {}, must lie within +-{}",
                                        name,
                                        c,
                                        landings[c].median.count(),
                                        model.beats));
            }
            if (!(landings[c].deviation.count() >= 0.0 &&
                  landings[c].deviation.count() <= model.beats)) {
                return fail(fmt::format("{}[{}].deviation is {}, must lie in [0, {}]",
                                        name,
                                        c,
                                        landings[c].deviation.count(),
                                        model.beats));
            }
        }
    }
    return {};
}

}  // namespace

Expected<void> validate(const FigureModel& model) {
    if (auto ok = check_head(model); !ok) {
        return ok;
    }
    // Parts must come in the order that the rest of the program expects.
    const std::span<const Part> parts = parts_of(model.features);
    if (model.parts.size() != parts.size()) {
        return fail(
            fmt::format("parts has {} entries, must have {}", model.parts.size(), parts.size()));
    }
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
        const std::string name = fmt::format("parts[{}]", p);
        if (model.parts[p].part != parts[p] || model.parts[p].features != model.features) {
            return fail(fmt::format("{}.part must be {} of {}",
                                    name,
                                    kPartNames[static_cast<std::size_t>(parts[p])],
                                    kFeaturesNames[static_cast<std::size_t>(model.features)]));
        }
        if (auto ok = check_part(name, model.parts[p], static_cast<int>(model.samples())); !ok) {
            return ok;
        }
        if (auto ok = check_timing(name, model.parts[p], model.beats); !ok) {
            return ok;
        }
    }
    if (auto ok = check_size_by_tempo(model.size_by_tempo); !ok) {
        return ok;
    }
    if (auto ok = check_hands(model); !ok) {
        return ok;
    }
    return check_feet(model);
}

}  // namespace raks::motion
