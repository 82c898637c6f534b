#include "motion/capture/angles/angle_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/dice.hpp"
#include "motion/capture/angles/angle_run.hpp"
#include "motion/capture/angles/unsure_joints.hpp"
#include "motion/capture/solving/size_fit.hpp"
#include "motion/capture/tracking/agreeing_cameras.hpp"
#include "motion/capture/tracking/track_flags.hpp"
#include "motion/capture/tracking/tracking_plan.hpp"

namespace raks::capture {
namespace {

// The body is fitted to so many seconds from the first posture on, and to so many frames of them.
constexpr double kFittedSeconds = 3.4;
constexpr std::size_t kFittedFrames = 100;
constexpr int kFittedRounds = 2;
// A marker that lies this far off counts half, metres, by round: at first the body is wrong.
constexpr double kOutlierMetres[kFittedRounds] = {0.15, 0.04};
// How far a body may be from what its height says: standard deviations, of lengths their
// logarithms.
constexpr double kToldSizeDeviation = 0.015;
constexpr double kUntoldSizeDeviation = 0.15;
constexpr double kPartDeviation = 0.03;
constexpr double kBoneDeviation = 0.01;
constexpr double kMarkerDeviation = 0.008;  // metres
// What is usual in a posture is not the average of some seconds.
constexpr double kUsualPostureWeight = 0.3;
// Without a height and labels the body is sought at these sizes, times the mannequin.
constexpr double kSoughtSizes[] = {1.0, 0.9, 1.1};

/// A body whose markers and size are known so far.
struct TrackedBody {
    MarkerSet markers;
    BodySize size;
    BodyShape shape;
};

// Makes a body wrong: each bone and each place on it by another factor.
void spoil(double error, std::uint64_t seed, TrackedBody& body) {
    Dice dice(seed, 620);
    for (Marker& marker : body.markers.markers) {
        marker.place *= 1.0 + dice.normal(error);
    }
    for (std::size_t i = 1; i < body.size.bones.size(); ++i) {
        body.size.bones[i] *= 1.0 + dice.normal(error);
    }
}

/// All that runs of one take share.
class TakeRuns {
 public:
    TakeRuns(const TrackingPlan& plan,
             const TrackerOptions& options,
             const AngleTrackerOptions& angles)
        : plan_(plan), options_(options), angles_(angles), filter_(angles.filter) {
        filter_.sigma = options.sigma;
        filter_.frames_per_second = options.frames_per_second;
        weights_.usual = 0.05;
        for (const Marker& marker : plan.input->markers.markers) {
            bones_.push_back(marker.bone);
        }
        body_.markers = plan.input->markers;
        body_.size.whole = options.height > 0.0 ? options.height / kMannequinHeight : 1.0;
        if (angles.body_error > 0.0) {
            spoil(angles.body_error, filter_.seed, body_);
        }
        body_.shape = shape_of(body_.size, body_.markers);
        first_size_ = body_.size;
    }

    // Finds the size of the body in the first seconds, then follows it with that.
    Expected<void> fit_body() {
        FrameViews views = plan_.all_views();
        AngleTrackerOptions quiet = angles_;
        quiet.progress = [this](double) { return !angles_.progress || angles_.progress(0.0); };
        auto start = begin_at_some_size(views, quiet);
        if (!start) {
            return fail(std::move(start.error()));
        }
        for (int round = 0; angles_.fits_body && round < kFittedRounds; ++round) {
            AngleRun run(plan_.run, views, plan_.line.frame_count, context(), quiet, filter_);
            start = run.begin();
            if (!start) {
                break;  // what was found before stays
            }
            const FrameRange range = first_seconds(*start);
            run.follow(*start, range);
            fit_size_to(run, range, round);
        }
        return {};
    }

    // Follows the body through the whole take.
    Expected<AngleStages> follow() {
        std::vector<AngleTrack> runs;
        std::optional<Error> error;
        const Followed followed = follow_what_agrees(
            plan_, [&](const TrackRunInput& input, FrameViews& views, std::size_t frames) {
                AngleRun run(input, views, frames, context(), angles_, filter_);
                const auto start = run.begin();
                if (!start) {
                    error = start.error();
                    return std::vector<TrackedMarker>(frames * input.classes.size());
                }
                run.follow(*start, run.all());
                if (filter_.is_polished) {
                    run.refine_all();
                }
                auto tracked = run.tracked(run.all());
                runs.push_back(std::move(run.track()));
                return tracked;
            });
        if (error) {
            return fail(std::move(*error));
        }
        const Tracks empty = plan_.empty_tracks();
        AngleStages result{
            {empty, empty, empty, followed.moves}, runs[followed.call], body_.shape, body_.size};
        result.angles.first_time = plan_.line.first;
        fill_stages(followed.tracked,
                    plan_.run,
                    options_.smoothing,
                    result.stages.triangulated,
                    result.stages.filtered,
                    result.stages.smoothed);
        flag_unsure_joints(result.angles, angles_.body, bones_, result.stages.smoothed);
        return result;
    }

 private:
    [[nodiscard]] FrameContext context() const {
        return {angles_.body, bones_, body_.shape, weights_};
    }

    // The first posture, with a body of the told height or of the first size that is found.
    Expected<std::size_t> begin_at_some_size(FrameViews& views, const AngleTrackerOptions& quiet) {
        std::optional<Error> error;
        const double told = body_.size.whole;
        for (const double factor : kSoughtSizes) {
            body_.size.whole = told * factor;
            body_.shape = shape_of(body_.size, body_.markers);
            AngleRun run(plan_.run, views, plan_.line.frame_count, context(), quiet, filter_);
            auto start = run.begin();
            if (start) {
                return start;
            }
            error = error ? error : std::move(start.error());
            if (options_.height > 0.0 || !plan_.run.said.empty()) {
                break;
            }
        }
        return fail(std::move(*error));
    }

    [[nodiscard]] FrameRange first_seconds(std::size_t start) const {
        const auto frames = static_cast<std::size_t>(kFittedSeconds * options_.frames_per_second);
        const std::size_t end = std::min(plan_.line.frame_count, start + frames);
        return {end - std::min(frames, end), end};
    }

    void fit_size_to(AngleRun& run, FrameRange range, int round) {
        const std::vector<TrackedMarker> tracked = run.tracked(range);
        std::vector<FrameSight> sights;
        std::vector<BodyState> states;
        const std::size_t step =
            std::max<std::size_t>(1, (range.end - range.first) / kFittedFrames);
        for (std::size_t frame = range.first; frame < range.end; frame += step) {
            if (!run.track().is_lost[frame]) {
                sights.push_back(sight_for_size(sight_of(tracked, frame - range.first)));
                states.push_back(run.track().states[frame]);
            }
        }
        SizePrior prior;
        const bool is_told = options_.height > 0.0;
        prior.whole = is_told ? options_.height / kMannequinHeight : body_.size.whole;
        prior.whole_deviation = is_told ? kToldSizeDeviation : kUntoldSizeDeviation;
        prior.part_deviation = kPartDeviation;
        prior.bone_deviation = kBoneDeviation;
        prior.marker_deviation = kMarkerDeviation;
        FrameWeights weights = weights_;
        weights.outlier = kOutlierMetres[round];
        weights.usual = kUsualPostureWeight;
        BodySize begin = first_size_;
        begin.whole = body_.size.whole;
        body_.size = fit_size(angles_.body, body_.markers, prior, weights, sights, begin, states);
        body_.shape = shape_of(body_.size, body_.markers);
    }

    // The markers of a frame that two cameras or more saw. `index`: of the frame in `tracked`.
    [[nodiscard]] FrameSight sight_of(const std::vector<TrackedMarker>& tracked,
                                      std::size_t index) const {
        FrameSight sight;
        for (std::size_t marker = 0; marker < bones_.size(); ++marker) {
            const TrackedMarker& seen = tracked[index * bones_.size() + marker];
            if (seen.measured && !seen.is_of_body) {
                const glm::dmat3& c = seen.measured->covariance;
                sight.markers.push_back(
                    {marker, seen.measured->place, std::sqrt((c[0][0] + c[1][1] + c[2][2]) / 3.0)});
            }
        }
        return sight;
    }

    const TrackingPlan& plan_;
    const TrackerOptions& options_;
    const AngleTrackerOptions& angles_;
    AngleFilterOptions filter_;
    FrameWeights weights_;
    std::vector<motion::Bone> bones_;  // by marker
    TrackedBody body_;
    BodySize first_size_;  // before anything was fitted
};

}  // namespace

Expected<AngleStages> track_angles(const TrackerInput& input,
                                   const TrackerOptions& options,
                                   const AngleTrackerOptions& angles) {
    const auto plan = plan_tracking(input, options, LabelNeed::not_needed);
    if (!plan) {
        return fail(plan.error());
    }
    TakeRuns runs(*plan, options, angles);
    if (auto fitted = runs.fit_body(); !fitted) {
        return fail(std::move(fitted.error()));
    }
    return runs.follow();
}

}  // namespace raks::capture
