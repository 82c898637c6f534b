#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "motion/dancer.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

/// Which figure was danced when, from the dancer's status, and when its counts sounded, from the
/// music's exact beats.
namespace raks::engine {

/// One figure from its beginning, or from where the dancer's phase was set anew, to where that
/// ended; of a dance of cells a piece of a take, whose counts are the take's beats.
struct DancedFigure {
    const motion::FigureModel* model = nullptr;  ///< never null
    double octave = 1.0;                         ///< dance beats a beat of the music
    double from = 0.0;                           ///< seconds of the stream
    double to = 0.0;                             ///< seconds of the stream; the hop after the last
    double dance_from = 0.0;   ///< of the dance, from standing to standing, that it is part of
    double dance_to = 0.0;     ///< end of that dance
    bool is_whole = false;     ///< from count 1 to the next one
    bool is_mirrored = false;  ///< left for right
    /// Seconds of the stream at which the music sounded counts 1..beats of the figure and count 1
    /// of the next. The dancer's phase only decides which beat of the music is count 1 (the
    /// nearest, by the median over the figure); the times are those of the music's beats.
    std::vector<double> count_times;
    std::vector<bool> is_count_audible;  ///< count lies inside the music, in no silence; same size
};

/// The figures of one dance. `hops`: the dancer's status at every hop from the stream's start.
/// Figures whose name `models` lacks, or into which no beat falls, are left out.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<DancedFigure> danced_figures(std::span<const motion::DancerStatus> hops,
                                                       std::span<const audio::ReferenceBeat> beats,
                                                       std::span<const motion::FigureModel> models);

/// Which counts are judged for landings: those that sound, are danced to, come at least `blend_in`
/// seconds after the start of a dance, and lie in [from, to) of the stream.
struct CountWindow {
    double from = 0.0;      ///< seconds of the stream
    double to = 1e9;        ///< seconds of the stream
    double blend_in = 4.0;  ///< seconds that a dance needs to settle
};
/// The counts of these figures that the window lets through, in order.
[[nodiscard]] std::vector<motion::AudibleCount> audible_counts(
    std::span<const DancedFigure> figures, const CountWindow& window = {});

}  // namespace raks::engine
