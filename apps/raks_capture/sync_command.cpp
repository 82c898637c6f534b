#include "apps/raks_capture/sync_command.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/raks_capture/sync_report.hpp"
#include "apps/raks_capture/synchronise.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/play_list.hpp"
#include "motion/capture/camera/rig_file.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCameras = 100;
constexpr std::size_t kMostBytes = std::size_t{1} << 20U;  // of a file of clocks

struct SyncArguments {
    std::string folder;
    std::string music;
    std::string offsets;
    std::vector<double> loudspeaker;
    double within = std::numeric_limits<double>::infinity();
    bool as_json = false;
};

// The films in the folder: a camera each, by its name.
Expected<std::vector<CameraSound>> find_cameras(const fs::path& folder, const fs::path& music) {
    auto paths = list_folder(folder);
    if (!paths) {
        return fail(std::move(paths.error()));
    }
    std::vector<CameraSound> cameras;
    for (const fs::path& path : *paths) {
        std::error_code problem;
        const bool is_song = !music.empty() && fs::equivalent(path, music, problem);
        const bool is_hidden = path.filename().string().starts_with(".");
        if (is_song || is_hidden || !engine::looks_like_music(path) ||
            !fs::is_regular_file(path, problem)) {
            continue;
        }
        const std::string name = path.stem().string();
        const auto same = std::find_if(cameras.begin(), cameras.end(), [&](const auto& other) {
            return other.camera == name;
        });
        if (same != cameras.end()) {
            return fail(
                fmt::format("{}: {} is of the same camera; rename one of them or put it "
                            "elsewhere",
                            path.string(),
                            same->file.filename().string()));
        }
        cameras.push_back({name, path});
    }
    if (cameras.empty() || cameras.size() > kMostCameras) {
        return fail(
            fmt::format("{}: holds {} films; a capture has one for each of its cameras, "
                        "named as the camera, such as left.mp4",
                        folder.string(),
                        cameras.size()));
    }
    return cameras;
}

// How far each camera is from the loudspeaker, where the rig knows it.
Expected<void> measure_ways(const fs::path& folder,
                            const std::vector<double>& loudspeaker,
                            std::vector<CameraSound>& cameras) {
    if (loudspeaker.empty()) {
        return {};
    }
    const auto rig = capture::read_rig(folder / "rig.toml");
    if (!rig) {
        return fail(Error(rig.error()).in("--loudspeaker needs the places of the cameras"));
    }
    const glm::dvec3 place(loudspeaker[0], loudspeaker[1], loudspeaker[2]);
    for (CameraSound& camera : cameras) {
        if (const auto index = rig->rig.index_of(camera.camera)) {
            camera.metres = glm::distance(rig->rig.cameras[*index].centre(), place);
        } else {
            say(fmt::format("{}: is not in the rig; the sound's way to it is left out",
                            camera.camera));
        }
    }
    return {};
}

Expected<SyncPlan> plan_of(const SyncArguments& arguments) {
    const fs::path folder(arguments.folder);
    SyncPlan plan;
    auto cameras = find_cameras(folder, arguments.music);
    if (!cameras) {
        return fail(std::move(cameras.error()));
    }
    plan.cameras = std::move(*cameras);
    if (auto measured = measure_ways(folder, arguments.loudspeaker, plan.cameras); !measured) {
        return fail(std::move(measured.error()));
    }
    if (!arguments.music.empty()) {
        plan.music = arguments.music;
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

// The clocks of the cameras, and that of the song.
Expected<void> write_clocks(const fs::path& folder,
                            const SyncResult& result,
                            const SyncPlan& plan) {
    auto written = write_file(folder / "clocks.toml", capture::clocks_text(result.clocks()));
    if (written && result.song) {
        written = write_file(folder / "music.toml", music_text(*result.song, *plan.music));
    }
    return written;
}

ExitCode run_sync(const SyncArguments& arguments) {
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
    for (const std::string& warning : result->warnings) {
        say(warning);
    }
    if (result->clocks().empty()) {
        return fail(arguments.folder + ": no camera's clock could be told; see above");
    }
    const fs::path folder(arguments.folder);
    if (auto written = write_clocks(folder, *result, *plan); !written) {
        return fail(std::move(written.error()));
    }
    if (arguments.as_json) {
        print_json(sync_json(*result, *plan));
    } else {
        print_text(sync_table(*result, *plan));
    }
    return result->is_whole ? kExitDone : kExitPartly;
}

}  // namespace

void add_sync(CommandTable& table, CLI::App& parent) {
    auto [app, a] = table.add<SyncArguments>(
        parent, "sync", "tell the clocks of the cameras from the sound of their films", run_sync);
    app->add_option("FOLDER", a->folder, "of the capture: one film a camera, named as it")
        ->required();
    app->add_option("--music", a->music, "the song that was played: is found in the films");
    app->add_option("--offsets", a->offsets, "clocks set by hand (clocks.toml)");
    app->add_option(
           "--loudspeaker", a->loudspeaker, "X,Y,Z of it, metres, in the world of rig.toml")
        ->delimiter(',')
        ->expected(3)
        ->check(in_range(-1000.0, 1000.0));
    app->add_option("--within", a->within, "seconds within which all cameras were started")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
    app->add_flag("--json", a->as_json, "print JSON");
}

}  // namespace raks::apps
