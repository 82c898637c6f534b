#include "apps/raks/commands.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <system_error>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/say.hpp"
#include "apps/terminal/signals.hpp"
#include "audio/io/devices.hpp"
#include "base/file.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/dance_files.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

/// What is taken from a folder; a file that is named is tried whatever its name.
bool looks_like_music(const Path& path) {
    constexpr std::array<std::string_view, 17> kExtensions = {".wav",
                                                              ".flac",
                                                              ".ogg",
                                                              ".oga",
                                                              ".opus",
                                                              ".mp3",
                                                              ".m4a",
                                                              ".aac",
                                                              ".aif",
                                                              ".aiff",
                                                              ".wma",
                                                              ".webm",
                                                              ".mp4",
                                                              ".mkv",
                                                              ".mov",
                                                              ".avi",
                                                              ".caf"};
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

/// Folders become the music in them, sorted; nothing at all becomes the demo.
Expected<std::vector<Path>> files_to_play(const std::vector<Path>& given) {
    std::vector<Path> files;
    for (const Path& path : given) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        std::vector<Path> inside;
        const auto listed = list_folder(path);
        if (!listed) {
            return fail(listed.error());
        }
        std::copy_if(
            listed->begin(), listed->end(), std::back_inserter(inside), [&](const Path& file) {
                return fs::is_regular_file(file, error) && looks_like_music(file);
            });
        if (inside.empty()) {
            return fail(path.string() + ": no music in this folder");
        }
        files.insert(files.end(), inside.begin(), inside.end());
    }
    if (files.empty()) {
        const auto demo = engine::demo_music();
        if (!demo) {
            return fail(demo.error());
        }
        files.push_back(*demo);
    }
    return files;
}

Expected<std::optional<audio::AudioDevice>> choose_output(const PlayArguments& arguments,
                                                          const audio::AudioSystem* system) {
    if (system == nullptr) {
        return std::nullopt;
    }
    auto choice = audio::choose_output(system->devices(), arguments.settings.output);
    if (!choice) {
        return fail(std::move(choice.error()));
    }
    say("sound goes to " + choice->reason);
    return choice->device;
}

/// Plays one file; what its end asks for.
Expected<StageEnd> play_file(const Path& file,
                             const PlayArguments& arguments,
                             const std::optional<audio::AudioDevice>& output,
                             const engine::LiveGraphConfig& config,
                             StageLoop& loop,
                             bool& has_lost_device) {
    auto player = audio::FilePlayer::start({file}, {.start_seconds = arguments.section.start});
    if (!player) {
        return fail(player.error());
    }
    const std::optional<double> duration = (*player)->first_info().claimed_seconds;
    (*player)->wait_until_ready(4096);
    auto graph = engine::LiveGraph::play(std::move(*player), output, config);
    if (!graph) {
        return fail(graph.error());
    }
    if (arguments.section.duration) {
        (*graph)->playback()->set_end(arguments.section.start + *arguments.section.duration);
    }
    say("playing " + file.string());
    const StageEnd end = loop.run(**graph, file.filename().string(), duration);
    for (const std::string& message : (*graph)->playback()->player().take_messages()) {
        loop.say(message);
    }
    has_lost_device = has_lost_device || (*graph)->has_lost_device();
    return end;
}

}  // namespace

ExitCode play(const PlayArguments& given) {
    PlayArguments arguments = given;
    const auto files = files_to_play(arguments.files);
    if (!files) {
        return fail(files.error());
    }
    // A missing file is said before a window opens.
    if (const auto first = audio::open_audio_file(files->front()); !first) {
        return fail(first.error());
    }
    std::optional<audio::AudioSystem> system;
    if (!arguments.is_soundless) {
        auto opened = audio::AudioSystem::open();
        if (!opened) {
            return fail(opened.error());
        }
        system.emplace(std::move(*opened));
    }
    const auto output = choose_output(arguments, system ? &*system : nullptr);
    if (!output) {
        return fail(output.error().message + " (--no-sound dances without a loudspeaker)");
    }
    const auto setup = open_dances(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    auto dancers = engine::Dancers::load(arguments.settings, setup->catalogue, setup->skeleton);
    if (!dancers) {
        return fail(dancers.error());
    }
    auto loop = StageLoop::create(arguments.settings,
                                  setup->catalogue.list(),
                                  {arguments.is_headless, arguments.is_fullscreen, std::nullopt});
    if (!loop) {
        return fail(loop.error());
    }
    engine::LiveGraphConfig config;
    config.models = setup->models;
    config.cast = dancers->cast();
    config.latency_offset = nanos_from_seconds(arguments.settings.latency_offset_ms * 1e-3);
    config.pose_lead = nanos_from_seconds(arguments.settings.pose_lead_ms * 1e-3);
    bool has_lost_device = false;
    bool has_failed = false;
    for (const Path& file : *files) {
        const auto end = play_file(file, arguments, *output, config, *loop, has_lost_device);
        if (!end) {
            if (files->size() == 1) {
                return fail(end.error());
            }
            loop->say(end.error().message);
            has_failed = true;
            continue;
        }
        if (*end == StageEnd::quit) {
            break;
        }
    }
    for (const std::string& line : dancers->wait()) {
        loop->say(line);
    }
    return has_lost_device || has_failed ? kExitFailed : kExitDone;
}

}  // namespace raks::apps
