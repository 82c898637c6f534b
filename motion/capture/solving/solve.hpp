// Solve: from marker tracks to a body that dances.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/solving/standing_sole.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::capture {

/// How a dance is solved.
struct SolveOptions {
    std::optional<double> height{};             ///< of the dancer, metres; none: from the markers
    BodyModel body{BodyKind::dance};            ///< which joints move
    std::optional<double> frames_per_second{};  ///< of the poses; none: the tracks'
    /// How far markers sit from where the set has them: standard deviation along each axis, metres.
    double marker_deviation = 0.015;
    /// A marker that lies so far off the body counts half, once the body's size is known; metres.
    double outlier = 0.04;
    /// Weights of the usual posture in a frame, against 1 when a single frame is fitted. When the
    /// size is fitted to many frames, what is usual in each of them is not the average of all. When
    /// the motion is smoothed, the frames around tell more of a joint that is not measured than
    /// what is usual.
    double usual_posture_in_size = 0.3;
    double usual_posture_in_motion = 0.05;
    double smoothness = 1.0;  ///< > 1: the dancer is expected to move more softly
    StandingSole standing{};  ///< which soles are held to the floor
    /// By frame of the tracks: postures of the model from which the body and its motion are fitted.
    /// None: they are found in the tracks, each frame by itself.
    std::vector<BodyState> start{};
    /// Called with the share done, [0, 1], between the stages; once it returns false, solve ends
    /// with an error.
    std::function<bool(double)> progress{};
};

/// How well a marker fits the solved body.
struct MarkerFit {
    std::string name;
    glm::dvec3 shift{};       ///< from its place in the set to that found, in its bone's frame
    double seen = 0.0;        ///< share of the frames in which it is known
    double difference = 0.0;  ///< root mean square from where it was measured, metres
};

/// What is doubtful about a stretch of the solved dance.
struct SolveDoubt {
    std::string what;       ///< "left_wrist is 6.2 cm off", "3 markers seen"
    std::size_t first = 0;  ///< frame of the tracks
    std::size_t last = 0;   ///< frame of the tracks, included
};

/// A solved dance.
struct SolvedDance {
    motion::Skeleton skeleton;        ///< the dancer's
    BodySize size;                    ///< how it differs from the mannequin
    std::vector<motion::Pose> poses;  ///< over a floor at y = 0, with foot contacts
    double frames_per_second = 0.0;   ///< of the poses
    double first_time = 0.0;          ///< capture time of the first pose; seconds
    std::vector<MarkerFit> markers;   ///< by marker of the set
    std::vector<SolveDoubt> doubts;   ///< by first frame
};

/// Solves a body and its motion from tracks over a floor at y = 0.
///
/// The body is the mannequin with ten lengths and the place of each marker fitted to the take,
/// both held by what is usual. Its motion is the most likely one given the tracks, each place
/// weighted by its deviation (outliers count little), joint limits, soles that stand still on the
/// floor, and accelerations like dancers': one least-squares problem over all frames.
///
/// It ends with the last frame in which three markers of the trunk are known: nothing is made up
/// for a dancer who has left.
///
/// Errors, one line: a track whose marker the set lacks, fewer than 6 markers or 3 frames, fewer
/// than 3 markers of the trunk in every frame, another number of starts than of frames, rates
/// outside of 1 to 1,000 a second, a height outside of 0.8 to 2.5 m, a body whose markers give such
/// a height, or one that is off by a fifth from the height that was told: the board was of another
/// size, or units are wrong. Deterministic. Threads: workers. Real-time: no (some 100 frames a
/// second).
[[nodiscard]] Expected<SolvedDance> solve(const Tracks& tracks,
                                          const MarkerSet& markers,
                                          const SolveOptions& options = {});

/// Finds what is doubtful: stretches of 0.1 s or longer in which a marker is 5 cm or more from the
/// solved body, fewer than 3 markers of the trunk are seen, or a joint is 5 degrees or more beyond
/// its limits. `dance`: as solve() made it, without doubts.
[[nodiscard]] std::vector<SolveDoubt> find_doubts(const SolvedDance& dance,
                                                  const Tracks& tracks,
                                                  const MarkerSet& markers);

/// The solved body as a TOML file (`body.toml`): height, lengths by part, and each marker's place,
/// shift and difference.
[[nodiscard]] std::string body_text(const SolvedDance& dance, const MarkerSet& markers);

}  // namespace raks::capture
