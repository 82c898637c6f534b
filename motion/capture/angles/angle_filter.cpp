#include "motion/capture/angles/angle_filter.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "motion/capture/angles/annealing.hpp"
#include "motion/capture/angles/posture_polish.hpp"

namespace raks::capture {
namespace {

using motion::Bone;

// Survival rates and bounds (pixels), chosen on other takes than those that are measured: the
// partitioned filter may narrow down quickly, the full one must not.
constexpr double kPartitionedSurvival = 0.22;
constexpr double kPartitionedBound = 12.0;
constexpr double kFullSurvival = 0.75;
constexpr double kFullBound = 25.0;
constexpr double kFirstNoise = 2.0;    // times the motion scale
constexpr double kJointNoise = 0.35;   // of it, when all joints are sought at the end
constexpr double kPriorNoise = 3.0;    // of it, of the prediction when polishing
constexpr double kShareOfTrunk = 0.3;  // of the layers
constexpr double kShareOfAll = 0.3;    // of the layers
// In the first layer of a limb so many particles come from known postures, and so many are strewn
// wider; of a limb that has gone astray more, and so many are drawn from all that the joints can
// do.
constexpr double kKnownShare = 0.10;
constexpr double kKnownShareAstray = 0.3;
constexpr double kDrawnShareAstray = 0.4;
constexpr double kWideShare = 0.15;
constexpr double kWideNoise = 4.0;
constexpr double kKeptVelocity = 0.8;
constexpr double kKeptVelocityPolished = 0.5;
constexpr std::size_t kBlocksAtOnce = 4;  // that a thread takes

// Motion of salsa between frames at 30 a second beyond half of its velocity, root mean squares.
constexpr double kAtRate = 30.0;
constexpr double kHipsSideways = 0.011;  // metres
constexpr double kHipsUp = 0.004;
constexpr double kHipsTurn = 0.039;  // radians, about the vertical
constexpr double kHipsTilt = 0.008;
constexpr double kAccelerationToMotion = 1.0 / 3200.0;  // radians a frame to those / s^2 of a joint

std::size_t layers_of(double share, std::size_t layers) {
    return static_cast<std::size_t>(std::max(1.0, std::round(share * static_cast<double>(layers))));
}

}  // namespace

/// One run of layers over some joints.
struct AngleFilter::Stage {
    const JointGroup& group;
    const PostureWeigher& weigher;
    const BodyState& reference;
    const std::vector<BodyState>* known = nullptr;  ///< of a limb
    LimbSight sight = LimbSight::seen;
    std::size_t layers = 1;
    double noise = 1.0;  ///< of the first layer, times the motion scale
    double survival = 0.5;
    std::uint64_t stream = 0;  ///< of random numbers; a layer adds its own number
    int threads = 1;
    double square_bound = 1.0;  ///< of the likelihood, pixels
    double sigma = 1.0;         ///< of a spot, pixels at our focal length
    bool tells_spread = true;
};

std::vector<double> motion_scale(const BodyModel& model, double frames_per_second) {
    const double rate = kAtRate / frames_per_second;
    std::vector<double> scale(model.variables());
    scale[kHipsPlace] = scale[kHipsPlace + 2] = kHipsSideways * rate;
    scale[kHipsPlace + 1] = kHipsUp * rate;
    for (const TurningJoint& joint : model.joints()) {
        for (std::size_t i = 0; i < joint.size(); ++i) {
            scale[joint.first + i] = kAccelerationToMotion * joint.acceleration * rate;
        }
        if (joint.bones[0] == Bone::hips) {
            scale[joint.first] = scale[joint.first + 2] = kHipsTilt * rate;
            scale[joint.first + 1] = kHipsTurn * rate;
        }
    }
    return scale;
}

AngleFilter::AngleFilter(const FrameContext& context, const AngleFilterOptions& options)
    : context_(context),
      options_(options),
      links_(links_of(context.model, context.shape, context.marker_bones)),
      division_(divide(context.model, links_, context.marker_bones)),
      scale_(motion_scale(context.model, options.frames_per_second)),
      changes_(context.model.variables(), options.particles) {}

double AngleFilter::kept_velocity() const noexcept {
    return options_.is_polished ? kKeptVelocityPolished : kKeptVelocity;
}

// Strews the particles [first, last) of a layer. The first of all stays as it is.
void AngleFilter::diffuse(const Stage& stage,
                          std::size_t layer,
                          std::size_t first,
                          std::size_t last) {
    const CounterRandom random(options_.seed, stage.stream + layer);
    const double noise = stage.noise * std::pow(stage.survival, 0.5 * static_cast<double>(layer));
    const auto wide =
        static_cast<std::size_t>(kWideShare * static_cast<double>(options_.particles));
    for (const std::size_t variable : stage.group.variables) {
        float* const changes = changes_.of(variable);
        const double deviation = noise * scale_[variable];
        for (std::size_t i = std::max<std::size_t>(1, first); i < last; ++i) {
            const bool is_wide = layer == 0 && stage.sight != LimbSight::seen && i <= wide;
            changes[i] +=
                static_cast<float>((is_wide ? kWideNoise : 1.0) * deviation *
                                   random.normal(i * context_.model.variables() + variable));
        }
    }
}

// Puts the last particles of a limb where it was in known postures, and of one that has gone astray
// wherever its joints can bring it.
void AngleFilter::scatter(const Stage& stage) {
    if (stage.sight == LimbSight::seen) {
        return;
    }
    const bool is_astray = stage.sight == LimbSight::astray;
    const CounterRandom random(options_.seed, stage.stream + stage.layers);
    const auto share = [this](double of) {
        return static_cast<std::size_t>(of * static_cast<double>(options_.particles));
    };
    const std::size_t drawn = is_astray ? share(kDrawnShareAstray) : 0;
    const std::size_t known =
        stage.known->empty() ? 0 : share(is_astray ? kKnownShareAstray : kKnownShare);
    for (std::size_t i = options_.particles - drawn - known; i < options_.particles; ++i) {
        const bool is_drawn = i >= options_.particles - drawn;
        for (const std::size_t index : stage.group.joints) {
            put_joint(stage,
                      index,
                      i,
                      is_drawn ? drawn_turn(random, index, i)
                               : context_.model.turn_of(
                                     (*stage.known)[random.below(i, stage.known->size())], index));
        }
    }
}

// A turn that a joint may have: any angle of a hinge, and of a ball what is usual, give or take.
glm::dvec3 AngleFilter::drawn_turn(const CounterRandom& random,
                                   std::size_t index,
                                   std::size_t particle) const {
    const TurningJoint& joint = context_.model.joints()[index];
    const std::uint64_t first =
        (options_.particles + particle) * context_.model.variables() + joint.first;
    if (joint.is_hinge) {
        return {
            joint.lowest + (joint.highest - joint.lowest) * random.uniform(2 * first), 0.0, 0.0};
    }
    const glm::dvec3 away(random.normal(first), random.normal(first + 1), random.normal(first + 2));
    return turn_vector(joint.usual * turned_by(joint.deviation * away));
}

// Gives a joint of a particle this turn (as BodyModel::turn_of).
void AngleFilter::put_joint(const Stage& stage,
                            std::size_t index,
                            std::size_t particle,
                            const glm::dvec3& turn) {
    const TurningJoint& joint = context_.model.joints()[index];
    if (joint.is_hinge) {
        changes_.of(joint.first)[particle] =
            static_cast<float>(turn.x - stage.reference.angles[index]);
        return;
    }
    const auto count = static_cast<double>(joint.count);
    const glm::dvec3 change =
        count * turn_vector(glm::conjugate(stage.reference.turns[index]) * turned_by(turn / count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        changes_.of(joint.first + axis)[particle] =
            static_cast<float>(change[static_cast<glm::length_t>(axis)]);
    }
}

// How sure the variables are. Weights at `beta` draw the particles together from one variance to
// another; the difference of the inverses is what was seen, as much as beta has let through of it.
// Together with what the motion allows that is a variance.
void AngleFilter::measure_spread(const Stage& stage, std::span<const float> weights, double beta) {
    const double whole_beta = 0.5 * stage.square_bound / (stage.sigma * stage.sigma);
    double sum = 0.0;
    for (const float weight : weights) {
        sum += static_cast<double>(weight);
    }
    const auto variance = [&](const float* changes, const auto& weight_of) {
        double mean = 0.0;
        double square = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto change = static_cast<double>(changes[i]);
            mean += weight_of(i) * change;
            square += weight_of(i) * change * change;
        }
        return std::max(square - mean * mean, 1e-14);
    };
    for (const std::size_t variable : stage.group.variables) {
        const float* const changes = changes_.of(variable);
        const double before = variance(
            changes, [&](std::size_t) { return 1.0 / static_cast<double>(weights.size()); });
        const double after =
            variance(changes, [&](std::size_t i) { return static_cast<double>(weights[i]) / sum; });
        const double seen = std::max(0.0, 1.0 / after - 1.0 / before) * whole_beta / beta;
        const double moved = kFirstNoise * scale_[variable];
        deviations_[variable] = 1.0 / std::sqrt(1.0 / (moved * moved) + seen);
    }
}

// Draws all particles together at their weighted mean.
void AngleFilter::gather(const Stage& stage, std::span<const float> weights) {
    double sum = 0.0;
    for (const float weight : weights) {
        sum += static_cast<double>(weight);
    }
    for (const std::size_t variable : stage.group.variables) {
        float* const changes = changes_.of(variable);
        double mean = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            mean += static_cast<double>(weights[i]) * static_cast<double>(changes[i]) / sum;
        }
        std::fill_n(changes, changes_.stride, static_cast<float>(mean));
    }
}

void AngleFilter::run(const Stage& stage) {
    const std::size_t count = options_.particles;
    std::vector<float> costs(changes_.stride);
    std::vector<float> weights(count);
    std::vector<float> row(count);
    std::vector<std::size_t> chosen;
    const std::size_t at_once = kBlocksAtOnce * kPostureBlock;
    for (std::size_t layer = 0; layer < stage.layers; ++layer) {
        if (layer == 0) {
            scatter(stage);
        }
        run_parallel((changes_.stride + at_once - 1) / at_once, stage.threads, [&](std::size_t i) {
            const std::size_t last = std::min(changes_.stride, (i + 1) * at_once);
            diffuse(stage, layer, i * at_once, std::min(count, last));
            for (std::size_t first = i * at_once; first < last; first += kPostureBlock) {
                stage.weigher.weigh(stage.group, changes_, first, costs.data() + first);
            }
        });
        const float beta = anneal({costs.data(), count}, stage.survival, weights);
        if (layer + 1 == stage.layers) {
            if (stage.tells_spread) {
                measure_spread(stage, weights, static_cast<double>(beta));
            }
            break;
        }
        resample(
            weights,
            CounterRandom(options_.seed, stage.stream + layer).uniform(~std::uint64_t{0} >> 1U),
            chosen);
        // The best stays undisturbed.
        chosen[0] = static_cast<std::size_t>(
            std::min_element(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(count)) -
            costs.begin());
        for (const std::size_t variable : stage.group.variables) {
            float* const changes = changes_.of(variable);
            for (std::size_t i = 0; i < count; ++i) {
                row[i] = changes[chosen[i]];
            }
            std::copy(row.begin(), row.end(), changes);
        }
    }
    gather(stage, weights);
}

// A stage of the partitioned filter, beside the whole one of a frame.
AngleFilter::Stage AngleFilter::part_of(const Stage& whole,
                                        const JointGroup& group,
                                        std::uint64_t number) const {
    constexpr std::uint64_t kStreamsAStage = 1U << 12U;
    Stage stage{group, whole.weigher, whole.reference};
    stage.noise = kFirstNoise;
    stage.survival = kPartitionedSurvival;
    stage.stream = whole.stream + number * kStreamsAStage;
    stage.threads = options_.threads;
    stage.square_bound = whole.square_bound;
    stage.sigma = whole.sigma;
    return stage;
}

void AngleFilter::run_parts(const Stage& whole, const PostureGuess& guess) {
    const std::size_t of_trunk = layers_of(kShareOfTrunk, options_.layers);
    const std::size_t of_all = layers_of(kShareOfAll, options_.layers);
    Stage trunk = part_of(whole, division_.trunk, 1);
    trunk.layers = of_trunk;
    run(trunk);
    run_parallel(division_.limbs.size(), options_.threads, [&](std::size_t i) {
        Stage limb = part_of(whole, division_.limbs[i], 2 + i);
        limb.layers = std::max<std::size_t>(
            1, options_.layers - std::min(options_.layers, of_trunk + of_all));
        limb.known = &guess.known;
        limb.sight = guess.limbs.empty() ? LimbSight::seen : guess.limbs[i];
        limb.threads = 1;
        run(limb);
    });
    Stage all = part_of(whole, division_.whole, 0);
    all.layers = of_all;
    all.noise = kJointNoise * kFirstNoise;
    all.tells_spread = false;
    run(all);
}

// Also the full filter seeks limbs that have gone astray by themselves.
void AngleFilter::run_astray(const Stage& whole, const PostureGuess& guess) {
    for (std::size_t i = 0; i < guess.limbs.size(); ++i) {
        if (guess.limbs[i] == LimbSight::astray) {
            Stage limb = part_of(whole, division_.limbs[i], 2 + i);
            limb.layers = options_.layers;
            limb.known = &guess.known;
            limb.sight = guess.limbs[i];
            run(limb);
        }
    }
}

FilteredPosture AngleFilter::find(const FrameMarks& marks,
                                  const PostureGuess& guess,
                                  std::uint64_t number) {
    const bool is_full = options_.filter == FilterKind::full;
    const double bound = is_full ? kFullBound : kPartitionedBound;
    const PostureWeigher weigher(
        context_.model, links_, marks, guess.predicted, options_.likelihood, bound);
    std::fill(changes_.values.begin(), changes_.values.end(), 0.0F);
    deviations_ = scale_;
    constexpr std::uint64_t kStreamsAFrame = 1U << 16U;
    Stage whole{division_.whole, weigher, guess.predicted};
    whole.layers = options_.layers;
    whole.noise = kFirstNoise;
    whole.survival = kFullSurvival;
    whole.stream = number * kStreamsAFrame;
    whole.threads = options_.threads;
    whole.square_bound = bound * bound;
    whole.sigma =
        marks.pictures().empty() ? options_.sigma : options_.sigma / marks.pictures().front().scale;
    if (is_full) {
        run(whole);
        run_astray(whole, guess);
    } else {
        run_parts(whole, guess);
    }
    std::vector<double> change;
    for (std::size_t i = 0; i < context_.model.variables(); ++i) {
        change.push_back(static_cast<double>(changes_.of(i)[0]));
    }
    FilteredPosture found{context_.model.moved(guess.predicted, change.data()), deviations_};
    if (options_.is_polished) {
        std::vector<double> deviations = scale_;
        for (double& deviation : deviations) {
            deviation *= kPriorNoise * kFirstNoise;
        }
        found.state =
            polish(context_, marks, options_.sigma, {guess.predicted, deviations}, found.state);
    }
    return found;
}

}  // namespace raks::capture
