#include "apps/raks/stick_beats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "apps/clips/clip_reading.hpp"
#include "apps/grid/grid_window.hpp"
#include "apps/grid/read_take.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/stick_strips.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"

namespace raks::apps {
namespace {

// Errors: of the joints' options.
Expected<TakeReading> reading_of(const StickArguments& arguments) {
    auto joints = arguments.joints.labels();
    if (!joints) {
        return fail(std::move(joints.error()));
    }
    return TakeReading{clip_reading(arguments.fps, arguments.skeleton, arguments.body.arm_angle),
                       arguments.body.options(),
                       std::move(*joints)};
}

// Reads a clip and prints what is to be known of it.
Expected<ReadTake> read_and_say(const Path& path, const TakeReading& reading) {
    auto take = read_take(path, reading);
    if (take) {
        for (const std::string& warning : take->warnings) {
            say(warning);
        }
    }
    return take;
}

// All takes of the table whose clips were given. Errors: there is none.
Expected<void> draw_all(const StickArguments& arguments,
                        const std::map<std::string, Path>& clips,
                        const TakeReading& reading) {
    auto table = read_grid_table(arguments.counts);
    if (!table) {
        return fail(std::move(table.error()));
    }
    std::erase_if(table->grids, [&](const auto& grid) { return !clips.contains(grid.take); });
    if (table->grids.empty()) {
        return fail(fmt::format("{}: has no beats of {}",
                                arguments.counts.string(),
                                clips.size() == 1 ? clips.begin()->first : "any of the clips"));
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
    for (const auto& grid : table->grids) {
        const auto take = read_and_say(clips.at(grid.take), reading);
        if (!take) {
            return fail(take.error());
        }
        if (auto written = write_strips(*take, grid, arguments.strips, *studio); !written) {
            return fail(std::move(written.error()).in(arguments.counts.string()));
        }
        if (stop_signal()) {
            break;
        }
    }
    return {};
}

Expected<void> edit(const StickArguments& arguments,
                    const std::map<std::string, Path>& clips,
                    const TakeReading& reading) {
    if (clips.size() != 1) {
        return fail(arguments.input.string() + ": --edit is for one clip; name its file");
    }
    auto take = read_and_say(clips.begin()->second, reading);
    if (!take) {
        return fail(std::move(take.error()));
    }
    std::optional<DancedSong> song;
    if (!arguments.music.empty()) {
        auto read = read_song(arguments.music, arguments.offset, take->cues);
        if (!read) {
            return fail(std::move(read.error()));
        }
        if (!read->note.empty()) {
            say(read->note);
        }
        song = std::move(*read);
    }
    auto edited = begin_editing(std::move(*take), arguments.counts, std::move(song));
    if (!edited) {
        return fail(std::move(edited.error()));
    }
    const auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    return edit_in_window(std::move(*edited), *look, [] { return stop_signal().has_value(); });
}

}  // namespace

ExitCode stick_beats(const StickArguments& arguments) {
    if (arguments.strips.empty() && !arguments.edits) {
        complain("--counts needs --strips FOLDER, to draw them, or --edit, to set them right");
        return kExitUsage;
    }
    if (!arguments.output.empty() || !arguments.other.empty() || arguments.as_json) {
        complain("with --counts there is neither -o nor --json nor a second motion");
        return kExitUsage;
    }
    const auto reading = reading_of(arguments);
    if (!reading) {
        return fail(reading.error());
    }
    const auto clips = clips_of_takes(arguments.input);
    if (!clips) {
        return fail(clips.error());
    }
    if (!arguments.strips.empty()) {
        if (auto drawn = draw_all(arguments, *clips, *reading); !drawn) {
            return fail(std::move(drawn.error()));
        }
    }
    return arguments.edits ? exit_code_of(edit(arguments, *clips, *reading)) : ExitCode(kExitDone);
}

}  // namespace raks::apps
