#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "training/discovery/repeat_discovery.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::motion {

/// A clip and the repeats found in it.
struct DiscoveredClip {
    std::string take;            ///< as take_name() has it
    std::filesystem::path file;  ///< as it was given
    TrainingClip clip;           ///< its motion
    FoundRepeats found;          ///< its repeats; none where none_because says why
};

/// Alike repeats that a figure is learnt from at least: fewer hardly tell what varies.
inline constexpr std::size_t kFewestRepeats = 3;

/// What is looked for in clips without labels.
enum class Discovery { repeats, whole_phrase };

/// The clips of a plan without labels, by name.
struct DiscoveredClips {
    std::vector<DiscoveredClip> clips;
    std::vector<std::string> warnings;  ///< of readers and of the search, one line each
    std::vector<std::string> skipped;   ///< why a phrase beside others cannot be taken, likewise

    /// Repeats that are worth learning from.
    [[nodiscard]] std::size_t good() const noexcept;
    /// Labels of all clips, as the plan's training takes them.
    [[nodiscard]] std::vector<FigureLabel> labels(const FigureTrainingPlan& plan) const;
};

/// Reads the clips of the plan and finds the repeats of each, or takes each as one phrase. Of the
/// plan: clips, role, music, rate and unit. Errors: of the readers; of find_repeats and
/// whole_phrase, with the clip's name; where no clip has repeats, the reason of the first.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<DiscoveredClips> discover_clips(const FigureTrainingPlan& plan,
                                                       Discovery what,
                                                       DiscoveryOptions options);

}  // namespace raks::motion
