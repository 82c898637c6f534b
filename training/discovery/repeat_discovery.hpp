#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/label_tables.hpp"
#include "motion/figures/phrase_tempo.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/label_counts.hpp"

/// Repeat discovery: the repeats of a figure in a clip that nobody labelled. Period by epoch
/// folding (repeat_period.hpp), borders by a pointer over the phase (repeat_segmentation.hpp),
/// count 1 from the feet (first_count.hpp) or the music, likeness by posture (repeat_likeness.hpp).
namespace raks::motion {

/// What a person may know of the motion.
struct DiscoveryOptions {
    DanceRole role =
        DanceRole::lead;        ///< the lead begins with the left foot, the follow with the right
    std::optional<int> beats;   ///< of one repeat, 1 to 64, or of a phrase; none: found
    std::optional<double> bpm;  ///< of a phrase; none: found
    int beats_per_bar = 4;      ///< of the music
    std::optional<DancedMusic> music;  ///< its beats are the counts; none: counts from the feet
};

/// One repeat that was found.
struct FoundRepeat {
    double start = 0.0;     ///< frame of count 1, fractional
    double end = 0.0;       ///< frame of the next count 1
    double distance = 0.0;  ///< to the commonest repeat, as in RepeatLikeness
    bool is_good = false;   ///< alike the commonest one: worth learning from
};

/// The repeats of one clip.
struct FoundRepeats {
    std::vector<FoundRepeat> repeats;  ///< rising; empty: none were found
    int beats = 0;                     ///< of each
    double seconds = 0.0;              ///< of each, the median
    double explained = 0.0;            ///< as in RepeatPeriod
    /// Of a whole phrase whose beats the motion told: the ways to count it, the one that is taken
    /// first. Else empty.
    std::vector<PhraseCount> counts;
    /// Of a whole phrase that was counted by music: the frames of its beats. Else empty.
    std::vector<double> beat_frames;
    std::string none_because;           ///< one line where there are none; empty otherwise
    std::vector<std::string> warnings;  ///< one line each, without the clip's name

    [[nodiscard]] std::size_t good() const noexcept;
    [[nodiscard]] double tempo() const noexcept { return 60.0 * beats / seconds; }  ///< BPM
};

/// Finds the repeats of one clip; none is judged yet (distance 0, not good). Errors (one line):
/// motion that is not finite, shorter than two beats, or without movement; music whose beats the
/// motion does not keep to. Deterministic. Threads: workers. Real-time: no (a second or two for a
/// minute of motion).
[[nodiscard]] Expected<FoundRepeats> find_repeats(const TrainingClip& clip,
                                                  const DiscoveryOptions& options = {});

/// A clip and what was found in it.
struct FoundIn {
    const TrainingClip* clip = nullptr;
    FoundRepeats* found = nullptr;
};

/// Sets distance and is_good of all repeats, compared over all clips: the commonest figure of a
/// person who dances several is the same one in each clip. Threads: workers. Real-time: no.
void judge_repeats(std::span<const FoundIn> clips);

/// What was found as labels of `figure`: those of good repeats have a confidence of 0.9 or more,
/// which is what training asks for, the others less.
[[nodiscard]] std::vector<FigureLabel> labels_of(const FoundRepeats& found,
                                                 const std::string& take,
                                                 const std::string& figure,
                                                 DanceRole role);

}  // namespace raks::motion
