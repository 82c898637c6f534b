#pragma once

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
    HostTime at{};            ///< CLOCK_MONOTONIC when it was drawn: late wake-ups stay late
    StreamTime moment{};      ///< of the music, as the graph chose it
    engine::ClockLine clock;  ///< of the graph, then
    bool is_dancing = false;
    double octave = 1.0;  ///< dance beats per beat of the music
    motion::Pose pose;
};

/// What was out at which host time: straight lines between the beats that came back.
class SoundLine {
 public:
    /// `heard`: two or more, ascending.
    SoundLine(std::span<const AudibleBeat> heard, const audio::GeneratedMusic& music);

    /// Place in the music (seconds of the stream) of what was out at `host`; beyond the ends the
    /// nearest line goes on.
    [[nodiscard]] double stream_seconds_at(HostTime host) const;
    [[nodiscard]] HostTime host_at(double stream_seconds) const;
    [[nodiscard]] bool covers(HostTime host) const;

 private:
    HostTime origin_;
    std::vector<double> host_;    // seconds since origin_
    std::vector<double> stream_;  // seconds
};

/// How long after its hand-over (by the graph's clock) each heard beat was out; ms.
[[nodiscard]] std::vector<double> loop_latencies_ms(std::span<const AudibleBeat> heard,
                                                    const audio::GeneratedMusic& music,
                                                    std::span<const ShownPicture> pictures);

/// How far the pictures' moments lie ahead of what was out when they were drawn; ms.
[[nodiscard]] std::vector<double> picture_leads_ms(std::span<const ShownPicture> pictures,
                                                   const SoundLine& sound);

/// Landings of the shown poses against the beats that were out (DESIGN 5).
struct ShownLanding {
    motion::LandingReport report;
    /// The same with the figure's count 1 a bar later: the half that was not taken.
    motion::LandingReport other_half;
};

/// Poses keep the host time of their picture and are resampled onto a regular grid of 60 a second
/// from there. Count 1 is put on a downbeat of the generated music; the dancer's phase and the
/// tracker's bars are not asked. A figure of 8 counts takes two bars and music does not say which
/// is the first: of the two, the one at which more of the expected steps come down. From 4 s after
/// the dance began. Nothing when there is too little to see, or the figure is not danced beat by
/// beat (octave).
[[nodiscard]] std::optional<ShownLanding> shown_landing(std::span<const ShownPicture> pictures,
                                                        const SoundLine& sound,
                                                        const audio::GeneratedMusic& music,
                                                        const motion::FigureModel& figure,
                                                        const motion::Skeleton& skeleton);

}  // namespace raks::engine
