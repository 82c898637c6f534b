#include "training/cells/state_ties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/smooth_steps.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {
namespace {

constexpr double kGoOver = 0.5;  // beats at an end of a run, from states of one's own to tied ones

// A body at one sample, of one part: features of the root, then joints' rotations.
struct SampleBody {
    std::vector<double> root;
    std::vector<glm::dquat> joints;  // as in PartModel::joints
};

// Three samples: before, at and behind the middle of a state.
using StateBodies = std::array<SampleBody, 3>;

// The values of three samples whose mean, delta and delta-delta a state has.
std::array<double, 3> samples_of(const FigureState& state, std::size_t d) {
    const double bend = 0.5 * state.delta_delta_mean[d];
    return {state.mean[d] - state.delta_mean[d] + bend,
            state.mean[d],
            state.mean[d] + state.delta_mean[d] + bend};
}

StateBodies state_bodies(const PartModel& part, const FigureState& state) {
    StateBodies bodies;
    const std::size_t root = part.root_features();
    for (std::size_t d = 0; d < root; ++d) {
        const auto values = samples_of(state, d);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            bodies[i].root.push_back(values[i]);
        }
    }
    for (std::size_t j = 0; j < part.joints.size(); ++j) {
        const std::size_t d = root + 3 * j;
        const std::array<std::array<double, 3>, 3> axes = {
            samples_of(state, d), samples_of(state, d + 1), samples_of(state, d + 2)};
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            bodies[i].joints.push_back(part.joints[j].mean *
                                       rotation_from({axes[0][i], axes[1][i], axes[2][i]}));
        }
    }
    return bodies;
}

// The index of a joint's counterpart.
std::size_t counterpart_of(const PartModel& part, std::size_t joint) {
    const Bone bone = mirrored(part.joints[joint].bone);
    const auto found = std::find_if(part.joints.begin(),
                                    part.joints.end(),
                                    [&](const JointFeature& other) { return other.bone == bone; });
    return static_cast<std::size_t>(found - part.joints.begin());
}

SampleBody mirrored_body(const PartModel& part, const SampleBody& body) {
    SampleBody image = body;
    if (!image.root.empty()) {
        for (const RootFeature flipped :
             {RootFeature::velocity_left, RootFeature::yaw_rate, RootFeature::tilt_z}) {
            image.root[static_cast<std::size_t>(flipped)] *= -1.0;
        }
    }
    for (std::size_t j = 0; j < part.joints.size(); ++j) {
        const glm::dquat& other = body.joints[counterpart_of(part, j)];
        image.joints[j] = {other.w, other.x, -other.y, -other.z};
    }
    return image;
}

// Multiplies what of the root is a length.
void scale_root(double factor, SampleBody& body) {
    if (!body.root.empty()) {
        for (const RootFeature length :
             {RootFeature::velocity_left, RootFeature::velocity_forward, RootFeature::height}) {
            body.root[static_cast<std::size_t>(length)] *= factor;
        }
    }
}

SampleBody mean_body(std::span<const SampleBody> bodies) {
    SampleBody mean = bodies.front();
    const auto count = static_cast<double>(bodies.size());
    for (std::size_t d = 0; d < mean.root.size(); ++d) {
        mean.root[d] = 0.0;
        for (const SampleBody& body : bodies) {
            mean.root[d] += body.root[d] / count;
        }
    }
    const std::vector<double> weights(bodies.size(), 1.0 / count);
    for (std::size_t j = 0; j < mean.joints.size(); ++j) {
        std::vector<glm::dquat> rotations;
        for (const SampleBody& body : bodies) {
            rotations.push_back(body.joints[j]);
        }
        mean.joints[j] = mean_rotation(rotations, weights);
    }
    return mean;
}

// The features of a body at one sample.
std::vector<double> features_in(const PartModel& part, const SampleBody& body) {
    std::vector<double> values = body.root;
    for (std::size_t j = 0; j < part.joints.size(); ++j) {
        const glm::dvec3 map =
            exponential_map(glm::conjugate(part.joints[j].mean) * body.joints[j]);
        values.insert(values.end(), {map.x, map.y, map.z});
    }
    return values;
}

// How far a repeat is tied at a phase of its cell, [0, 1].
struct TieWeight {
    bool begins = false;  // the cell before is not tied
    bool ends = false;    // the cell behind is not tied

    [[nodiscard]] double at(double phase) const noexcept {
        const auto rise = [](double way) {
            return smootherstep(static_cast<float>(way / kGoOver));
        };
        return static_cast<double>((begins ? rise(phase) : 1.0F) *
                                   (ends ? rise(1.0 - phase) : 1.0F));
    }
};

// Moves a state towards the mean of its repeats, by a weight for each of its three samples.
void move_state(const PartModel& part,
                const StateBodies& mean,
                const std::array<double, 3>& weights,
                FigureState& state) {
    std::array<std::vector<double>, 3> wanted;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i] = features_in(part, mean[i]);
    }
    for (std::size_t d = 0; d < part.dimension(); ++d) {
        std::array<double, 3> x = samples_of(state, d);
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] += weights[i] * (wanted[i][d] - x[i]);
        }
        state.mean[d] = x[1];
        state.delta_mean[d] = 0.5 * (x[2] - x[0]);
        state.delta_delta_mean[d] = x[2] - 2.0 * x[1] + x[0];
    }
}

// Ties one state of one part over all repeats of a cell.
class StateTies {
 public:
    StateTies(const CellRepeats& repeats,
              std::span<const CellSource> cells,
              std::span<FigureModel> takes)
        : repeats_(repeats), cells_(cells), takes_(takes) {}

    void tie(std::size_t part, std::size_t slice, std::span<const TieWeight> weights) {
        std::array<std::vector<SampleBody>, 3> all;
        for (const TiedCell& repeat : repeats_) {
            const StateBodies own = state_bodies(part_of(repeat, part), state(repeat, part, slice));
            for (std::size_t i = 0; i < own.size(); ++i) {
                all[i].push_back(seen(repeat, part, own[i], false));
            }
        }
        StateBodies mean;
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] = mean_body(all[i]);
        }
        constexpr double kSample = 1.0 / kCellSamples;
        const double middle = (static_cast<double>(slice) + 0.5) / kStatesPerBeat;
        for (std::size_t r = 0; r < repeats_.size(); ++r) {
            StateBodies own;
            for (std::size_t i = 0; i < own.size(); ++i) {
                own[i] = seen(repeats_[r], part, mean[i], true);
            }
            move_state(part_of(repeats_[r], part),
                       own,
                       {weights[r].at(middle - kSample),
                        weights[r].at(middle),
                        weights[r].at(middle + kSample)},
                       state(repeats_[r], part, slice));
        }
    }

 private:
    [[nodiscard]] FigureModel& take(const TiedCell& repeat) const {
        return takes_[cells_[repeat.cell].cell.take];
    }
    [[nodiscard]] PartModel& part_of(const TiedCell& repeat, std::size_t part) const {
        return take(repeat).parts[part];
    }
    [[nodiscard]] FigureState& state(const TiedCell& repeat,
                                     std::size_t part,
                                     std::size_t slice) const {
        return part_of(repeat, part)
            .states[std::size_t{kStatesPerBeat} * cells_[repeat.cell].cell.beat + slice];
    }
    // A repeat's body as that of the first repeat, or the other way round.
    [[nodiscard]] SampleBody seen(const TiedCell& repeat,
                                  std::size_t part,
                                  const SampleBody& body,
                                  bool is_back) const {
        SampleBody result = repeat.is_mirrored ? mirrored_body(part_of(repeat, part), body) : body;
        const double size =
            take(repeats_.front()).source_hips_height / take(repeat).source_hips_height;
        scale_root(is_back ? 1.0 / size : size, result);
        return result;
    }

    const CellRepeats& repeats_;
    std::span<const CellSource> cells_;
    std::span<FigureModel> takes_;
};

// Which group each cell is in.
class GroupNumbers {
 public:
    GroupNumbers(std::span<const CellRepeats> groups, std::span<const CellSource> cells)
        : groups_(groups), cells_(cells), numbers_(cells.size()) {
        for (std::size_t g = 0; g < groups.size(); ++g) {
            for (const TiedCell& repeat : groups[g]) {
                numbers_[repeat.cell] = g;
            }
        }
    }
    [[nodiscard]] TieWeight weight_of(std::size_t cell) const {
        return {cell == 0 || !leads_on(cell - 1), !leads_on(cell)};
    }

 private:
    // Whether most repeats of a cell go over to those of the next one: else the means of the two
    // are of different examples, and differ where they meet.
    [[nodiscard]] bool leads_on(std::size_t cell) const {
        if (!goes_on(cells_, cell) || !numbers_[cell] || !numbers_[cell + 1]) {
            return false;
        }
        constexpr double kMostRepeats = 0.7;
        const CellRepeats& own = groups_[*numbers_[cell]];
        const auto common = std::count_if(own.begin(), own.end(), [&](const TiedCell& repeat) {
            return goes_on(cells_, repeat.cell) && numbers_[repeat.cell + 1] == numbers_[cell + 1];
        });
        const std::size_t larger = std::max(own.size(), groups_[*numbers_[cell + 1]].size());
        return static_cast<double>(common) > kMostRepeats * static_cast<double>(larger);
    }

    std::span<const CellRepeats> groups_;
    std::span<const CellSource> cells_;
    std::vector<std::optional<std::size_t>> numbers_;  // by cell
};

}  // namespace

std::size_t tie_states(std::span<const CellRepeats> groups,
                       std::span<const CellSource> cells,
                       std::span<FigureModel> takes) {
    const GroupNumbers numbers(groups, cells);
    std::size_t shared = 0;
    for (const CellRepeats& group : groups) {
        std::vector<TieWeight> weights;
        for (const TiedCell& repeat : group) {
            weights.push_back(numbers.weight_of(repeat.cell));
        }
        StateTies ties(group, cells, takes);
        for (std::size_t slice = 0; slice < std::size_t{kStatesPerBeat}; ++slice) {
            for (std::size_t part = 0; part < kParts.size(); ++part) {
                ties.tie(part, slice, weights);
            }
            const double middle = (static_cast<double>(slice) + 0.5) / kStatesPerBeat;
            shared += static_cast<std::size_t>(
                std::count_if(weights.begin(), weights.end(), [&](const TieWeight& weight) {
                    return weight.at(middle) >= 1.0;
                }));
        }
    }
    return shared;
}

}  // namespace raks::motion
