#include "apps/raks/stick_beats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/clips/clip_reading.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/stick_strips.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/cells/take_grid.hpp"
#include "training/figures/training_clip.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::apps {
namespace {

// Errors: of the joints' options.
Expected<motion::ClipUnits> units_of(const StickArguments& arguments) {
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    const motion::BodyOptions body = arguments.body.options();
    motion::ClipUnits units;
    units.reading = clip_reading(arguments.fps, arguments.skeleton);
    units.up = body.up;
    units.metres_per_unit = body.metres_per_unit;
    units.height = body.height;
    units.joints = std::move(*joints);
    return units;
}

Expected<motion::TrainingClip> load_take(const Path& path, const motion::ClipUnits& units) {
    std::vector<std::string> warnings;
    auto clip = motion::load_clip(path, units, warnings);
    for (const std::string& warning : warnings) {
        say(warning);
    }
    return clip;
}

// The grids of the table whose clips were given. Errors: there is none.
Expected<std::vector<motion::TakeGrid>> grids_of_clips(const std::map<std::string, Path>& clips,
                                                       const Path& table) {
    const auto beats = motion::load_take_beats(table);
    if (!beats) {
        return fail(beats.error());
    }
    std::vector<motion::TakeGrid> grids = motion::grids_of(*beats);
    std::erase_if(grids, [&](const motion::TakeGrid& grid) { return !clips.contains(grid.take); });
    if (grids.empty()) {
        return fail(fmt::format("{}: has no beats of {}",
                                table.string(),
                                clips.size() == 1 ? clips.begin()->first : "any of the clips"));
    }
    return grids;
}

Expected<void> draw_all(const StickArguments& arguments,
                        const std::map<std::string, Path>& clips,
                        const motion::ClipUnits& units) {
    const auto grids = grids_of_clips(clips, arguments.counts);
    if (!grids) {
        return fail(grids.error());
    }
    if (auto made = make_folders(arguments.strips); !made) {
        return made;
    }
    const auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    auto studio = SheetStudio::open(*look, look->quality);
    if (!studio) {
        return fail(studio.error());
    }
    for (const motion::TakeGrid& grid : *grids) {
        const auto clip = load_take(clips.at(grid.take), units);
        if (!clip) {
            return fail(clip.error());
        }
        if (auto written = write_strips(*clip, grid, arguments.strips, *studio); !written) {
            return fail(std::move(written.error()).in(arguments.counts.string()));
        }
        if (stop_signal()) {
            break;
        }
    }
    return {};
}

}  // namespace

ExitCode stick_beats(const StickArguments& arguments) {
    if (arguments.strips.empty()) {
        complain("--counts needs --strips FOLDER, to draw them, or --edit, to set them right");
        return kExitUsage;
    }
    const auto units = units_of(arguments);
    if (!units) {
        return fail(units.error());
    }
    motion::FigureTrainingPlan files;
    files.clips = {arguments.input};
    const auto clips = motion::clips_by_take(files);
    if (!clips) {
        return fail(clips.error());
    }
    return exit_code_of(draw_all(arguments, *clips, *units));
}

}  // namespace raks::apps
