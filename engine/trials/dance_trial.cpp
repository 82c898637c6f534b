#include "engine/trials/dance_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/trials/danced_figures.hpp"
#include "motion/choreography/joint_limits.hpp"
#include "motion/evaluate/couple_measures.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {
namespace {

// Records the poses at 60 a second and the dancer's status at every hop.
class RecordDance final : public OfflineDriver::Sink {
 public:
    explicit RecordDance(std::size_t measured) : measured_(measured) {}

    void on_hop(const PerformedHop& hop) override {
        poses_.on_hop(hop);
        hops.push_back(hop.dancer);
        held.push_back(hop.held);
    }
    [[nodiscard]] const std::vector<motion::Pose>& poses() const {
        return poses_.dancers[measured_];
    }
    [[nodiscard]] const std::vector<std::vector<motion::Pose>>& dancers() const {
        return poses_.dancers;
    }

    std::vector<motion::DancerStatus> hops;
    std::vector<motion::GripWeights> held;  // by hop

 private:
    std::size_t measured_;
    CollectPoses poses_{kTrialPosesPerSecond};
};

// The figure danced at `time`, seconds; null between figures.
const DancedFigure* figure_at(std::span<const DancedFigure> figures, double time) {
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& figure) {
        return time >= figure.from && time < figure.to;
    });
    return found == figures.end() ? nullptr : &*found;
}

// For every frame the pace (tempo danced / learnt) and whether the frame counts: it lies in a known
// figure, after the blend in from standing and before the dance ends.
motion::MetricFrames frames_of(const RecordDance& record, std::span<const DancedFigure> figures) {
    motion::MetricFrames frames;
    const CountWindow window;
    for (std::size_t f = 0; f < record.poses().size(); ++f) {
        const double time = static_cast<double>(f) / kTrialPosesPerSecond;
        const auto hop =
            std::min(static_cast<std::size_t>(time * kHopsPerSecond), record.hops.size() - 1);
        const motion::DancerStatus& status = record.hops[hop];
        // Status is by hop, poses by frame: the hop that contains the frame.
        const DancedFigure* const figure = status.is_dancing ? figure_at(figures, time) : nullptr;
        frames.pace.push_back(
            figure == nullptr
                ? 1.0
                // Divided by later, so that it must not become 0.
                : std::max(status.rate / figure->model->learnt_tempo.beats_per_second(), 1e-3));
        frames.counted.push_back(figure != nullptr &&
                                 time >= figure->dance_from + window.blend_in &&
                                 time < figure->dance_to);
    }
    return frames;
}

// Height of the lowest sole point (ball, heel or toe tip) of any pose, metres over the floor.
double lowest_sole(const motion::Skeleton& skeleton, std::span<const motion::Pose> poses) {
    float lowest = 1e9F;
    for (const motion::Pose& pose : poses) {
        const motion::WorldPose world = motion::world_pose(skeleton, pose);
        for (const motion::Side side : motion::kSides) {
            for (const glm::vec3& point : {motion::foot_point(world, side, skeleton.ball),
                                           motion::foot_point(world, side, skeleton.heel),
                                           motion::toe_tip(skeleton, world, side)}) {
                lowest = std::min(lowest, point.y);
            }
        }
    }
    return static_cast<double>(lowest);
}

// Adds what single poses are: hands in the body, joints beyond their limits, soles.
void measure_poses(const motion::Skeleton& skeleton, TrialResult& result) {
    result.lowest_sole = lowest_sole(skeleton, result.poses);
    result.hand_clearance = 1e9;
    for (const motion::Pose& pose : result.poses) {
        const auto clearance = static_cast<double>(motion::hand_clearance(skeleton, pose).metres);
        result.hand_clearance = std::min(result.hand_clearance, clearance);
        if (const auto joint = motion::worst_joint(pose)) {
            result.joint_excess = std::max(result.joint_excess, joint->beyond());
        }
    }
}

// Count times of the figures that were danced from count 1 to the next, not left for right: only
// those compare as repeats.
std::vector<motion::FigureRepeatTimes> whole_repeats(std::span<const DancedFigure> figures) {
    std::vector<motion::FigureRepeatTimes> repeats;
    for (const DancedFigure& figure : figures) {
        if (figure.is_whole && !figure.is_mirrored) {
            repeats.push_back({figure.model->name, figure.count_times});
        }
    }
    return repeats;
}

// Times of the beats that sound, seconds: a beat inside a silence cannot be danced to.
std::vector<double> audible_beats(const audio::GeneratedMusic& music) {
    std::vector<double> times;
    for (const audio::ReferenceBeat& beat : music.beats) {
        if (beat.is_audible) {
            times.push_back(to_seconds(beat.time));
        }
    }
    return times;
}

// Measures of the palms while they are held, over settled frames.
void measure_held_palms(const motion::Skeleton& skeleton,
                        const RecordDance& record,
                        const motion::MetricFrames& frames,
                        CoupleResult& result) {
    constexpr float kHeld = 0.95F;  // firmness from which a pair counts as held
    std::vector<double> apart;
    std::vector<double> heights;
    double held = 0.0;
    double counted = 0.0;
    for (std::size_t f = 0; f < frames.counted.size(); ++f) {
        const auto hop = static_cast<std::size_t>(
            static_cast<double>(f) / kTrialPosesPerSecond / to_seconds(kHop) + 0.5);
        if (!frames.counted[f] || hop >= record.held.size()) {
            continue;
        }
        bool is_held = false;
        for (const motion::Side lead : motion::kSides) {
            for (const motion::Side follow : motion::kSides) {
                if (record.held[hop][motion::index_of(motion::palms(lead, follow))] < kHeld) {
                    continue;
                }
                is_held = true;
                const motion::PalmsAt palms = motion::measure_palms(
                    skeleton, {lead, follow}, record.dancers()[0][f], record.dancers()[1][f]);
                apart.push_back(palms.apart);
                if (lead == motion::Side::left && follow == motion::Side::right) {
                    heights.push_back(palms.height);
                }
            }
        }
        held += is_held ? 1.0 : 0.0;
        counted += 1.0;
    }
    result.held = held / std::max(counted, 1.0);
    if (!apart.empty()) {
        result.palms_median = percentile(apart, 0.5);
        result.palms_p90 = percentile(std::move(apart), 0.9);
    }
    if (!heights.empty()) {
        result.held_height = percentile(heights, 0.95) - percentile(heights, 0.05);
    }
}

// Measures of the couple over settled frames. Hands and facing are measured in
// the basic only, distance in all figures.
CoupleResult couple_of(const motion::Skeleton& skeleton,
                       const RecordDance& record,
                       std::span<const DancedFigure> figures,
                       const motion::MetricFrames& frames) {
    constexpr std::string_view kBasic = "basic";
    const motion::CoupleMeasures all =
        motion::measure_couple(skeleton, record.dancers()[0], record.dancers()[1]);
    CoupleResult result;
    result.closest = 1e9;
    std::vector<double> hands;
    std::vector<double> facing;
    double counted = 0.0;
    for (std::size_t f = 0; f < all.closest.size(); ++f) {
        if (!frames.counted[f]) {
            continue;
        }
        const std::string& figure =
            figure_at(figures, static_cast<double>(f) / kTrialPosesPerSecond)->model->name;
        if (figure == kBasic) {
            hands.push_back(all.hands[f]);
            facing.push_back(all.facing[f]);
        }
        if (all.closest[f] < result.closest) {
            result.closest = all.closest[f];
            result.closest_in = figure;
        }
        result.overlapping += all.closest[f] < 0.0 ? 1.0 : 0.0;
        counted += 1.0;
    }
    result.overlapping /= std::max(counted, 1.0);
    if (!hands.empty()) {
        result.hands_p90 = percentile(std::move(hands), 0.9);
        result.facing_p90 = percentile(std::move(facing), 0.9);
    }
    measure_held_palms(skeleton, record, frames, result);
    return result;
}

// All measures of one trial from the recorded dance.
TrialResult result_of(const DanceTrial& trial,
                      const TrialCast& cast,
                      const RecordDance& record,
                      const audio::GeneratedMusic& music,
                      std::span<const motion::FigureModel> models) {
    const motion::Skeleton& skeleton = cast.skeleton();
    const std::vector<DancedFigure> figures = danced_figures(record.hops, music.beats, models);
    const motion::BodyTrack track =
        motion::body_track(skeleton, record.poses(), kTrialPosesPerSecond);
    TrialResult result;
    // Landings are judged against the beats of the music, never against the dancer's own phase.
    const std::vector<motion::AudibleCount> counts =
        audible_counts(figures, {.from = trial.judged_from, .to = trial.judged_to});
    result.landing = motion::landing_errors(track, counts, cast.landings);
    motion::DanceSubject subject;
    subject.frames = frames_of(record, figures);
    subject.repeats = whole_repeats(figures);
    subject.beat_times = audible_beats(music);
    subject.floor_height = 0.0;
    result.measures = motion::measure_dance(track, subject);
    // The highest jerk counts every frame, settled or not, since starts and stops must be smooth
    // too. The pace still scales it.
    const std::vector<bool> all(track.frames(), true);
    result.highest_jerk = motion::jerk_of(track, {all, subject.frames.pace}).highest;
    double settled = 0.0;
    for (std::size_t f = 0; f < track.frames(); ++f) {
        if (subject.frames.counted[f]) {
            result.pace += subject.frames.pace[f];
            settled += 1.0;
        }
    }
    // Mean pace over settled frames; 0 when there are none.
    result.pace = settled > 0.0 ? result.pace / settled : 0.0;
    if (record.dancers().size() == 2) {
        result.couple = couple_of(skeleton, record, figures, subject.frames);
    }
    const auto dancing = std::count_if(record.hops.begin(),
                                       record.hops.end(),
                                       [](const auto& status) { return status.is_dancing; });
    result.danced_share = static_cast<double>(dancing) / static_cast<double>(record.hops.size());
    result.reanchors = static_cast<int>(record.hops.back().reanchors);
    result.poses = record.poses();
    measure_poses(skeleton, result);
    return result;
}

}  // namespace

Expected<TrialResult> run_trial(const DanceTrial& trial,
                                const TrialCast& cast,
                                std::span<const motion::FigureModel> models) {
    const auto music = audio::generate(trial.music);
    if (!music) {
        return fail(music.error());
    }
    auto driver = OfflineDriver::create(music->rate, cast.models, cast.cast);
    if (!driver) {
        return fail(driver.error());
    }
    // The whole piece in one block: the result does not depend on block sizes.
    RecordDance record(cast.measured);
    driver->feed(music->mono(), record);
    driver->finish(record);
    return result_of(trial, cast, record, *music, models);
}

}  // namespace raks::engine
