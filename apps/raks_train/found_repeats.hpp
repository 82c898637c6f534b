#pragma once

#include "apps/raks_train/train_commands.hpp"
#include "base/expected.hpp"
#include "training/discovery/clip_discovery.hpp"

/// `raks train figure` for clips that nobody labelled.
namespace raks::apps {

/// Finds the repeats in the plan's clips, or takes each clip as one phrase (--once), and says the
/// warnings. Errors: as discover_clips.
[[nodiscard]] Expected<motion::DiscoveredClips> found_in_clips(
    const TrainFigureArguments& arguments, const motion::FigureTrainingPlan& plan);

/// The page beside the table of --propose: the same name with .html.
[[nodiscard]] Path page_beside(const Path& table);

/// Writes the repeats as labels to `--propose X.tsv` and as a page to X.html, and prints what was
/// found; with `--labels` also how it compares with these. Errors: of the files.
[[nodiscard]] Expected<void> propose(const TrainFigureArguments& arguments,
                                     const motion::FigureTrainingPlan& plan);

/// "1 of 3 repeats are alike", over all clips.
[[nodiscard]] std::string few_alike(const motion::DiscoveredClips& found);

/// What was found, a line a clip: repeats, beats, tempo, and the seconds of those that are learnt;
/// of a phrase in which ways it may be counted, and how likely each is.
[[nodiscard]] std::string found_lines(const motion::DiscoveredClips& found);

}  // namespace raks::apps
