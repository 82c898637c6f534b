// Angle filter: the posture of one frame by annealed particles (paper, section 3.3; Deutscher and
// Reid 2005).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "motion/capture/angles/body_links.hpp"
#include "motion/capture/angles/frame_marks.hpp"
#include "motion/capture/angles/posture_weigher.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/solving/frame_system.hpp"

namespace raks::capture {

/// What of the body is sought at once.
enum class FilterKind {
    partitioned,  ///< the trunk, then each limb by its own markers, then all a little
    full,         ///< all of it, as the paper has it
};

/// How a posture is sought.
struct AngleFilterOptions {
    FilterKind filter = FilterKind::partitioned;
    Likelihood likelihood = Likelihood::reprojection;
    std::size_t particles = 300;      ///< 8 or more
    std::size_t layers = 10;          ///< 3 or more
    bool is_polished = true;          ///< a short least-squares fit follows
    double sigma = 1.0;               ///< error of a spot, pixels of its camera
    double frames_per_second = 30.0;  ///< of the frames
    std::uint64_t seed = 1;           ///< same seed, same postures
    int threads = 1;                  ///< any number of them gives the same bits
};

/// How far the variables of a model may move between two frames, beyond what their velocity
/// tells: standard deviations, metres and radians. The layers begin with it.
[[nodiscard]] std::vector<double> motion_scale(const BodyModel& model, double frames_per_second);

/// How a limb was seen in the frames before.
enum class LimbSight : std::uint8_t {
    seen,    ///< where it was thought to be
    missed,  ///< not seen there: it is sought farther away, too, and where it was at other times
    astray,  ///< for several frames: it is sought everywhere
};

/// What is known before a frame.
struct PostureGuess {
    const BodyState& predicted;
    /// Postures of the same body from which limbs are taken that were not seen.
    const std::vector<BodyState>& known;
    /// By limb of the division: how it was seen before. Empty: all were.
    std::vector<LimbSight> limbs{};
};

/// A posture that was found.
struct FilteredPosture {
    BodyState state;
    /// By variable: standard deviation, metres and radians, as the particles' spread tells: by how
    /// much the weights draw them together, at what the spots' own error is.
    std::vector<double> deviations;
};

/// Finds postures, frame after frame. Threads: one caller; it uses `threads` of its own.
class AngleFilter {
 public:
    /// What `context` refers to must outlive it.
    AngleFilter(const FrameContext& context, const AngleFilterOptions& options);

    /// How much of its velocity the prediction of the next frame keeps, [0, 1]: a polished posture
    /// is noisier in what is hardly seen.
    [[nodiscard]] double kept_velocity() const noexcept;

    /// The posture of a frame. `number`: of the frame, for the random numbers.
    [[nodiscard]] FilteredPosture find(const FrameMarks& marks,
                                       const PostureGuess& guess,
                                       std::uint64_t number);

    /// How the body is divided.
    [[nodiscard]] const BodyDivision& division() const noexcept { return division_; }

 private:
    struct Stage;

    [[nodiscard]] Stage part_of(const Stage& whole,
                                const JointGroup& group,
                                std::uint64_t number) const;
    void run_parts(const Stage& whole, const PostureGuess& guess);
    void run_astray(const Stage& whole, const PostureGuess& guess);
    void run(const Stage& stage);
    void diffuse(const Stage& stage, std::size_t layer, std::size_t first, std::size_t last);
    void scatter(const Stage& stage);
    [[nodiscard]] glm::dvec3 drawn_turn(const CounterRandom& random,
                                        std::size_t index,
                                        std::size_t particle) const;
    void put_joint(const Stage& stage,
                   std::size_t index,
                   std::size_t particle,
                   const glm::dvec3& turn);
    void gather(const Stage& stage, std::span<const float> weights);
    void measure_spread(const Stage& stage, std::span<const float> weights, double beta);

    FrameContext context_;
    AngleFilterOptions options_;
    BodyLinks links_;
    BodyDivision division_;
    std::vector<double> scale_;
    PostureChanges changes_;
    std::vector<double> deviations_;
};

}  // namespace raks::capture
