#include "apps/raks/commands.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/kept_window.hpp"
#include "apps/raks/song_start.hpp"
#include "apps/raks/sound_pipe.hpp"
#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_file.hpp"
#include "audio/io/audio_tags.hpp"
#include "audio/io/devices.hpp"
#include "audio/io/pipe_reader.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/song_planner.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "engine/setup/play_list.hpp"
#include "engine/setup/play_order.hpp"
#include "engine/setup/told_genre.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// How long the first song, and the others, may be analyzed before they begin to sound.
constexpr Nanos kFirstPatience = std::chrono::milliseconds(1500);
constexpr Nanos kPatience = std::chrono::seconds(5);

// The files to play; when none are given, an empty list: then Raks plays music of its own. Errors:
// none of those that are given can be played.
Expected<engine::PlayList> files_to_play(const std::vector<Path>& given) {
    if (!given.empty()) {
        return engine::read_play_list(given);
    }
    const EndAtOnceOnSignals at_once;
    const auto demo = engine::demo_music();
    if (!demo) {
        return fail(demo.error());
    }
    return engine::PlayList{{*demo}, {}};
}

// Opens what comes through a pipe.
Expected<std::unique_ptr<audio::PipeReader>> open_pipe(const Path& path, const Section& section) {
    if (section.start > 0.0) {
        return fail(path.string() +
                    ": comes through a pipe, which plays from its beginning; "
                    "leave --start out");
    }
    return open_sound_pipe(path);
}

// Whether what waits for a file is to stop.
using IsStopped = std::function<bool()>;

// Whether a file can be played from the section's start on. Errors: why not.
Expected<void> check_file(const Path& path, const Section& section, const IsStopped& is_stopped) {
    const auto file = audio::open_audio_file(path, is_stopped);
    if (!file) {
        return fail(file.error());
    }
    const auto length = (*file)->info().claimed_seconds;
    return length && section.start >= *length && section.start > 0.0
               ? fail(engine::starts_behind_end(path, *length, section.start))
               : Expected<void>();
}

// The device for the sound; none with --no-sound. Errors: no device, or none of that name.
Expected<std::optional<audio::AudioDevice>> choose_output(PlayArguments& arguments,
                                                          const audio::AudioSystem* system) {
    if (system == nullptr) {
        return std::nullopt;
    }
    auto choice = output_of(*system, arguments.settings);
    if (!choice) {
        return fail(std::move(choice.error()));
    }
    say("sound goes to " + choice->reason);
    return choice->device;
}

// The part of the arguments that says in which order files are played.
engine::PlayOrderOptions order_of(const PlayArguments& arguments) {
    engine::PlayOrderOptions options;
    if (arguments.is_shuffled) {
        options.shuffle_seed = static_cast<std::uint64_t>(arguments.settings.seed);
    }
    options.repeats = arguments.repeats;
    return options;
}

// Of files none of which could be played, why.
std::string nothing_played(const engine::SkippedFiles& skipped) {
    const std::string& first = skipped.lines().front();
    return skipped.count() == 1 ? first
                                : fmt::format("{} (and {} more; none of the files can be played)",
                                              first,
                                              skipped.count() - 1);
}

// The files in their order, and what of them turned out not to be playable.
class PlaySet {
 public:
    PlaySet(engine::PlayList list, const PlayArguments& arguments)
        : list_(std::move(list)),
          section_(arguments.section),
          order_(list_.files.size(), order_of(arguments)) {}

    // Goes to the first file that can be played; a pipe is opened. Errors: there is none; the line
    // says why.
    [[nodiscard]] Expected<void> begin();
    // The pipe that begin() opened, once; else null.
    [[nodiscard]] std::unique_ptr<audio::PipeReader> take_pipe() { return std::move(pipe_); }
    // The file that plays; null: the end.
    [[nodiscard]] const Path* current() const;
    // Whether a file follows that can be played, as far as that can be told without playing it.
    [[nodiscard]] bool has_next();
    // That file, once has_next() has looked; empty: none, or one that comes through a pipe.
    [[nodiscard]] Path next() const;
    void go_on() { order_.go_on(); }
    void go_back() { order_.go_back(); }
    // The current file turned out not to be playable: it is left out, the next one follows.
    void skip_current(const std::string& why) {
        list_.skipped.add(why);
        order_.drop_current();
    }
    [[nodiscard]] const engine::SkippedFiles& skipped() const noexcept { return list_.skipped; }
    // Asked while a file's decoder keeps one waiting; until this is called, signals end that.
    void stop_when(IsStopped is_stopped) { is_stopped_ = std::move(is_stopped); }

 private:
    // Pipes are opened once, when they are played.
    [[nodiscard]] Expected<void> check(const Path& path) const {
        return engine::is_pipe(path) ? Expected<void>() : check_file(path, section_, is_stopped_);
    }
    [[nodiscard]] Expected<void> open_first();

    engine::PlayList list_;
    const Section& section_;
    engine::PlayOrder order_;
    std::unique_ptr<audio::PipeReader> pipe_;
    IsStopped is_stopped_ = [] { return stop_signal().has_value(); };
};

Expected<void> PlaySet::open_first() {
    const Path& path = *current();
    if (!engine::is_pipe(path)) {
        return check(path);
    }
    auto pipe = open_pipe(path, section_);
    if (!pipe) {
        return fail(pipe.error());
    }
    pipe_ = std::move(*pipe);
    return {};
}

Expected<void> PlaySet::begin() {
    while (current() != nullptr) {
        const auto opened = open_first();
        if (opened) {
            return {};
        }
        if (stop_signal()) {
            return fail("stopped before anything was played");
        }
        skip_current(opened.error().message);
    }
    return fail(nothing_played(skipped()));
}

const Path* PlaySet::current() const {
    const auto file = order_.current();
    return file ? &list_.files[*file] : nullptr;
}

bool PlaySet::has_next() {
    while (const auto next = order_.next()) {
        const auto checked = check(list_.files[*next]);
        if (checked || is_stopped_()) {
            break;
        }
        list_.skipped.add(checked.error().message);
        order_.drop_next();
    }
    return order_.has_next();
}

Path PlaySet::next() const {
    const auto next = order_.next();
    return next && !engine::is_pipe(list_.files[*next]) ? list_.files[*next] : Path();
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
          loop_(loop),
          sound_(sound_config(arguments.settings)),
          planner_(models) {}

    // Files that cannot be played are skipped and noted in `files`.
    void play(PlaySet& files);
    // True when the device died.
    [[nodiscard]] bool has_failed() const noexcept { return has_failed_; }
    // True when a file was played, or somebody ended it.
    [[nodiscard]] bool has_played() const noexcept { return has_played_; }

 private:
    using FilePlayerPtr = std::unique_ptr<audio::FilePlayer>;
    [[nodiscard]] Expected<StageEnd> play(const Path& file,
                                          FilePlayerPtr player,
                                          StageSource::Behind behind,
                                          const Path& next);
    [[nodiscard]] Expected<FilePlayerPtr> open(PlaySet& files) const;
    [[nodiscard]] engine::LiveGraphConfig graph_config() const;

    const PlayArguments& arguments_;
    const std::optional<audio::AudioDevice>& output_;
    const engine::AnalyzerModels& models_;
    const engine::Formations& formations_;
    StageLoop& loop_;
    engine::LiveGraphConfig sound_;                       // of every song
    std::optional<engine::OpenLoudspeaker> loudspeaker_;  // between two songs
    engine::SongPlanner planner_;
    bool is_first_ = true;  // the next song to play
    bool has_failed_ = false;
    bool has_played_ = false;
};

// A file that ends, or that cannot be played, is followed by the next one.
void Player::play(PlaySet& files) {
    files.stop_when([this] { return loop_.is_end_wanted(); });
    while (const Path* const file = files.current()) {
        const auto behind = files.has_next()   ? StageSource::Behind::next_file
                            : arguments_.quits ? StageSource::Behind::end
                                               : StageSource::Behind::stay;
        const Path next = files.next();
        auto player = open(files);
        const Expected<StageEnd> end =
            player ? play(*file, std::move(*player), behind, next) : fail(player.error());
        const bool is_end_wanted = loop_.is_end_wanted();
        has_played_ = has_played_ || end || is_end_wanted;
        if (is_end_wanted) {
            return;
        }
        if (!end) {
            loop_.show(end.error().message);
            files.skip_current(end.error().message);
        } else if (*end == StageEnd::quit) {
            return;
        } else if (*end == StageEnd::previous_file) {
            // From the first file "back" stays at the first.
            files.go_back();
        } else {
            files.go_on();
        }
    }
}

// Errors: the file cannot be opened, or begins behind its end.
Expected<Player::FilePlayerPtr> Player::open(PlaySet& files) const {
    const Section& section = arguments_.section;
    const Path& file = *files.current();
    if (auto opened = files.take_pipe()) {
        return audio::FilePlayer::start(std::move(opened), file);
    }
    if (engine::is_pipe(file)) {
        auto pipe = open_pipe(file, section);
        if (!pipe) {
            return fail(pipe.error());
        }
        return audio::FilePlayer::start(std::move(*pipe), file);
    }
    const IsStopped is_stopped = [this] { return loop_.is_end_wanted(); };
    if (auto checked = check_file(file, section, is_stopped); !checked) {
        return fail(checked.error());
    }
    // The file is decoded from the section's start on.
    auto player = audio::FilePlayer::start({file}, {.start_seconds = section.start});
    if (player) {
        // The first callback must not find an empty ring.
        (*player)->wait_until_ready(4096, is_stopped);
    }
    return player;
}

// Plays one file; returns why it ended. `next`: what plays after it, or empty.
Expected<StageEnd> Player::play(const Path& file,
                                FilePlayerPtr player,
                                StageSource::Behind behind,
                                const Path& next) {
    const Section& section = arguments_.section;
    // Nothing is known of a pipe before it sounds. The songs after the first were begun while the
    // one before played.
    std::optional<SongStart> start;
    if (!arguments_.is_as_live && !engine::is_pipe(file)) {
        const Nanos patience = std::exchange(is_first_, false) ? kFirstPatience : kPatience;
        start.emplace(planner_, file, next, patience);
    }
    engine::LiveGraphConfig config = graph_config();
    if (engine::is_pipe(file)) {
        config.models.corrections = nullptr;
    }
    config.is_held_back = start.has_value();
    // Asked before the player is handed over.
    const std::optional<double> duration = player->first_info().claimed_seconds;
    const std::string name = file == "-" ? "standard input" : file.filename().string();
    const audio::AudioTags tags = player->first_info().tags;
    auto graph = engine::LiveGraph::play(
        std::move(player), output_, config, std::exchange(loudspeaker_, std::nullopt));
    if (!graph) {
        return fail(graph.error());
    }
    // The end is counted in seconds of the file.
    if (section.duration) {
        (*graph)->playback()->set_end(section.start + *section.duration);
    }
    say("playing " + (file == "-" ? name : file.string()));
    StageSource source{audio::title_line(tags, name), duration, section.start, behind};
    source.teller = engine::teller_of(engine::told_by(config.models, tags, file));
    // Nobody finds again what comes through a pipe.
    if (config.models.corrections) {
        source.keep_dance = [models = config.models, artist = tags.artist, file](auto dance) {
            return engine::keep_dance(*models.corrections,
                                      {std::string(dance), artist, file, models.genres->genres});
        };
    }
    if (start) {
        source.each_picture = [&start, &graph] { start->look(**graph); };
    }
    const StageEnd end = loop_.run(**graph, source);
    // Messages of the decoder, such as a damaged file.
    const std::vector<std::string> messages = (*graph)->playback()->player().take_messages();
    const bool is_silent = (*graph)->analysis().taken_until() == StreamTime{};
    // Of a file that gave nothing the reason is said once, by whoever skips it.
    if (end == StageEnd::finished && is_silent && !messages.empty()) {
        return fail(messages.front());
    }
    for (const std::string& message : messages) {
        loop_.say(message);
    }
    has_failed_ = has_failed_ || (*graph)->has_lost_device();
    loudspeaker_ = (*graph)->leave_loudspeaker();
    // A file that does not say how long it is shows its end only here.
    if (section.start > 0.0 && end == StageEnd::finished && is_silent) {
        return fail(fmt::format("{}: ends before {} s", file.string(), section.start));
    }
    return end;
}

// The formation may have changed since the last file: its present cast dances on.
engine::LiveGraphConfig Player::graph_config() const {
    engine::LiveGraphConfig config = sound_;
    config.models = models_;
    config.cast = formations_.cast();
    config.is_device_named = !arguments_.settings.output.empty();
    return config;
}

}  // namespace

ExitCode play(const PlayArguments& given) {
    PlayArguments arguments = given;
    auto list = files_to_play(arguments.files);
    if (!list) {
        return fail(list.error());
    }
    // Whether there is anything to play is said before a window opens.
    PlaySet files(std::move(*list), arguments);
    if (auto begun = files.begin(); !begun) {
        return fail(begun.error());
    }
    const KeptWindow kept =
        arguments.is_headless ? KeptWindow() : KeptWindow::recall(arguments.settings);
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
    read_corrections(setup->models);
    engine::Formations& formations = setup->formations;
    auto loop = StageLoop::create(arguments.settings,
                                  {arguments.is_headless,
                                   arguments.window,
                                   std::nullopt,
                                   arguments.outputs,
                                   arguments.video,
                                   kept},
                                  setup->catalogue.list(),
                                  formations);
    if (!loop) {
        return fail(loop.error());
    }
    Player player(arguments, *output, setup->models, formations, **loop);
    player.play(files);
    if (const auto why = (*loop)->why_lost(); !why.empty()) {
        return fail(std::string(why));
    }
    if (!player.has_played()) {
        return fail(nothing_played(files.skipped()));
    }
    for (const std::string& line : files.skipped().report()) {
        complain(line);
    }
    // A signal does not wait for dances that are still being solved.
    const EndAtOnceOnSignals at_once;
    // Dances that were left out meanwhile.
    for (const std::string& line : formations.wait()) {
        (*loop)->say(line);
    }
    return player.has_failed()           ? kExitFailed
           : files.skipped().count() > 0 ? kExitPartly
                                         : kExitDone;
}

}  // namespace raks::apps
