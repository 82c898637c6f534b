#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "audio/beat/analyzer_command.hpp"
#include "audio/beat/bar_belief.hpp"
#include "audio/beat/beat_change.hpp"
#include "audio/beat/beat_pointer.hpp"
#include "audio/beat/network/bar_network.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/tap_tempo.hpp"
#include "base/beat_grid.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the tracker gets to know of one hop.
struct TrackedHop {
    HopIndex hop = 0;
    StreamTime audio_end{};  ///< end of the audio behind this hop
    float onset_strength = 0.0F;
    /// Of the hop's mel bands (OnsetDetector::kMelBands of them, or none: changes of the sound are
    /// not heard); valid during advance() alone.
    std::span<const float> mel_magnitudes;
    bool has_evidence = false;  ///< a network listens
    int evidence_lag = 0;       ///< hops by which its evidence is late
    BeatEvidence evidence;      ///< about the hop `evidence_lag` ago
    int quiet_hops = 0;         ///< so many in a row, to this one, were too soft to tell anything
    bool is_silent = false;     ///< nothing to hear: the tempo runs on, confidence falls
};

/// From the pointer's belief to a grid that can be danced to: a second-order filter follows the
/// believed phase without its 10 ms steps, beats are announced when they are due and never revised,
/// and confidence tells whether there is a beat at all.
///
/// Threads: one. Real-time: yes.
class BeatTracker {
 public:
    BeatTracker() = default;

    /// Hears bars with this network from the next reset() on; none: by downbeats and changes alone.
    /// Real-time: no.
    void set_bar_network(std::shared_ptr<const BarNetwork> network);

    /// The dances whose numbers hint_genre gives, and their tempi; none: hints tell nothing.
    /// Real-time: no.
    void expect_dances(std::shared_ptr<const DanceList> dances) { dances_ = std::move(dances); }

    /// One hop; fills grid, beat and predicted of `state`.
    void advance(const TrackedHop& hop, MusicState& state) noexcept RAKS_NONBLOCKING;

    /// One hop inside a gap of the audio: the grid runs on.
    void advance_blind(HopIndex hop, MusicState& state) noexcept RAKS_NONBLOCKING;

    /// The audio goes on elsewhere: looks for the beat anew, keeps the tempo as a guess.
    void jump() noexcept RAKS_NONBLOCKING;

    /// Applied at its time, or at the next hop when that has passed. False: 16 wait already.
    bool command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING;

    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kCommands = 16;
    static constexpr std::size_t kRecent = 64;  // hops kept

    /// What was heard of one hop.
    struct HopEvidence {
        float strength = 0.0F;
        BeatEvidence evidence;
    };

    void run_commands(StreamTime now) noexcept;
    void apply(const AnalyzerCommand& command, StreamTime now) noexcept;
    void change_tempo(double bpm) noexcept;
    void release_tempo() noexcept;
    void change_octave(double factor) noexcept;
    void set_position(double phase) noexcept;
    void track_tempo(const TrackedHop& hop) noexcept;
    void begin_tempo() noexcept;
    void keep_tempo(double moved) noexcept;
    void run_alone() noexcept;
    void follow(const PointerEstimate& estimate, int lag_hops) noexcept;
    void track_bars(const TrackedHop& hop) noexcept;
    void forget_bars() noexcept;
    void rate_beat(const TrackedHop& hop) noexcept;
    void rate_confidence(const TrackedHop& hop) noexcept;
    void publish(HopIndex hop, MusicState& state) const noexcept;
    void announce(const TrackedHop& hop, MusicState& state) noexcept;
    [[nodiscard]] HopEvidence& evidence_at(HopIndex hop) noexcept;

    BeatPointer pointer_;
    BarBelief bars_;
    TapTempo taps_;

    // The grid at the current hop.
    double position_ = 0.0;            // beats
    double beats_per_hop_ = 1.0 / 50;  // 120 BPM
    double nudge_hops_ = 0.0;          // the user's, later is positive
    bool is_tempo_held_ = false;
    std::shared_ptr<const DanceList> dances_;
    DanceId hint_ = DanceId::none;
    double steady_rate_ = 1.0 / 50;    // beats a hop over the last beats, corrections included
    double steady_beats_ = 1.0;        // over which it is averaged
    double followed_rate_ = 1.0 / 50;  // the same when a network last heard anything like a beat
    double drift_ = 0.0;               // beats from where the grid would be, had it gone on so
    int hops_without_ = 0;             // hops since a network last heard anything like a beat
    int hops_apart_ = 0;               // hops in a row in which belief and grid disagreed
    int hops_with_evidence_ = 0;       // hops with evidence since reset or jump

    // What is heard of bars over a beat's time, told when the next one comes.
    BeatChange changes_;
    BarInput bar_input_;
    std::optional<BarNetworkStream> bar_stream_;
    long sounding_beat_ = 0;                   // that goes on
    float change_ = 0.0F;                      // at the beat before it
    std::optional<BarEvidence> bar_evidence_;  // of the beat before it

    // Confidence.
    std::array<HopEvidence, kRecent> recent_{};  // by hop, ring
    long rated_beat_ = 0;                        // last beat that was rated
    int beats_rated_ = 0;
    float contrast_ = 0.0F;  // evidence on the beats, running mean
    float mass_ = 0.0F;      // the pointer's, smoothed
    float confidence_ = 0.0F;

    // Announcements.
    long next_beat_ = 0;
    long next_predicted_ = 0;
    StreamTime last_beat_time_{std::chrono::seconds(-10)};
    StreamTime last_predicted_time_{std::chrono::seconds(-10)};

    std::array<AnalyzerCommand, kCommands> commands_{};
    std::size_t command_count_ = 0;
};

}  // namespace raks::audio
