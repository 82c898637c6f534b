#include "apps/grid/read_take.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/cells/grid_music.hpp"
#include "training/figures/training_clip.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// The lines that a table begins with and that readers skip.
std::vector<std::string> remarks_of(const std::string& text) {
    std::vector<std::string> remarks;
    std::size_t at = 0;
    while (at < text.size() && text[at] == '#') {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line = text.substr(at + 1, end - at - 1);
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        remarks.push_back(line.empty() || line.front() != ' ' ? line : line.substr(1));
        at = end + 1;
    }
    return remarks;
}

motion::TakeGrid proposed_grid(const EditedTake& edited, motion::GridProposal proposal) {
    if (!edited.song) {
        return std::move(proposal.grid);
    }
    motion::DancedMusic music = edited.song->music.music;
    music.offset = edited.song->offset;
    return motion::grid_of_music(edited.take.clip.name, edited.take.cues, music);
}

}  // namespace

Expected<std::map<std::string, fs::path>> clips_of_takes(const fs::path& path) {
    motion::FigureTrainingPlan files;
    files.clips = {path};
    return motion::clips_by_take(files);
}

Expected<ReadTake> read_take(const fs::path& path, const TakeReading& reading) {
    motion::ClipUnits units;
    units.reading = reading.reading;
    units.up = reading.body.up;
    units.metres_per_unit = reading.body.metres_per_unit;
    units.height = reading.body.height;
    units.joints = reading.joints;
    ReadTake take;
    auto clip = motion::load_clip(path, units, take.warnings);
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    take.clip = std::move(*clip);
    take.cues = motion::grid_cues(take.clip);
    return take;
}

Expected<GridTable> read_grid_table(const fs::path& path) {
    constexpr std::size_t kMostBytes = std::size_t{64} << 20U;  // 64 MiB
    const auto text = read_text_file(path, kMostBytes);
    if (!text) {
        return fail(text.error());
    }
    const auto beats = motion::parse_take_beats(*text, path.filename().string());
    if (!beats) {
        return fail(beats.error());
    }
    return GridTable{motion::grids_of(*beats), remarks_of(*text)};
}

Expected<DancedSong> read_song(const fs::path& file,
                               std::optional<double> offset,
                               const motion::GridCues& cues) {
    auto music = read_take_music(file);
    if (!music) {
        return fail(std::move(music.error()));
    }
    DancedSong song{file, std::move(*music), offset.value_or(0.0), {}};
    if (!offset) {
        const motion::MusicOffset found = motion::find_offset(cues, song.music.music);
        song.offset = found.seconds;
        song.note = offset_line(song.music.music.name, found);
    }
    return song;
}

Expected<EditedTake> begin_editing(ReadTake take,
                                   const fs::path& table,
                                   std::optional<DancedSong> song) {
    EditedTake edited;
    edited.take = std::move(take);
    edited.file = table;
    edited.song = std::move(song);
    std::error_code ignored;
    if (fs::exists(table, ignored)) {
        auto read = read_grid_table(table);
        if (!read) {
            return fail(std::move(read.error()));
        }
        edited.table = std::move(*read);
    }
    const auto own = std::find_if(
        edited.table.grids.begin(), edited.table.grids.end(), [&](const motion::TakeGrid& grid) {
            return grid.take == edited.take.clip.name;
        });
    motion::GridProposal proposal = motion::propose_grid(edited.take.clip.name, edited.take.cues);
    edited.repeats = proposal.lags;
    edited.is_new = own == edited.table.grids.end();
    edited.grid = edited.is_new ? proposed_grid(edited, std::move(proposal)) : *own;
    if (auto checked = motion::check_grid(edited.grid, edited.take.cues.seconds()); !checked) {
        return fail(std::move(checked.error()).in(table.string()));
    }
    return edited;
}

}  // namespace raks::apps
