#include "apps/raks_train/take_proposal.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/grid/take_music.hpp"
#include "apps/raks_train/found_repeats.hpp"
#include "apps/reports/grid_page.hpp"
#include "apps/terminal/say.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "training/cells/grid_cues.hpp"
#include "training/cells/grid_music.hpp"
#include "training/cells/grid_proposal.hpp"
#include "training/cells/take_grid.hpp"
#include "training/figures/training_clip.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::apps {
namespace {

// The song's beats in place of those that motion proposes.
void lay_song_over(const TakeMusic& song, const std::optional<double>& offset, ProposedTake& take) {
    motion::DancedMusic music = song.music;
    music.offset = offset.value_or(0.0);
    if (!offset) {
        const motion::MusicOffset found = motion::find_offset(take.cues, song.music);
        music.offset = found.seconds;
        say(take.clip.name + ": " + offset_line(song.music.name, found));
    }
    take.proposal.grid = motion::grid_of_music(take.clip.name, take.cues, music);
    take.song = fmt::format(
        "Beats of {}, in which the clip begins at {:.2f} s.", song.music.name, music.offset);
}

Expected<ProposedTake> proposed(const Path& path,
                                const motion::ClipUnits& units,
                                const std::optional<TakeMusic>& song,
                                const std::optional<double>& offset) {
    std::vector<std::string> warnings;
    auto clip = motion::load_clip(path, units, warnings);
    for (const std::string& warning : warnings) {
        say(warning);
    }
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    ProposedTake take;
    take.clip = std::move(*clip);
    take.cues = motion::grid_cues(take.clip);
    take.proposal = motion::propose_grid(take.clip.name, take.cues);
    if (song) {
        lay_song_over(*song, offset, take);
    }
    const auto& beats = take.proposal.grid.beats;
    if (beats.empty()) {
        say(take.clip.name + ": hardly anything moves, or it is too short: it gets no beats");
    }
    print_text(fmt::format("{}: {} beats, {:.0f} BPM, {:.1f} of {:.1f} s idle\n",
                           printable(take.clip.name),
                           beats.size(),
                           take.proposal.tempo(),
                           take.proposal.idle_seconds,
                           take.cues.seconds()));
    return take;
}

// What stays of all takes: their motion is not kept, as there may be hours of it.
struct Proposed {
    std::vector<motion::TakeGrid> grids;
    std::string page;  // its parts
};

Expected<void> write_proposal(const TrainTakeArguments& arguments, const Proposed& all) {
    if (all.grids.empty()) {
        return fail("none of the clips has beats that could be proposed");
    }
    const std::vector<std::string> remarks = {
        "Beats that raks proposes, to be set right: raks stick CLIP --counts " +
        arguments.propose.filename().string() + " --edit"};
    const Path page = page_beside(arguments.propose);
    if (auto written = write_files({{page, grid_page(all.page)},
                                    {arguments.propose, motion::grids_text(all.grids, remarks)}});
        !written) {
        return written;
    }
    say(
        fmt::format("{} holds the beats, {} shows them; {}: set them right with raks stick CLIP "
                    "--counts {} --edit",
                    arguments.propose.string(),
                    page.string(),
                    arguments.music.empty() ? "motion alone is right in about half of the cases"
                                            : "where the song lies and its 1 may be wrong",
                    arguments.propose.string()));
    return {};
}

Expected<Proposed> propose_all(const TrainTakeArguments& arguments) {
    motion::FigureTrainingPlan files;
    files.clips = arguments.clips;
    const auto paths = motion::clips_by_take(files);
    if (!paths) {
        return fail(paths.error());
    }
    std::optional<TakeMusic> song;
    if (!arguments.music.empty()) {
        auto read = read_take_music(arguments.music);
        if (!read) {
            return fail(std::move(read.error()));
        }
        song = std::move(*read);
    }
    const motion::BodyOptions body = arguments.body.options();
    motion::ClipUnits units;
    units.up = body.up;
    units.metres_per_unit = body.metres_per_unit;
    units.height = body.height;
    units.reading.arm_angle = arguments.body.arm_angle;
    Proposed all;
    for (const auto& [name, path] : *paths) {
        const auto take = proposed(path, units, song, arguments.offset);
        if (!take) {
            return fail(take.error());
        }
        all.page += draw_grid(*take);
        if (!take->proposal.grid.beats.empty()) {
            all.grids.push_back(take->proposal.grid);
        }
    }
    return all;
}

}  // namespace

Expected<std::string> beats_by_song(const TrainTakeArguments& arguments) {
    const auto all = propose_all(arguments);
    if (!all) {
        return fail(all.error());
    }
    if (all->grids.empty()) {
        return fail("none of the clips has beats of the song");
    }
    return motion::grids_text(all->grids);
}

ExitCode propose_take(const TrainTakeArguments& arguments) {
    const Path page = page_beside(arguments.propose);
    if (page == arguments.propose) {
        complain("--propose writes a table, and a page beside it: call it X.tsv");
        return kExitUsage;
    }
    std::vector<Path> inputs = arguments.clips;
    inputs.push_back(arguments.music);
    for (const Path& output : {arguments.propose, page}) {
        if (auto checked = check_output(output, inputs); !checked) {
            return fail(std::move(checked.error()));
        }
    }
    const auto all = propose_all(arguments);
    return all ? exit_code_of(write_proposal(arguments, *all)) : fail(all.error());
}

}  // namespace raks::apps
