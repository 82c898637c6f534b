#include "motion/capture/solving/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "motion/capture/solving/frame_fit.hpp"
#include "motion/capture/solving/planted_soles.hpp"
#include "motion/capture/solving/size_fit.hpp"
#include "motion/capture/solving/smoother.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

// A dancer is so tall, metres.
constexpr double kLeastHeight = 0.8;
constexpr double kMostHeight = 2.5;
// How far the true height may lie from the told one, and from the mannequin's where none was told:
// standard deviations of the logarithm of their ratio.
constexpr double kToldHeightDeviation = 0.015;
constexpr double kUntoldHeightDeviation = 0.15;
// Where the body comes out larger than the dancer was said to be by this factor, or smaller by it,
// the world's scale is wrong. Markers that sit elsewhere on the body make less of a difference.
constexpr double kWrongScaleFactor = 1.2;
// The size of the body is fitted to so many frames.
constexpr std::size_t kSizeFrames = 80;
// A marker that lies this far off counts half before the size of the body is known, metres.
constexpr double kOutlierMetresBeforeSize = 0.15;
// No marker's place is known better than this, metres.
constexpr double kLeastMarkerDeviation = 0.002;
// Markers move on the skin by so much, metres.
constexpr double kSkinMotionDeviation = 0.003;
// The variance of every place is multiplied by this, which weighs the places against the
// accelerations of the motion: then the dance that is solved from 60 raw places a second has the
// jerk of the true one.
constexpr double kPlaceVarianceFactor = 3.0;
// Tracks that were smoothed before are smoothed again by at least this share of the smoothness.
constexpr double kLeastSmoothnessShare = 0.2;

bool is_known(const MarkerPlace& place) {
    return std::isfinite(place.place.x) && std::isfinite(place.place.y) &&
           std::isfinite(place.place.z);
}

double deviation_of(const MarkerPlace& place) {
    const double deviation = std::max(kLeastMarkerDeviation, place.deviation);
    return std::sqrt(kPlaceVarianceFactor *
                     (deviation * deviation + kSkinMotionDeviation * kSkinMotionDeviation));
}

/// How much the tracks tremble from frame to frame, divided by how much they would if every place
/// had an independent error of its deviation: 1 for raw places, much less where they were smoothed.
/// It is measured on the third difference, in which the dance itself hardly shows.
double roughness(const Tracks& tracks) {
    std::vector<double> ratios;
    const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        for (std::size_t frame = 3; frame < tracks.frame_count; ++frame) {
            const glm::dvec3 third =
                tracks.at(frame, marker).place - 3.0 * tracks.at(frame - 1, marker).place +
                3.0 * tracks.at(frame - 2, marker).place - tracks.at(frame - 3, marker).place;
            const double deviation =
                std::max(kLeastMarkerDeviation, tracks.at(frame, marker).deviation);
            // Of independent errors: (1 + 9 + 9 + 1) variances along each of three axes.
            const double ratio = squared(third) / (60.0 * deviation * deviation);
            if (std::isfinite(ratio)) {
                ratios.push_back(ratio);
            }
        }
    }
    if (ratios.empty()) {
        return 1.0;
    }
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return std::sqrt(*middle);
}

/// The solver's frames are the tracks', or so many between two of them that there are as many as
/// were asked for.
class DanceSolver {
 public:
    DanceSolver(const Tracks& tracks, const MarkerSet& markers, const SolveOptions& options)
        : tracks_(tracks), markers_(markers), options_(options), model_(options.body) {
        for (const Marker& marker : markers.markers) {
            bones_.push_back(marker.bone);
        }
        asked_rate_ = options.frames_per_second.value_or(tracks.frames_per_second);
        between_ = static_cast<std::size_t>(
            std::max(1.0, std::ceil(asked_rate_ / tracks.frames_per_second - 1e-6)));
        rate_ = tracks.frames_per_second * static_cast<double>(between_);
    }

    Expected<SolvedDance> solve();

 private:
    Expected<void> see();
    Expected<void> begin_size();
    void fit_size_to(std::size_t most_frames);
    void smooth_states(int rounds);
    [[nodiscard]] std::vector<BodyState> started_states() const;
    void report_markers(SolvedDance& dance) const;
    [[nodiscard]] FrameContext context() const { return {model_, bones_, shape_, weights_}; }
    [[nodiscard]] SolvedDance result() const;
    [[nodiscard]] std::vector<std::size_t> size_frames(std::size_t most) const;

    const Tracks& tracks_;
    const MarkerSet& markers_;
    const SolveOptions& options_;
    BodyModel model_;
    std::vector<Bone> bones_;   // by marker
    double asked_rate_ = 60.0;  // of the poses
    std::size_t between_ = 1;   // solver's frames to one of the tracks
    double rate_ = 60.0;        // solver's frames a second
    FrameWeights weights_;
    SizePrior prior_;
    BodySize size_;
    BodyShape shape_;
    std::vector<FrameSight> sights_;
    std::vector<BodyState> states_;
};

Expected<void> DanceSolver::see() {
    std::vector<std::size_t> indices;  // in the set, by marker of the tracks
    for (const std::string& name : tracks_.markers) {
        const auto index = markers_.index_of(name);
        if (!index) {
            return fail(fmt::format(
                "the tracks have a marker \"{}\" that the marker set lacks; name it there",
                printable(name)));
        }
        indices.push_back(*index);
    }
    sights_.resize((tracks_.frame_count - 1) * between_ + 1);
    std::size_t most = 0;
    for (std::size_t frame = 0; frame < tracks_.frame_count; ++frame) {
        FrameSight& sight = sights_[frame * between_];
        std::size_t trunk = 0;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const MarkerPlace& place = tracks_.at(frame, i);
            if (is_known(place)) {
                sight.markers.push_back({indices[i], place.place, deviation_of(place)});
                trunk += is_of_trunk(bones_[indices[i]]) ? 1U : 0U;
            }
        }
        most = std::max(most, trunk);
    }
    if (most < 3) {
        return fail(fmt::format(
            "no frame shows 3 markers of the trunk at once (at most {}); track them again", most));
    }
    return {};
}

/// Frames with many markers, evenly over the dance.
std::vector<std::size_t> DanceSolver::size_frames(std::size_t wanted) const {
    std::size_t most = 0;
    for (const FrameSight& sight : sights_) {
        most = std::max(most, sight.markers.size());
    }
    std::vector<std::size_t> good;
    for (std::size_t frame = 0; frame < sights_.size(); ++frame) {
        if (sights_[frame].markers.size() * 5 >= most * 4) {
            good.push_back(frame);
        }
    }
    if (good.size() <= wanted) {
        return good;
    }
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < wanted; ++i) {
        chosen.push_back(good[i * (good.size() - 1) / (wanted - 1)]);
    }
    return chosen;
}

Expected<void> DanceSolver::begin_size() {
    const double guess = guess_size(model_, markers_, sights_);
    if (options_.height) {
        const double factor = guess * kMannequinHeight / *options_.height;
        if (!(factor < kWrongScaleFactor && factor > 1.0 / kWrongScaleFactor)) {
            return fail(fmt::format(
                "the markers are those of a dancer of {:.2f} m, not {:.2f}: measure the board's "
                "square, in metres; {:.3g} times what capture.toml says would fit; then calibrate "
                "again",
                guess * kMannequinHeight,
                *options_.height,
                1.0 / factor));
        }
    }
    prior_.marker_deviation = options_.marker_deviation;
    prior_.whole_deviation = options_.height ? kToldHeightDeviation : kUntoldHeightDeviation;
    prior_.whole = options_.height ? *options_.height / kMannequinHeight : 1.0;
    size_.whole = options_.height ? prior_.whole : guess;
    size_.marker_shifts.resize(markers_.markers.size());
    shape_ = shape_of(size_, markers_);
    return {};
}

void DanceSolver::fit_size_to(std::size_t most_frames) {
    std::vector<FrameSight> sights;
    std::vector<BodyState> states;
    for (const std::size_t frame : size_frames(most_frames)) {
        sights.push_back(sight_for_size(sights_[frame]));
        states.push_back(states_[frame]);
    }
    FrameWeights weights = weights_;
    weights.usual = options_.usual_posture_in_size;
    size_ = fit_size(model_, markers_, prior_, weights, sights, size_, states);
    shape_ = shape_of(size_, markers_);
}

/// The postures that were given, and between two of the tracks' frames what lies between them.
std::vector<BodyState> DanceSolver::started_states() const {
    std::vector<BodyState> states;
    for (std::size_t frame = 0; frame < sights_.size(); ++frame) {
        const std::size_t before = frame / between_;
        const std::size_t after = std::min(before + 1, options_.start.size() - 1);
        const double share = static_cast<double>(frame % between_) / static_cast<double>(between_);
        states.push_back(model_.between(options_.start[before], options_.start[after], share));
    }
    return states;
}

void DanceSolver::smooth_states(int rounds) {
    FrameContext smoothing = context();
    smoothing.weights.usual = options_.usual_posture_in_motion;
    const double smoothness =
        options_.smoothness * std::clamp(roughness(tracks_), kLeastSmoothnessShare, 1.0);
    smooth(smoothing, sights_, {rate_, rounds, smoothness}, states_);
}

Expected<SolvedDance> DanceSolver::solve() {
    if (const auto seen = see(); !seen) {
        return fail(seen.error());
    }
    if (auto begun = begin_size(); !begun) {
        return fail(std::move(begun.error()));
    }
    weights_.outlier = kOutlierMetresBeforeSize;
    states_ = options_.start.empty() ? fit_frames(context(), sights_) : started_states();
    fit_size_to(kSizeFrames);
    weights_.outlier = options_.outlier;
    fit_size_to(kSizeFrames);
    const double height = kMannequinHeight * size_.whole;
    if (!(height >= kLeastHeight && height <= kMostHeight)) {
        return fail(
            fmt::format("the markers are those of a body of {:.2f} m; are the cameras' places in "
                        "metres? Is the "
                        "board's square as capture.toml says?",
                        height));
    }
    // Soles are found in what was solved, and what is solved follows them: two rounds.
    smooth_states(4);
    for (const double done : {0.4, 0.7}) {
        if (options_.progress && !options_.progress(done)) {
            return fail("stopped");
        }
        find_planted(model_, shape_, states_, rate_, options_.standing, sights_);
        if (done < 0.5) {
            fit_size_to(kSizeFrames);
        }
        smooth_states(3);
    }
    return result();
}

void DanceSolver::report_markers(SolvedDance& dance) const {
    std::vector<double> squares(markers_.markers.size());
    std::vector<double> counts(markers_.markers.size());
    for (std::size_t frame = 0; frame < sights_.size(); frame += between_) {
        const PlacedBody body = model_.place(shape_, states_[frame]);
        for (const SeenMarker& seen : sights_[frame].markers) {
            const glm::dvec3 difference =
                body.point(bones_[seen.marker], shape_.marker_places[seen.marker]) - seen.place;
            squares[seen.marker] += glm::dot(difference, difference);
            counts[seen.marker] += 1.0;
        }
    }
    for (std::size_t i = 0; i < markers_.markers.size(); ++i) {
        dance.markers.push_back({markers_.markers[i].name,
                                 size_.marker_shifts[i],
                                 counts[i] / static_cast<double>(tracks_.frame_count),
                                 std::sqrt(squares[i] / std::max(1.0, counts[i]))});
    }
}

SolvedDance DanceSolver::result() const {
    SolvedDance dance;
    dance.skeleton = skeleton_of(size_);
    dance.size = size_;
    dance.frames_per_second = asked_rate_;
    dance.first_time = tracks_.first_time;
    const double step = rate_ / asked_rate_;
    const auto last = static_cast<double>(states_.size() - 1);
    for (double at = 0.0; at <= last + 1e-9; at = step * static_cast<double>(dance.poses.size())) {
        const auto before = static_cast<std::size_t>(std::min(at + 1e-9, last));
        const std::size_t after = std::min(before + 1, states_.size() - 1);
        const double share = std::clamp(at - static_cast<double>(before), 0.0, 1.0);
        dance.poses.push_back(
            model_.pose_of(model_.between(states_[before], states_[after], share)));
        for (std::size_t side = 0; side < 2; ++side) {
            const auto& planted = sights_[share < 0.5 ? before : after].planted[side];
            dance.poses.back().foot_contact[side] =
                *std::max_element(planted.begin(), planted.end()) > 0.5;
        }
    }
    report_markers(dance);
    dance.doubts = find_doubts(dance, tracks_, markers_);
    return dance;
}

/// Frames up to the last in which 3 markers of the trunk are known.
std::size_t frames_until_unseen(const Tracks& tracks, const MarkerSet& markers) {
    std::vector<std::size_t> trunk;
    for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
        const auto index = markers.index_of(tracks.markers[i]);
        if (index && is_of_trunk(markers.markers[*index].bone)) {
            trunk.push_back(i);
        }
    }
    std::size_t frames = tracks.frame_count;
    const auto is_seen = [&](std::size_t frame) {
        return std::count_if(trunk.begin(), trunk.end(), [&](std::size_t marker) {
                   return is_known(tracks.at(frame, marker));
               }) >= 3;
    };
    while (frames > 0 && !is_seen(frames - 1)) {
        --frames;
    }
    return frames;
}

}  // namespace

Expected<SolvedDance> solve(const Tracks& tracks,
                            const MarkerSet& markers,
                            const SolveOptions& options) {
    if (tracks.frame_count < 3 || tracks.markers.size() < 6) {
        return fail(
            fmt::format("{} markers over {} frames are too few; 6 markers and 3 frames are needed",
                        tracks.markers.size(),
                        tracks.frame_count));
    }
    if (!options.start.empty() && options.start.size() != tracks.frame_count) {
        return fail(fmt::format("{} postures are given for {} frames of the tracks; track again",
                                options.start.size(),
                                tracks.frame_count));
    }
    if (options.height && !(*options.height >= kLeastHeight && *options.height <= kMostHeight)) {
        return fail(fmt::format(
            "a dancer is {} to {} m tall, not {:.3g}", kLeastHeight, kMostHeight, *options.height));
    }
    for (const double rate : {tracks.frames_per_second, options.frames_per_second.value_or(60.0)}) {
        if (!(rate >= 1.0 && rate <= 1000.0)) {
            return fail(fmt::format("frames a second are 1 to 1000, not {:.3g}", rate));
        }
    }
    // Who has walked out of the picture does not dance on.
    const std::size_t seen = frames_until_unseen(tracks, markers);
    if (seen == tracks.frame_count || seen < 3) {
        return DanceSolver(tracks, markers, options).solve();
    }
    Tracks until = tracks;
    until.frame_count = seen;
    until.places.resize(seen * tracks.markers.size());
    SolveOptions its_options = options;
    its_options.start.resize(std::min(seen, options.start.size()));
    return DanceSolver(until, markers, its_options).solve();
}

}  // namespace raks::capture
