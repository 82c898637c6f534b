#include "apps/raks/commands.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <system_error>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/devices.hpp"
#include "base/file.hpp"
#include "engine/offline/music_source.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

// Extensions that are taken from a folder; a file that is named is tried whatever its extension.
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
    // Compared in lower case: "SONG.MP3" is music, too.
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// The files to play: a folder stands for the music in it, sorted; nothing stands for the demo.
// Errors: a folder that cannot be read or has no music.
Expected<std::vector<Path>> files_to_play(const std::vector<Path>& given) {
    std::vector<Path> files;
    for (const Path& path : given) {
        std::error_code error;
        // Not checked further: opening it will tell.
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
        // A folder without music is rather a mistake than nothing to play.
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

// The device for the sound; none with --no-sound. Errors: no device, or none of that name.
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

// Plays several files, one after the other, in one window.
class Player {
 public:
    Player(const PlayArguments& arguments,
           const std::optional<audio::AudioDevice>& output,
           const engine::AnalyzerModels& models,
           const engine::Formations& formations,
           StageLoop& loop)
        : arguments_(arguments),
          output_(output),
          models_(models),
          formations_(formations),
          loop_(loop) {}

    // Errors: the only file cannot be played. With several files a line is printed, and the next
    // one plays.
    [[nodiscard]] Expected<void> play(const std::vector<Path>& files);
    // True when a file could not be played, or the device died.
    [[nodiscard]] bool has_failed() const noexcept { return has_failed_; }

 private:
    [[nodiscard]] Expected<StageEnd> play(const Path& file);
    [[nodiscard]] engine::LiveGraphConfig graph_config() const;

    const PlayArguments& arguments_;
    const std::optional<audio::AudioDevice>& output_;
    const engine::AnalyzerModels& models_;
    const engine::Formations& formations_;
    StageLoop& loop_;
    bool has_failed_ = false;
};

// A file that ends, or that cannot be played, is followed by the next one.
Expected<void> Player::play(const std::vector<Path>& files) {
    for (std::size_t i = 0; i < files.size();) {
        const auto end = play(files[i]);
        if (!end && files.size() == 1) {
            return fail(end.error());
        }
        if (!end) {
            loop_.say(end.error().message);
            has_failed_ = true;
        } else if (*end == StageEnd::quit) {
            break;
        }
        // From the first file "back" stays at the first.
        const bool is_back = end && *end == StageEnd::previous_file;
        i = is_back ? i - std::min<std::size_t>(i, 1) : i + 1;
    }
    return {};
}

// Plays one file; returns why it ended.
Expected<StageEnd> Player::play(const Path& file) {
    const Section& section = arguments_.section;
    // The file is decoded from the section's start on.
    auto player = audio::FilePlayer::start({file}, {.start_seconds = section.start});
    if (!player) {
        return fail(player.error());
    }
    // Asked before the player is handed over.
    const std::optional<double> duration = (*player)->first_info().claimed_seconds;
    // The first callback must not find an empty ring.
    (*player)->wait_until_ready(4096);
    auto graph = engine::LiveGraph::play(std::move(*player), output_, graph_config());
    if (!graph) {
        return fail(graph.error());
    }
    // The end is counted in seconds of the file.
    if (section.duration) {
        (*graph)->playback()->set_end(section.start + *section.duration);
    }
    say("playing " + file.string());
    const StageEnd end = loop_.run(**graph, {file.filename().string(), duration, section.start});
    // Messages of the decoder, such as a damaged file.
    for (const std::string& message : (*graph)->playback()->player().take_messages()) {
        loop_.say(message);
    }
    has_failed_ = has_failed_ || (*graph)->has_lost_device();
    return end;
}

// The formation may have changed since the last file: its present cast dances on.
engine::LiveGraphConfig Player::graph_config() const {
    engine::LiveGraphConfig config;
    config.models = models_;
    config.cast = formations_.cast();
    config.is_device_named = !arguments_.settings.output.empty();
    config.buffer_seconds = arguments_.settings.buffer_ms * 1e-3;
    config.latency_offset = nanos_from_seconds(arguments_.settings.latency_offset_ms * 1e-3);
    config.pose_lead = nanos_from_seconds(arguments_.settings.pose_lead_ms * 1e-3);
    return config;
}

}  // namespace

ExitCode play(const PlayArguments& given) {
    PlayArguments arguments = given;
    const auto files = files_to_play(arguments.files);
    if (!files) {
        return fail(files.error());
    }
    // A missing file is reported before a window opens.
    if (const auto first = audio::open_audio_file(files->front()); !first) {
        return fail(first.error());
    }
    // Without sound no audio system is opened, so that none is needed.
    std::optional<audio::AudioSystem> system;
    if (!arguments.is_soundless) {
        auto opened =
            audio::AudioSystem::open(audio::audio_system_of(arguments.settings.audio_system));
        if (!opened) {
            return fail(opened.error());
        }
        system.emplace(std::move(*opened));
    }
    const auto output = choose_output(arguments, system ? &*system : nullptr);
    if (!output) {
        return fail(output.error().message + " (--no-sound dances without a loudspeaker)");
    }
    auto setup = open_formations(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    engine::Formations& formations = setup->formations;
    auto loop = StageLoop::create(arguments.settings,
                                  {arguments.is_headless, arguments.is_fullscreen, std::nullopt},
                                  setup->catalogue.list(),
                                  formations);
    if (!loop) {
        return fail(loop.error());
    }
    Player player(arguments, *output, setup->models, formations, **loop);
    if (const auto played = player.play(*files); !played) {
        return fail(played.error());
    }
    // Dances that were left out meanwhile.
    for (const std::string& line : formations.wait()) {
        (*loop)->say(line);
    }
    return player.has_failed() ? kExitFailed : kExitDone;
}

}  // namespace raks::apps
