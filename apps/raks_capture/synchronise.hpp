#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "audio/sync/clock_line.hpp"
#include "base/expected.hpp"
#include "motion/capture/markers/observations.hpp"

/// The clocks of a capture's cameras from the sound of their films.
namespace raks::apps {

/// Longest film or song whose sound is compared, seconds: seven of them take 700 MB.
inline constexpr double kLongestTake = 1'200.0;
/// A clock with less confidence is doubtful.
inline constexpr double kDoubtfulConfidence = 0.5;
/// Two ways to a clock that differ by more than this are doubtful, seconds.
inline constexpr double kDoubtfulDisagreement = 0.005;

/// A camera and the file with its sound.
struct CameraSound {
    std::string camera;              ///< its name in the rig
    std::filesystem::path file;      ///< film or sound; empty: none
    std::optional<double> metres{};  ///< from the loudspeaker
};

/// What is to be synchronised.
struct SyncPlan {
    std::vector<CameraSound> cameras;
    std::optional<std::filesystem::path> music{};  ///< the song as it was played
    std::vector<capture::Clock> by_hand{};         ///< count before what the sound says
    /// As audio::JointOptions.
    double most_offset = std::numeric_limits<double>::infinity();
    int threads = 1;
    std::optional<double> start{};  ///< capture time at which the dance will begin
};

/// One camera's clock and how it came about.
struct CameraSync {
    std::string camera;
    std::optional<capture::Clock> clock;  ///< nothing: it cannot be told
    bool is_by_hand = false;
    bool is_by_motion = false;  ///< of what moves in the films, not of their sound
    std::string through;        ///< camera or song that it was compared with; empty: none
    std::size_t used = 0;       ///< stretches of 5 s that agree
    std::size_t compared = 0;   ///< of so many
    double disagreement = 0.0;  ///< as audio::JointClock, seconds
};

/// The song's clock.
struct SongSync {
    audio::ClockLine line;    ///< capture time of the song's time
    double confidence = 0.0;  ///< [0, 1]

    /// Seconds of the song at a capture time: where the dance begins, the `--offset` of
    /// `raks train figure --music`.
    [[nodiscard]] double song_time(double capture_time) const noexcept {
        return line.inverse().at(capture_time);
    }
};

/// All of a capture.
struct SyncResult {
    std::vector<CameraSync> cameras;    ///< in the plan's order
    std::optional<SongSync> song;       ///< nothing: none was given, or no camera heard it
    std::vector<std::string> warnings;  ///< one line each, for people
    bool is_whole = true;               ///< every camera has a clock, and the song too

    /// Those that are known.
    [[nodiscard]] std::vector<capture::Clock> clocks() const;
};

/// Reads the sound of all films (audio/io) and aligns it (audio/sync/joint_alignment.hpp). The
/// capture's clock is that of the first camera of the largest group that hears the same; where it
/// is set by hand, what that says. What fails for one camera is a warning, and it has no clock.
/// `progress` is called with the share done, [0, 1], from one thread at a time; once it returns
/// false the rest is left out.
/// Errors: a clock by hand for a camera that is not there; no camera.
[[nodiscard]] Expected<SyncResult> synchronise(const SyncPlan& plan,
                                               const std::function<bool(double)>& progress = {});

}  // namespace raks::apps
