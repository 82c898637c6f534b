#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/setup/dance_folder.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "training/figures/authored_training.hpp"

namespace raks::apps {

/// The entry of a dances.toml for a written dance: name, metre and tempi.
[[nodiscard]] DanceInfo info_of(const motion::AuthoredDance& dance);
/// What a new grammar of it says: of a couple its form, and that its figures have stances of their
/// own.
[[nodiscard]] engine::NewGrammar grammar_of(const motion::AuthoredDance& dance);

/// Learns the figures of a written dance, in the file's order; of a dance for couples each for the
/// lead and then for the follow. `figure`: the only one to learn; empty: all. `on_learnt` is called
/// after each. Errors: no such figure (the nearest is named), a figure that cannot be learnt.
/// Threads: workers. Real-time: no (a third of a second a figure).
[[nodiscard]] Expected<std::vector<motion::AuthoredTrainingResult>> learn_figures(
    const motion::AuthoredDance& dance,
    std::string_view figure,
    const motion::Skeleton& skeleton,
    const motion::AuthoredTrainingOptions& options,
    const std::function<void(const motion::AuthoredFigure&, const motion::AuthoredTrainingResult&)>&
        on_learnt = {});

/// Learns all figures of a written dance (.toml) into a folder of dances below the user's cache
/// ($XDG_CACHE_HOME/raks/written), where the same text is found the next time; into a temporary
/// folder where the cache cannot be written. Returns the folder. Errors: those of the file and of
/// its figures.
[[nodiscard]] Expected<std::filesystem::path> learn_written_dance(const std::filesystem::path& file,
                                                                  const motion::Skeleton& skeleton);

}  // namespace raks::apps
