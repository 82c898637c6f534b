#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/figures/size_by_tempo.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>

/// One dance figure as learnt from people: what `raks train figure` writes and the dancer dances.
///
/// **Time base.** Everything is a function of the figure's *phase*, counted in beats from count 1
/// (phase 0) to `beats`. The phase axis carries `samples_per_beat` equidistant samples a beat, so a
/// figure has T = beats x samples_per_beat samples and sample i lies at phase i / samples_per_beat.
/// Features, deltas and the HMM's steps are per *sample*; velocities inside the features are per
/// *beat*. A figure thus knows no seconds: the dancer paces it by the tracked beat.
///
/// **Space.** Right-handed, metres of the source body, y up, heading 0 faces +z, positive turns
/// from +z towards +x (right-hand rule about +y).
namespace raks::motion {

/// Parts of the body, each with an HMM of its own.
enum class Part : std::uint8_t { torso, upper, lower };
/// All parts, in the order of the enumeration.
inline constexpr std::array<Part, 3> kParts = {Part::torso, Part::upper, Part::lower};
/// Names in files, by Part.
inline constexpr std::array<std::string_view, 3> kPartNames = {"torso", "upper", "lower"};

/// What the parts are made of: rotations of joints (torso, upper, lower), or their places in space
/// (upper and lower; Ofli 2008, section 4.1: joint-position figures).
enum class FigureFeatures : std::uint8_t { angles, positions };
/// Names in files, by FigureFeatures.
inline constexpr std::array<std::string_view, 2> kFeaturesNames = {"angles", "positions"};

/// The parts of a figure with such features, in the order of its file.
[[nodiscard]] std::span<const Part> parts_of(FigureFeatures features) noexcept;

/// Which partner of a couple.
enum class DanceRole : std::uint8_t { lead, follow };
/// Names in files, by DanceRole.
inline constexpr std::array<std::string_view, 2> kRoleNames = {"lead", "follow"};

/// How the body moves as a whole, in this order. Angles: the torso's first six features; three of
/// each spine joint follow. Positions: the first three lead the lower part.
enum class RootFeature : std::uint8_t {
    velocity_left,     ///< heading-local +x; metres a beat
    velocity_forward,  ///< heading-local +z; metres a beat
    yaw_rate,          ///< radians a beat
    height,            ///< of the hips over the floor; metres
    tilt_x,            ///< exponential map of the hips' rotation without its heading, x; radians
    tilt_z,  ///< the same, z (the part about the vertical is zero by definition and left out)
};
inline constexpr std::size_t kRootFeatures = 6;    ///< of angles
inline constexpr std::size_t kTravelFeatures = 3;  ///< of positions: those of travel alone

/// A joint that is a feature, three numbers. Angles: the exponential map (axis x angle, radians, in
/// the joint's frame) of `mean^-1 * local rotation`. Positions: its place (x left, y up, z forward)
/// seen from the point on the floor under the hips, heading as they do; metres of the source body.
struct JointFeature {
    Bone bone = Bone::hips;               ///< whose joint
    glm::dquat mean{1.0, 0.0, 0.0, 0.0};  ///< unit; angles only
};

/// What one state says of each feature: a Gaussian over value, delta and delta-delta, all of
/// length D (the part's dimension). With x(i) the feature at sample i:
///     delta(i)       = (x(i+1) - x(i-1)) / 2
///     delta_delta(i) = x(i+1) - 2 x(i) + x(i-1)
/// (Tokuda et al. 2000, windows of three samples). At the ends of a figure the neighbours come
/// from the motion around it. `mean` is also the mean of the HMM's emission.
struct FigureState {
    std::vector<double> mean;                  ///< of the value
    std::vector<double> variance;              ///< > 0
    std::vector<double> delta_mean;            ///< of delta
    std::vector<double> delta_variance;        ///< > 0
    std::vector<double> delta_delta_mean;      ///< of delta_delta
    std::vector<double> delta_delta_variance;  ///< > 0
};

/// Covariance of the states' emissions: one for all states (the paper's), or one for each.
enum class CovarianceKind : std::uint8_t { tied, full, diagonal };
/// Names in files, by CovarianceKind.
inline constexpr std::array<std::string_view, 3> kCovarianceKindNames = {
    "tied", "full", "diagonal"};

/// How long a state lasts in the repeats it was learnt from.
struct StateStay {
    Beats mean{};       ///< over the repeats
    Beats deviation{};  ///< standard deviation between repeats
};

/// A left-to-right HMM of one part of the body, with its states on equal slices of the phase:
/// state k of N spans [k, k+1) x beats / N.
struct PartModel {
    Part part = Part::torso;                           ///< which part
    FigureFeatures features = FigureFeatures::angles;  ///< as the figure's
    std::vector<JointFeature> joints;                  ///< after the root features
    std::vector<FigureState> states;                   ///< N, at least 1

    std::vector<double> initial;                  ///< N, sums to 1
    std::vector<std::vector<double>> transition;  ///< N x N; row + its exit sums to 1
    std::vector<double> exit;  ///< N: chance that the figure ends after the state
    std::vector<std::vector<double>> covariance;  ///< D x D, of all states; positive definite
    /// Whether states have covariances of their own
    CovarianceKind covariance_kind = CovarianceKind::tied;
    /// Unless tied, of each state: full D x D, positive definite; diagonal 1 x D, > 0.
    std::vector<std::vector<std::vector<double>>> state_covariances;

    /// Beats against states (Ofli 2008, section 4.1): row c, column k is the share of count c + 1,
    /// over the repeats learnt from, that the HMM's Viterbi path spends in state k. beats x N, rows
    /// sum to 1.
    std::vector<std::vector<double>> occurrence;
    std::vector<StateStay> stays;  ///< N, by the same paths

    /// Within one human repeat the variance of each feature over the phase, mean over the repeats:
    /// what a mean trajectory is scaled to so that averaging does not shrink the dance. D, > 0.
    std::vector<double> global_variance;

    /// How many of RootFeature come first.
    [[nodiscard]] std::size_t root_features() const noexcept {
        if (features == FigureFeatures::positions) {
            return part == Part::lower ? kTravelFeatures : 0;
        }
        return part == Part::torso ? kRootFeatures : 0;
    }
    /// D: features of one sample.
    [[nodiscard]] std::size_t dimension() const noexcept {
        return root_features() + 3 * joints.size();
    }
    /// The state of sample i of a figure of T samples, 0 <= i < T.
    [[nodiscard]] std::size_t state_at(std::size_t sample, std::size_t samples) const noexcept {
        return sample * states.size() / samples;
    }
};

/// When one foot lands at one count: distance from the count, late is positive. (Landing: the
/// foot's speed, mean of ankle and toe tip, falls under 0.30 m/s after a step over 0.6 m/s.)
struct LandingOffset {
    int repeats = 0;    ///< how many repeats had one; 0: this foot does not step here
    Beats median{};     ///< over the landings
    Beats deviation{};  ///< standard deviation

    /// Whether there is one moment at which the foot should come down: at least `least` of the
    /// figure's repeats had a landing, and hardly any had two.
    [[nodiscard]] bool is_one(int least, int of_repeats) const noexcept {
        constexpr double kOnce = 1.1;  // landings a repeat
        return repeats >= least && repeats <= kOnce * of_repeats;
    }
};

/// By Side, then by count 1..beats (index 0 is count 1).
using FigureLandings = std::array<std::vector<LandingOffset>, 2>;

inline constexpr std::size_t kContactBins = 64;  ///< over one figure; a take has more

/// One figure: name, timing, parts and feet.
struct FigureModel {
    static constexpr std::string_view kFormat = "raks-figure";  ///< of the file
    static constexpr int kVersion = 2;  ///< of positions; angles are written as version 1

    std::string name;                  ///< "basic"
    std::string dance;                 ///< "salsa", a genre label
    DanceRole role = DanceRole::lead;  ///< whose steps these are
    std::string attribution;           ///< of the takes it was learnt from

    int beats = 8;              ///< length; 1 to 64
    int samples_per_beat = 24;  ///< 4 to 200
    Bpm learnt_tempo{120.0};    ///< mean over the repeats
    int repeats = 0;            ///< how many it was learnt from

    FigureFeatures features = FigureFeatures::angles;  ///< of all parts
    std::vector<PartModel> parts;                      ///< parts_of(features)

    /// From the first sample to the sample at phase `beats`: place in metres in the heading frame
    /// of the start (x left, y forward), and turn in radians.
    glm::dvec2 net_displacement{0.0, 0.0};
    double net_turn = 0.0;  ///< see above

    /// Height of the hips over the sole in the source's T-pose, the hips' joint where the built-in
    /// mannequin has it in the pelvis; metres. Lengths of the root's features scale by (target's
    /// hips height) / this.
    double source_hips_height = 1.0;

    /// Speed of the faster toe tip at its fastest (10 Hz low-pass), median over the repeats, at the
    /// learnt tempo; metres a second. A mean over repeats dances smaller: it is widened to this.
    double peak_toe_speed = 3.0;

    /// Chance [0, 1] that the toe of a side rests on the floor; bin j of N spans the phase
    /// [j, j+1) x beats / N. By Side; as many for both.
    std::array<std::vector<double>, 2> contact{std::vector<double>(kContactBins),
                                               std::vector<double>(kContactBins)};
    /// How far each hand is closed, [0, 1] (motion/skeleton/pose.hpp), by Side: one number,
    /// or kContactBins as of `contact`; none: not known, captures have no fingers.
    std::array<std::vector<double>, 2> fist;
    SizeByTempo size_by_tempo;  ///< zero for captured figures: nothing is known
    FigureLandings landings;    ///< learnt landings, by Side and count

    /// A part of the figure, which must exist: positions have no torso.
    [[nodiscard]] const PartModel& part(Part which) const noexcept;
    /// The part whose first features are the root features.
    [[nodiscard]] const PartModel& root_part() const noexcept;
    /// T: samples of one figure.
    [[nodiscard]] std::size_t samples() const noexcept {
        return static_cast<std::size_t>(beats) * static_cast<std::size_t>(samples_per_beat);
    }
};

/// The joints of each part, in the order of the features: spine, chest, neck; shoulder, upper arm,
/// lower arm of the left, then of the right; upper leg, lower leg, foot of the left, then right.
/// Of positions: spine, chest, neck, head, then upper arm, lower arm and hand of both sides; upper
/// leg, lower leg, foot and toes of both sides.
[[nodiscard]] std::vector<Bone> default_joints(Part part,
                                               FigureFeatures features = FigureFeatures::angles);

/// Checks everything that the dancer relies on. The error names the first wrong field, its value
/// and what it must be: `parts[0].states[3].variance[0] is -0.2, must be > 0`. Threads: any.
/// Real-time: no.
[[nodiscard]] Expected<void> validate(const FigureModel& model);

/// Reads and validates a model file (JSON, at most 64 MiB). Errors, one line: not readable, not
/// JSON, another format, a newer version, a missing or wrong field.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureModel> load_figure(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<FigureModel> parse_figure(std::string_view json, const std::string& name);

/// The file's text: numbers in their shortest form that reads back to the same bits.
[[nodiscard]] std::string figure_text(const FigureModel& model);

/// Validates and writes (whole or not at all).
[[nodiscard]] Expected<void> save_figure(const FigureModel& model,
                                         const std::filesystem::path& path);

}  // namespace raks::motion
