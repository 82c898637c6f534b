#include "training/figures/figure_trainer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "models/hmm_scorer.hpp"
#include "motion/figures/figure_hmm.hpp"
#include "motion/figures/range_check.hpp"
#include "training/figures/figure_statistics.hpp"
#include "training/figures/repeat_features.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::motion {
namespace {

constexpr double kLargestMetres = 1e3;  // of a hips coordinate; a larger one means broken data

// Ranges of the options. Not more states than samples: every state needs one. The floor is above
// zero so that covariances stay positive definite.
Expected<void> check_options(const FigureTrainingOptions& options) {
    const RangeCheck ranges[] = {
        {"beats", static_cast<double>(options.beats), 1, kMostFigureBeats},
        {"samples_per_beat", static_cast<double>(options.samples_per_beat), 4, 200},
        {"states",
         static_cast<double>(options.states),
         1,
         std::min(512.0, static_cast<double>(options.beats) * options.samples_per_beat)},
        {"contact_bins", static_cast<double>(options.contact_bins), 1, 64.0 * options.beats},
        {"baum_welch_iterations", static_cast<double>(options.baum_welch_iterations), 0, 1000},
        {"covariance_floor", options.covariance_floor, 1e-6, 1e3},
        {"low_pass_hz", options.low_pass_hz, 0.5, 1e4}};
    return check(ranges);
}

// Finite, within range, and unit quaternions. The comparisons are false for NaN.
bool is_sound(const Pose& pose) noexcept {
    for (int c = 0; c < 3; ++c) {
        if (!(std::abs(static_cast<double>(pose.hips_position[c])) <= kLargestMetres)) {
            return false;
        }
    }
    return std::all_of(
        pose.local_rotations.begin(), pose.local_rotations.end(), [](const glm::quat& q) {
            return std::abs(static_cast<double>(glm::dot(q, q)) - 1.0) < 1e-3;
        });
}

// Shape, frame rate and values of a clip.
Expected<void> check_clip(const TrainingClip& clip) {
    if (clip.feet.size() != clip.poses.size() || clip.poses.empty()) {
        return fail(fmt::format("{}: has {} poses and {} feet, must have as many, at least one",
                                clip.name,
                                clip.poses.size(),
                                clip.feet.size()));
    }
    if (!(clip.frames_per_second >= 1.0 && clip.frames_per_second <= 1e4)) {
        return fail(fmt::format(
            "{}: {} frames a second, must be 1 to 10000", clip.name, clip.frames_per_second));
    }
    for (std::size_t i = 0; i < clip.poses.size(); ++i) {
        if (!is_sound(clip.poses[i])) {
            return fail(fmt::format(
                "{}: frame {} is not finite or more than {} m away; mend or cut the clip",
                clip.name,
                i,
                kLargestMetres));
        }
    }
    return {};
}

// One repetition: beats rise, lie within the clip and are long enough to resample.
Expected<void> check_repeat(const FigureRepeat& repeat,
                            std::span<const TrainingClip> clips,
                            int beats) {
    if (repeat.clip >= clips.size()) {
        return fail(fmt::format("a repeat is of clip {}, there are {}", repeat.clip, clips.size()));
    }
    const TrainingClip& clip = clips[repeat.clip];
    const std::vector<double>& frames = repeat.beat_frames;
    if (frames.size() != static_cast<std::size_t>(beats) + 1) {
        return fail(fmt::format("{}: a repeat has {} beat times, must have {} (the end included)",
                                clip.name,
                                frames.size(),
                                beats + 1));
    }
    for (std::size_t b = 0; b + 1 < frames.size(); ++b) {
        // A beat shorter than this means that the counts or the frame rate are wrong.
        constexpr double kFewestFrames = 4.0;
        if (!(frames[b + 1] - frames[b] >= kFewestFrames)) {
            return fail(
                fmt::format("{}: beat {} of the repeat at frame {:.1f} is {:.1f} frames "
                            "long, must be at least {}; check the counts and --fps",
                            clip.name,
                            b + 1,
                            frames[0],
                            frames[b + 1] - frames[b],
                            kFewestFrames));
        }
    }
    if (!(frames.front() >= 0.0 && frames.back() <= static_cast<double>(clip.poses.size() - 1))) {
        return fail(fmt::format("{}: a repeat spans frames {:.1f} to {:.1f}, the clip has {}",
                                clip.name,
                                frames.front(),
                                frames.back(),
                                clip.poses.size()));
    }
    if (!(repeat.weight > 0.0 && std::isfinite(repeat.weight))) {
        return fail(fmt::format("{}: a repeat weighs {}, must be > 0", clip.name, repeat.weight));
    }
    return {};
}

std::vector<double> weights_of(std::span<const FigureRepeat> repeats) {
    std::vector<double> weights;
    for (const FigureRepeat& repeat : repeats) {
        weights.push_back(repeat.weight);
    }
    return weights;
}

/// Trains one part on its features, one track a repeat (samples -1 .. T + 1), T = `samples`. Fills
/// the part's HMM, timing and trajectory statistics. Returns the mean log-likelihood per sample.
Expected<double> learn_part(std::span<const FeatureTrack> tracks,
                            std::span<const double> weights,
                            std::size_t samples,
                            const FigureTrainingOptions& options,
                            PartModel& part) {
    models::TrainingSet set;
    set.weights.assign(weights.begin(), weights.end());
    // The HMM sees samples 0 to T - 1, which are rows 1 to T: the outer rows are for deltas only.
    for (const FeatureTrack& track : tracks) {
        set.sequences.push_back(frames_of(track, 1, samples));
    }
    const Expected<models::TrainingResult> trained = learn_states(set, options.learning());
    if (!trained) {
        return fail(trained.error());
    }
    // A tied covariance is stored whatever kind was trained; timing comes from the Viterbi paths.
    const Expected<FollowedStates> followed =
        follow_states(trained->model, set, options.covariance_floor);
    if (!followed) {
        return fail(followed.error());
    }
    take_hmm(trained->model, followed->tied, part);
    set_timing(followed->paths, options.beats, options.samples_per_beat, part);
    // Needs the state means of take_hmm.
    learn_trajectory(tracks, weights, samples, part);

    double frames = 0.0;
    for (const double weight : weights) {
        frames += weight * static_cast<double>(samples);
    }
    return trained->log_likelihoods.back() / frames;
}

/// Sets displacement, turn and tempo: weighted means over the repeats.
void learn_net_motion(std::span<const std::vector<Pose>> phased,
                      std::span<const TrainingClip> clips,
                      std::span<const FigureRepeat> repeats,
                      const Skeleton& body,
                      FigureModel& model) {
    double weight_sum = 0.0;
    double seconds_per_beat = 0.0;
    for (std::size_t r = 0; r < repeats.size(); ++r) {
        const FigureRepeat& repeat = repeats[r];
        // From count 1 on: skips sample -1, so that integration starts at phase 0 with heading 0.
        const std::span<const Pose> whole = std::span(phased[r]).subspan(1, model.samples() + 2);
        const FeatureTrack root =
            features_of(whole, model.root_part(), model.samples_per_beat, body);
        // The place at sample T, which is count 1 of the next repetition.
        const RootPlace end = integrate_root(root, model.samples_per_beat, {})[model.samples()];
        const double frames = repeat.beat_frames.back() - repeat.beat_frames.front();
        weight_sum += repeat.weight;
        model.net_displacement += repeat.weight * end.position;
        model.net_turn += repeat.weight * end.heading;
        seconds_per_beat +=
            repeat.weight * frames / (clips[repeat.clip].frames_per_second * model.beats);
    }
    model.net_displacement /= weight_sum;
    model.net_turn /= weight_sum;
    model.learnt_tempo = Bpm::from_period(seconds_per_beat / weight_sum);
}

// Weighted like all other means, because clips of different bodies may be mixed.
double mean_hips_height(std::span<const TrainingClip> clips,
                        std::span<const FigureRepeat> repeats) {
    double weight_sum = 0.0;
    double hips_height = 0.0;
    for (const FigureRepeat& repeat : repeats) {
        weight_sum += repeat.weight;
        hips_height += repeat.weight * clips[repeat.clip].hips_height;
    }
    return hips_height / weight_sum;
}

}  // namespace

Expected<void> check_training(std::span<const TrainingClip> clips,
                              std::span<const FigureRepeat> repeats,
                              const FigureTrainingOptions& options) {
    if (auto ok = check_options(options); !ok) {
        return ok;
    }
    if (repeats.empty()) {
        return fail("no repeats to learn from; check figure, role, split and confidence");
    }
    for (const TrainingClip& clip : clips) {
        if (auto ok = check_clip(clip); !ok) {
            return ok;
        }
    }
    for (const FigureRepeat& repeat : repeats) {
        if (auto ok = check_repeat(repeat, clips, options.beats); !ok) {
            return ok;
        }
    }
    return {};
}

std::vector<Pose> poses_on_phase(std::span<const Pose> poses,
                                 std::span<const double> beat_frames,
                                 int samples_per_beat) {
    RAKS_ASSERT(!poses.empty());
    const PhaseWarp warp(beat_frames);
    const int samples = static_cast<int>(beat_frames.size() - 1) * samples_per_beat;
    std::vector<Pose> result;
    // One sample before and two after the figure: central differences at both ends need them. Poses
    // beyond the clip are held.
    for (int i = -1; i <= samples + 1; ++i) {
        const double beat = static_cast<double>(i) / samples_per_beat;
        result.push_back(pose_between(poses, warp.frame_at(beat)));
    }
    return result;
}

Expected<FigureTrainingResult> train_figure(std::span<const TrainingClip> clips,
                                            std::span<const FigureRepeat> repeats,
                                            const FigureTrainingOptions& options) {
    if (auto ok = check_training(clips, repeats, options); !ok) {
        return fail(std::move(ok.error()));
    }
    FigureTrainingResult result;
    FigureModel& model = result.model;
    model.name = options.name;
    model.dance = options.dance;
    model.role = options.role;
    model.attribution = options.attribution;
    model.beats = options.beats;
    model.samples_per_beat = options.samples_per_beat;
    model.repeats = static_cast<int>(repeats.size());
    for (std::vector<double>& chances : model.contact) {
        chances.resize(options.contact_bins);
    }

    model.features = options.features;
    model.source_hips_height = mean_hips_height(clips, repeats);

    // Features of positions are those of a body with the clips' mean hip height.
    const Skeleton body = source_body(model);
    const std::vector<double> weights = weights_of(repeats);
    const std::vector<std::vector<Pose>> phased =
        phased_repeats(clips, repeats, options.samples_per_beat, options.low_pass_hz);
    // Parts are independent of each other: each has its own features, HMM and states.
    for (const Part which : parts_of(options.features)) {
        const auto p = static_cast<std::size_t>(which);
        PartModel& part = model.parts.emplace_back(
            mean_joints(which, phased, weights, options.features, options.more_joints[p]));
        std::vector<FeatureTrack> tracks;
        tracks.reserve(phased.size());
        for (const std::vector<Pose>& poses : phased) {
            tracks.push_back(features_of(poses, part, options.samples_per_beat, body));
        }
        const Expected<double> likelihood =
            learn_part(tracks, weights, model.samples(), options, part);
        if (!likelihood) {
            return fail(Error(likelihood.error()).in(std::string(kPartNames[p])));
        }
        result.log_likelihood[p] = *likelihood;
    }
    learn_net_motion(phased, clips, repeats, body, model);
    learn_feet(clips, repeats, model);
    // An error here is better than a file that the dancer refuses.
    if (auto ok = validate(model); !ok) {
        return fail(std::move(ok.error()).in("the learnt figure"));
    }
    return result;
}

Expected<double> score_repeats(const FigureModel& model,
                               Part part,
                               std::span<const TrainingClip> clips,
                               std::span<const FigureRepeat> repeats,
                               double low_pass_hz) {
    const Expected<models::HmmScorer> scorer = models::HmmScorer::create(hmm_of(model.part(part)));
    if (!scorer) {
        return fail(scorer.error());
    }
    for (const FigureRepeat& repeat : repeats) {
        if (auto ok = check_repeat(repeat, clips, model.beats); !ok) {
            return fail(std::move(ok.error()));
        }
    }
    if (repeats.empty()) {
        return fail("no repeats to score");
    }
    double sum = 0.0;
    // The same conditioning as in training, or the log-likelihoods would not be comparable.
    for (const std::vector<Pose>& poses :
         phased_repeats(clips, repeats, model.samples_per_beat, low_pass_hz)) {
        const FeatureTrack track =
            features_of(poses, model.part(part), model.samples_per_beat, source_body(model));
        sum += models::log_likelihood(*scorer, frames_of(track, 1, model.samples()));
    }
    return sum / static_cast<double>(repeats.size() * model.samples());
}

}  // namespace raks::motion
