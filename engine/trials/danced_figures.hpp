#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "motion/dancer.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

/// Which figure was danced when, and when its counts were heard: the dancer's own words for the
/// first, the music's exact beats for the second.
namespace raks::engine {

/// One figure from where it began, or the dance was set anew, to where that ended.
struct DancedFigure {
    const motion::FigureModel* model = nullptr;  ///< never null
    double octave = 1.0;                         ///< dance beats a beat of the music
    double from = 0.0;                           ///< seconds of the stream
    double to = 0.0;
    double dance_from = 0.0;  ///< of the dance, from standing to standing, that it is part of
    double dance_to = 0.0;
    bool is_whole = false;  ///< from count 1 to the next one
    /// Seconds at which the music sounded its counts 1..beats and the next figure's count 1. The
    /// dancer's phase says only which beat is count 1 (the nearest, by the middle over the
    /// figure): never when it is.
    std::vector<double> count_times;
    std::vector<bool> is_count_audible;  ///< count lies inside the music, in no silence; same size
};

/// `hops`: the dancer's status of every hop from the stream's start. Figures that `models` does not
/// have by name, or that no beat falls into, are left out.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<DancedFigure> danced_figures(std::span<const motion::DancerStatus> hops,
                                                       std::span<const audio::ReferenceBeat> beats,
                                                       std::span<const motion::FigureModel> models);

/// The counts to look for landings at: heard, danced to, from `blend_in` seconds after the start
/// of a dance on, in [from, to) of the stream.
struct CountWindow {
    double from = 0.0;
    double to = 1e9;
    double blend_in = 4.0;
};
[[nodiscard]] std::vector<motion::AudibleCount> audible_counts(
    std::span<const DancedFigure> figures, const CountWindow& window = {});

}  // namespace raks::engine
