// Read take: a take, its table and its song, from their files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/grid/take_music.hpp"
#include "base/expected.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/joint_labels.hpp"
#include "training/cells/grid_cues.hpp"
#include "training/cells/grid_proposal.hpp"
#include "training/cells/take_grid.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::apps {

/// What is known of the files of clips.
struct TakeReading {
    motion::MotionReadOptions reading;
    motion::BodyOptions body;    ///< how bodies lie in them
    motion::JointLabels joints;  ///< which joint is which bone
};

/// A take that was read.
struct ReadTake {
    motion::TrainingClip clip;  ///< its name is the take's
    motion::GridCues cues;
    std::vector<std::string> warnings;  ///< for people, one line each
};

/// The clips at a path, a file or a folder, by take. Errors: a folder without clips.
[[nodiscard]] Expected<std::map<std::string, std::filesystem::path>> clips_of_takes(
    const std::filesystem::path& path);

/// Reads a clip. Errors: of the reader; no body in it. Threads: workers.
[[nodiscard]] Expected<ReadTake> read_take(const std::filesystem::path& path,
                                           const TakeReading& reading);

/// A table of beats as it is.
struct GridTable {
    std::vector<motion::TakeGrid> grids;
    std::vector<std::string> remarks;  ///< the lines that it begins with, without "# "
};
/// Reads one. Errors: as load_take_beats.
[[nodiscard]] Expected<GridTable> read_grid_table(const std::filesystem::path& path);

/// A song that a take was danced to.
struct DancedSong {
    std::filesystem::path file;
    TakeMusic music;
    double offset = 0.0;  ///< seconds of it at the clip's first frame
    std::string note;     ///< how the offset was found; empty: it was given
};
/// Reads one, and finds where its beats meet the motion unless `offset` says it. Errors: as
/// read_take_music.
[[nodiscard]] Expected<DancedSong> read_song(const std::filesystem::path& file,
                                             std::optional<double> offset,
                                             const motion::GridCues& cues);

/// What is set right in a window.
struct EditedTake {
    ReadTake take;
    std::filesystem::path file;  ///< the table that beats are saved to
    GridTable table;             ///< all that is in it; the take may be missing
    motion::TakeGrid grid;       ///< to begin with
    bool is_new = false;         ///< the grid is proposed
    std::vector<motion::FoundLag> repeats;
    std::optional<DancedSong> song;
};
/// Begins with what the table has of the take; where it has nothing, or is not there, with a
/// proposal: the song's beats, or what motion alone says. Errors: of the table; beats behind the
/// clip's end.
[[nodiscard]] Expected<EditedTake> begin_editing(ReadTake take,
                                                 const std::filesystem::path& table,
                                                 std::optional<DancedSong> song);

}  // namespace raks::apps
