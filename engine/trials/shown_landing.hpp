#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "engine/live/clock_map.hpp"
#include "engine/trials/loop_recorder.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// One picture as `play` would have shown it.
struct ShownPicture {
    HostTime at{};                ///< CLOCK_MONOTONIC when it was drawn: late wake-ups stay late
    StreamTime moment{};          ///< of the music, as the graph chose it
    engine::ClockLine clock;      ///< of the graph, then
    bool is_dancing = false;      ///< false while the dancer stands
    double octave = 1.0;          ///< dance beats per beat of the music
    std::uint32_t reanchors = 0;  ///< how often count 1 was set anew before
    motion::Pose pose;            ///< of the measured dancer, as drawn
};

/// Relates host time and the music that was out at it: straight lines between the beats that were
/// recorded.
class SoundLine {
 public:
    /// `heard`: two or more, ascending.
    SoundLine(std::span<const AudibleBeat> heard, const audio::GeneratedMusic& music);

    /// Place in the music (seconds of the stream) of what was out at `host`; beyond the ends the
    /// nearest line goes on.
    [[nodiscard]] double stream_seconds_at(HostTime host) const;
    /// Inverse of stream_seconds_at.
    [[nodiscard]] HostTime host_at(double stream_seconds) const;
    /// True between the first and the last recorded beat.
    [[nodiscard]] bool covers(HostTime host) const;

 private:
    HostTime origin_;
    std::vector<double> host_;    // seconds since origin_
    std::vector<double> stream_;  // seconds
};

/// For each recorded beat: how long after its hand-over (by the graph's clock) it was out; ms.
[[nodiscard]] std::vector<double> loop_latencies_ms(std::span<const AudibleBeat> heard,
                                                    const audio::GeneratedMusic& music,
                                                    std::span<const ShownPicture> pictures);

/// For each picture: how far its moment lies ahead of what was out when it was drawn; ms.
[[nodiscard]] std::vector<double> picture_leads_ms(std::span<const ShownPicture> pictures,
                                                   const SoundLine& sound);

/// Landings of the shown poses against the beats that were out.
struct ShownLanding {
    motion::LandingReport report;  ///< with the half that fits better
    /// The same with count 1 one bar later: the half that was not taken.
    motion::LandingReport other_half;
};

/// Landings of the shown poses. Poses keep the host time of their picture and are resampled from
/// there onto a regular grid of 60 a second. Count 1 is put on a downbeat of the generated music;
/// the dancer's phase and the tracker's bars are not used. A figure of 8 counts takes two bars, and
/// the music does not say which is the first: of the two, the one with fewer missing landings is
/// taken. Judged from 4 s after the dance began or count 1 was last set anew. Nothing when the
/// dance is shorter than 10 s or not danced beat by beat (octave).
[[nodiscard]] std::optional<ShownLanding> shown_landing(std::span<const ShownPicture> pictures,
                                                        const SoundLine& sound,
                                                        const audio::GeneratedMusic& music,
                                                        const motion::FigureModel& figure,
                                                        const motion::Skeleton& skeleton);

}  // namespace raks::engine
