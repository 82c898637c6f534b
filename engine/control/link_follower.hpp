#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "audio/beat/analyzer_command.hpp"
#include "base/beat_grid.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Makes the beats those of a session that other programs share: tempo, phase and count 1, by what
/// is heard. Pure; it knows no network. Threads: one.
class LinkFollower {
 public:
    /// How session and music stand at one moment.
    struct Look {
        HostTime now{};         ///< the moment
        std::size_t peers = 0;  ///< of the session; 0: the music leads
        double bpm = 120.0;     ///< of the session
        double beat = 0.0;      ///< of the session at `now`, in a bar of session_bar() beats
        BeatGrid grid = {};     ///< of the music, as it is known
        Beats heard{};          ///< its position that is heard at `now`
        bool is_held = false;   ///< its tempo
    };
    /// A command for the beat tracker.
    struct Order {
        audio::AnalyzerCommand::Kind kind{};  ///< set_tempo, set_beat, resync_bar, release_tempo
        double value = 0.0;                   ///< of it
        HostTime heard_at{};                  ///< when what it is about is heard
    };

    /// How many of the session's beats are a bar of the music: the session may be too slow or too
    /// fast to be danced to, and is then followed at half or double tempo.
    [[nodiscard]] static double session_bar(double bpm, int beats_per_bar) noexcept;

    /// What the tracker is to be told now, in this order. It needs a while to do it, so that this
    /// comes at most twice a second.
    [[nodiscard]] std::vector<Order> follow(const Look& look);
    /// How far the heard beat was behind the session's in the last look; negative: ahead.
    [[nodiscard]] Nanos behind() const noexcept { return behind_; }

 private:
    bool is_following_ = false;
    HostTime next_order_{};
    Nanos behind_{};
};

}  // namespace raks::engine
