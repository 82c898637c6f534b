// `raks capture sync`: the clocks of the films from their sound.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/motion_clocks.hpp"
#include "apps/raks_capture/sync_report.hpp"
#include "apps/raks_capture/synchronise.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;  // of a file of clocks

// The cameras of a capture that were filmed.
std::vector<CameraSound> sounds_of(const CapturePlan& capture, bool is_of_boards) {
    std::vector<CameraSound> cameras;
    for (const PlannedCamera& camera : capture.cameras) {
        CameraSound sound{camera.name, {}, std::nullopt};
        const fs::path& film = is_of_boards ? camera.calibration : camera.film;
        if (!film.empty()) {
            sound.file = capture.file(film).lexically_normal();
        }
        if (camera.loudspeaker > 0.0) {
            sound.metres = camera.loudspeaker;
        }
        cameras.push_back(std::move(sound));
    }
    return cameras;
}

Expected<SyncPlan> plan_of(const SyncArguments& arguments) {
    const auto capture = load_capture_plan(arguments.folder);
    if (!capture) {
        return fail(capture.error());
    }
    SyncPlan plan;
    plan.cameras = sounds_of(*capture, arguments.is_of_boards);
    plan.start = capture->start;
    if (!arguments.music.empty()) {
        plan.music = arguments.music;
    } else if (!capture->music.empty() && !arguments.is_of_boards) {
        plan.music = capture->file(capture->music).lexically_normal();
    }
    if (!arguments.offsets.empty()) {
        const auto text = read_text_file(arguments.offsets, kMostBytes);
        if (!text) {
            return fail(text.error());
        }
        auto clocks = capture::read_clocks(*text, arguments.offsets);
        if (!clocks) {
            return fail(std::move(clocks.error()));
        }
        plan.by_hand = std::move(*clocks);
    }
    plan.most_offset = arguments.within;
    plan.threads = static_cast<int>(std::thread::hardware_concurrency());
    return plan;
}

// What its sound does not tell is no trouble any more, once a clock is known otherwise.
void forget_sound_of(const CameraSync& camera, const SyncPlan& plan, SyncResult& result) {
    std::vector<std::string> begins = {camera.camera + ": "};
    for (const CameraSound& sound : plan.cameras) {
        if (sound.camera == camera.camera) {
            begins.push_back(sound.file.string() + ": ");
        }
    }
    auto& warnings = result.warnings;
    warnings.erase(std::remove_if(warnings.begin(),
                                  warnings.end(),
                                  [&begins](const std::string& line) {
                                      return std::any_of(begins.begin(),
                                                         begins.end(),
                                                         [&line](const std::string& begin) {
                                                             return line.rfind(begin, 0) == 0;
                                                         });
                                  }),
                   warnings.end());
}

// Gives cameras without a clock theirs of `clocks`.
void give_clocks(const std::vector<capture::Clock>& clocks,
                 bool is_by_motion,
                 const SyncPlan& plan,
                 SyncResult& result) {
    for (CameraSync& camera : result.cameras) {
        for (const capture::Clock& clock : clocks) {
            if (!camera.clock && clock.camera == camera.camera) {
                camera.clock = clock;
                camera.is_by_motion = is_by_motion;
                camera.is_by_hand = !is_by_motion;
                forget_sound_of(camera, plan, result);
            }
        }
    }
    result.is_whole =
        result.clocks().size() == result.cameras.size() && (!plan.music || result.song.has_value());
}

// The clocks of clocks.toml where all of them are known for sure: a person set them, or a studio
// drew the films. Else, and without the file: none.
std::vector<capture::Clock> known_clocks(const CapturePlan& plan) {
    const fs::path file = plan.file("clocks.toml");
    const auto text = is_there(file) ? read_text_file(file, kMostBytes) : std::string();
    const auto clocks = text && !text->empty() ? capture::read_clocks(*text, file.string())
                                               : std::vector<capture::Clock>();
    const bool are_known =
        clocks && std::all_of(clocks->begin(), clocks->end(), [](const capture::Clock& clock) {
            return clock.confidence >= 1.0;
        });
    return are_known ? *clocks : std::vector<capture::Clock>();
}

// Clocks of cameras that heard nothing: where none did, those that are known already, else by what
// moves; those that were heard are checked by it. Without keypoints or spots nothing changes.
void tell_without_sound(const SyncArguments& arguments, const SyncPlan& plan, SyncResult& result) {
    const auto capture = load_capture_plan(arguments.folder);
    if (!capture || arguments.is_of_boards || !has_motion(*capture)) {
        return;
    }
    const bool is_heard = !result.clocks().empty();
    if (!is_heard) {
        give_clocks(known_clocks(*capture), false, plan, result);
    }
    const std::vector<capture::Clock> told = result.clocks();
    if (told.size() == result.cameras.size()) {
        for (const std::string& line :
             is_heard
                 ? check_by_motion(*capture, told)
                 : std::vector<std::string>{"no film has sound: the clocks stay as they are"}) {
            say(line);
        }
        return;
    }
    const auto clocks = clocks_by_motion(*capture, told, arguments.within);
    if (!clocks) {
        result.warnings.push_back("by what moves: " + clocks.error().message);
        return;
    }
    give_clocks(clocks->clocks, true, plan, result);
    say(
        fmt::format("no sound tells all clocks: what moves in the films told the others, within "
                    "some {:.0f} milliseconds",
                    1e3 * clocks->usual_error));
    for (const std::string& note : clocks->notes) {
        say(note);
    }
    result.is_whole = result.is_whole && clocks->doubts.empty();
    result.warnings.insert(result.warnings.end(), clocks->doubts.begin(), clocks->doubts.end());
}

// The clocks of the cameras, and that of the song.
Expected<void> write_clocks(const SyncArguments& arguments,
                            const SyncResult& result,
                            const SyncPlan& plan) {
    const fs::path folder(arguments.folder);
    if (arguments.is_of_boards) {
        return write_file(folder / "board_clocks.toml", capture::clocks_text(result.clocks()));
    }
    std::vector<NamedFile> files = {
        {folder / "clocks.toml", capture::clocks_text(result.clocks())}};
    if (result.song) {
        files.push_back({folder / "music.toml", music_text(*result.song, plan)});
    }
    return write_files(files);
}

}  // namespace

ExitCode sync_capture(const SyncArguments& arguments) {
    const auto plan = plan_of(arguments);
    if (!plan) {
        return fail(plan.error());
    }
    Expected<SyncResult> result;
    {
        ProgressLine progress("sound of the films");
        result = synchronise(*plan, [&](double share) {
            progress.show(share);
            return !stop_signal();
        });
    }
    if (!result) {
        return fail(std::move(result.error()));
    }
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    tell_without_sound(arguments, *plan, *result);
    for (const std::string& warning : result->warnings) {
        say(warning);
    }
    if (result->clocks().empty()) {
        return fail(arguments.folder +
                    ": no camera's clock could be told; see above, or set them by "
                    "hand with --offsets");
    }
    if (auto written = write_clocks(arguments, *result, *plan); !written) {
        return fail(std::move(written.error()));
    }
    if (arguments.as_json) {
        print_json(sync_json(*result, *plan));
    } else {
        print_text(sync_table(*result, *plan));
    }
    return result->is_whole ? kExitDone : kExitPartly;
}

}  // namespace raks::apps
