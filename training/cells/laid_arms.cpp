#include "training/cells/laid_arms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "training/figures/repeat_features.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr std::array<Bone, 8> kArmBones = {Bone::left_shoulder,
                                           Bone::left_upper_arm,
                                           Bone::left_lower_arm,
                                           Bone::left_hand,
                                           Bone::right_shoulder,
                                           Bone::right_upper_arm,
                                           Bone::right_lower_arm,
                                           Bone::right_hand};
constexpr double kGoesOver = 0.33;   // beats in which arms go over to others
constexpr double kUsedBefore = 0.3;  // radians that each earlier use counts

// Mean angle between the arms of two poses, radians.
double arms_apart(const Pose& a, const Pose& b) {
    double sum = 0.0;
    for (const Bone bone : kArmBones) {
        const double c =
            std::abs(static_cast<double>(glm::dot(a.rotation(bone), b.rotation(bone))));
        sum += 2.0 * std::acos(std::min(1.0, c));
    }
    return sum / static_cast<double>(kArmBones.size());
}

// Beats [first, last) of the table.
struct BeatRun {
    std::size_t first = 0;
    std::size_t last = 0;
};

class ArmLayer {
 public:
    ArmLayer(PreparedTake& take,
             const std::vector<TakeBeat>& beats,
             const std::vector<BeatFate>& fates)
        : take_(take),
          beats_(beats),
          fates_(fates),
          captured_(take.clip.poses),
          uses_(beats.size()) {
        for (const TakeBeat& beat : beats) {
            frames_.push_back(beat.time * take.clip.frames_per_second);
        }
    }

    std::size_t lay() {
        std::size_t laid = 0;
        for (std::size_t first = 0; first < fates_.size();) {
            std::size_t last = first;
            while (last < fates_.size() && fates_[last] == BeatFate::home) {
                ++last;
            }
            laid += last > first ? fill({first, last}) : 0;
            first = std::max(last, first + 1);
        }
        return laid;
    }

 private:
    [[nodiscard]] Pose pose_at(std::size_t beat) const {
        return pose_between(captured_, frames_[beat]);
    }

    // Fills a gap from its start with the longest runs that there are.
    std::size_t fill(BeatRun gap) {
        const BeatRun whole = gap;
        while (gap.first < gap.last) {
            std::size_t length = gap.last - gap.first;
            std::optional<std::size_t> donor;
            while (length > 0 && !(donor = best_donor(gap.first, length))) {
                --length;
            }
            if (!donor) {
                break;
            }
            copy({gap.first, gap.first + length}, *donor);
            gap.first += length;
        }
        go_over(whole, gap.first);
        return gap.first - whole.first;
    }

    // The first beat of the run of `length` danced beats that suits best, if there is one.
    [[nodiscard]] std::optional<std::size_t> best_donor(std::size_t first,
                                                        std::size_t length) const {
        std::optional<std::size_t> best;
        double least = 0.0;
        for (std::size_t from = 0; from + length < fates_.size(); ++from) {
            bool is_danced = beats_[from].half == beats_[first].half;
            double cost = 0.0;
            for (std::size_t i = from; i < from + length; ++i) {
                is_danced = is_danced && fates_[i] == BeatFate::danced;
                cost += kUsedBefore * uses_[i] / static_cast<double>(length);
            }
            if (!is_danced) {
                continue;
            }
            cost += arms_apart(pose_at(from), take_pose(first)) +
                    arms_apart(pose_at(from + length), take_pose(first + length));
            if (!best || cost < least) {
                best = from;
                least = cost;
            }
        }
        return best;
    }

    // As the take is now, with what was laid already.
    [[nodiscard]] Pose take_pose(std::size_t beat) const {
        return pose_between(take_.clip.poses, frames_[beat]);
    }

    void copy(BeatRun to, std::size_t from) {
        for (std::size_t i = to.first; i < to.last; ++i) {
            uses_[from + i - to.first] += 1.0;
        }
        const PhaseWarp warp(frames_);
        const auto [begin, end] = frames_of(frames_[to.first], frames_[to.last]);
        for (std::size_t frame = begin; frame < end; ++frame) {
            const double beat = warp.beat_at(static_cast<double>(frame)) -
                                static_cast<double>(to.first) + static_cast<double>(from);
            const Pose donor = pose_between(captured_, warp.frame_at(beat));
            for (const Bone bone : kArmBones) {
                take_.clip.poses[frame].rotation(bone) = donor.rotation(bone);
            }
            take_.postures.is_home[frame] = false;
        }
        joints_.push_back(to.first);
    }

    // At the ends of the gap and where two runs meet, the arms before go on and fade.
    void go_over(BeatRun gap, std::size_t end) {
        if (end > gap.first) {
            joints_.push_back(end);
        }
        const std::vector<Pose> laid = take_.clip.poses;
        for (const std::size_t joint : joints_) {
            const double length = joint + 1 < frames_.size() ? frames_[joint + 1] - frames_[joint]
                                                             : frames_[joint] - frames_[joint - 1];
            const double half = kGoesOver * length;
            const auto [first, last] = frames_of(frames_[joint] - half, frames_[joint] + half);
            if (last < first + 2) {
                continue;
            }
            const Pose& before = laid[first];
            const Pose& after = laid[last - 1];
            for (std::size_t frame = first; frame < last; ++frame) {
                const float at =
                    static_cast<float>(frame - first) / static_cast<float>(last - 1 - first);
                const float share = at * at * (3.0F - 2.0F * at);
                const Pose between = interpolate(before, after, share);
                for (const Bone bone : kArmBones) {
                    take_.clip.poses[frame].rotation(bone) = between.rotation(bone);
                }
            }
        }
        joints_.clear();
    }

    [[nodiscard]] std::pair<std::size_t, std::size_t> frames_of(double from, double to) const {
        const auto at = [&](double frame) {
            return static_cast<std::size_t>(
                std::clamp(std::lround(frame), 0L, static_cast<long>(take_.clip.poses.size())));
        };
        return {at(from), at(to)};
    }

    PreparedTake& take_;
    const std::vector<TakeBeat>& beats_;
    const std::vector<BeatFate>& fates_;
    std::vector<Pose> captured_;       // before anything was laid
    std::vector<double> uses_;         // by beat: how often its arms were taken
    std::vector<double> frames_;       // of the beats
    std::vector<std::size_t> joints_;  // beats at which arms change, of the present gap
};

}  // namespace

std::size_t lay_arms(PreparedTake& take,
                     const std::vector<TakeBeat>& beats,
                     const std::vector<BeatFate>& fates) {
    if (std::find(fates.begin(), fates.end(), BeatFate::home) == fates.end()) {
        return 0;
    }
    const std::size_t laid = ArmLayer(take, beats, fates).lay();
    measure_moments(take);
    return laid;
}

}  // namespace raks::motion
