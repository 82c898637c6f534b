#include "apps/raks/song_player.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/live_sound.hpp"
#include "apps/raks/song_start.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_tags.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "engine/setup/told_genre.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// How long the first song, and the others, may be analyzed before they begin to sound.
constexpr Nanos kFirstPatience = std::chrono::milliseconds(1500);
constexpr Nanos kPatience = std::chrono::seconds(5);

std::string name_of(const Path& file) {
    return file == "-" ? "standard input" : file.filename().string();
}

}  // namespace

SongPlayer::SongPlayer(const Means& means)
    : arguments_(means.arguments),
      output_(means.output),
      models_(means.models),
      formations_(means.formations),
      loop_(means.loop),
      sound_(sound_config(means.arguments.settings)),
      planner_(means.models) {}

// A file that ends, or that cannot be played, is followed by the next one.
SongPlayer::End SongPlayer::play(PlaySet& files, std::optional<double> place) {
    files.stop_when([this] { return loop_.is_end_wanted(); });
    while (const Path* const file = files.current()) {
        const auto behind = files.has_next()   ? StageSource::Behind::next_file
                            : arguments_.quits ? StageSource::Behind::end
                                               : StageSource::Behind::stay;
        const Expected<StageEnd> end =
            play(Song{*file, behind, files.next(), std::exchange(place, std::nullopt)}, files);
        const bool is_end_wanted = loop_.is_end_wanted();
        has_played_ = has_played_ || end || is_end_wanted;
        if (is_end_wanted) {
            return End::over;
        }
        if (!end) {
            loop_.show(end.error().message);
            files.skip_current(end.error().message);
            continue;
        }
        switch (*end) {
            case StageEnd::quit:
                return End::over;
            case StageEnd::wish:
                return End::wish;
            case StageEnd::previous_file:
                // From the first file "back" stays at the first.
                files.go_back();
                break;
            case StageEnd::chosen_file:
                break;
            case StageEnd::next_file:
            case StageEnd::finished:
                files.go_on();
                break;
        }
    }
    return End::over;
}

// Errors: the file cannot be opened, or begins behind its end.
Expected<SongPlayer::FilePlayerPtr> SongPlayer::open(PlaySet& files) const {
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

StageSource SongPlayer::source_of(const Song& song,
                                  PlaySet& files,
                                  const audio::FilePlayer& player,
                                  const engine::AnalyzerModels& models) const {
    const audio::AudioTags tags = player.first_info().tags;
    StageSource source;
    source.name = audio::title_line(tags, name_of(song.file));
    source.duration = player.first_info().claimed_seconds;
    source.start = arguments_.section.start;
    source.behind = song.behind;
    source.queue = &files;
    source.teller = engine::teller_of(engine::told_by(models, tags, song.file));
    // Nobody finds again what comes through a pipe.
    if (models.corrections) {
        source.keep_dance = [models, artist = tags.artist, file = song.file](auto dance) {
            return engine::keep_dance(*models.corrections,
                                      {std::string(dance), artist, file, models.genres->genres});
        };
    }
    return source;
}

// Plays one file; returns why it ended.
Expected<StageEnd> SongPlayer::play(const Song& song, PlaySet& files) {
    auto player = open(files);
    if (!player) {
        return fail(player.error());
    }
    const Section& section = arguments_.section;
    // The file's name may go with the set.
    const Path file = song.file;
    // Nothing is known of a pipe before it sounds. The songs after the first were begun while the
    // one before played.
    std::optional<SongStart> start;
    if (!arguments_.is_as_live && !engine::is_pipe(file)) {
        const Nanos patience = std::exchange(is_first_, false) ? kFirstPatience : kPatience;
        start.emplace(planner_, file, song.next, patience);
    }
    engine::LiveGraphConfig config = config_for(file);
    config.is_held_back = start.has_value();
    // Asked before the player is handed over.
    StageSource source = source_of(song, files, **player, config.models);
    auto graph = engine::LiveGraph::play(
        std::move(*player), output_, config, std::exchange(loudspeaker_, std::nullopt));
    if (!graph) {
        return fail(graph.error());
    }
    // The end is counted in seconds of the file.
    if (section.duration) {
        (*graph)->playback()->set_end(section.start + *section.duration);
    }
    if (song.place) {
        (*graph)->playback()->seek(*song.place);
    } else {
        say("playing " + (file == "-" ? name_of(file) : file.string()));
    }
    if (start) {
        source.each_picture = [&start, &graph] { start->look(**graph); };
    }
    return after(**graph, loop_.run(**graph, source), file);
}

// What is said and kept of a file that has ended. Errors: nothing of it sounded; the line says why.
Expected<StageEnd> SongPlayer::after(engine::LiveGraph& graph, StageEnd end, const Path& file) {
    // Messages of the decoder, such as a damaged file.
    const std::vector<std::string> messages = graph.playback()->player().take_messages();
    const bool is_silent = graph.analysis().taken_until() == StreamTime{};
    // Of a file that gave nothing the reason is said once, by whoever skips it.
    if (end == StageEnd::finished && is_silent && !messages.empty()) {
        return fail(messages.front());
    }
    for (const std::string& message : messages) {
        loop_.say(message);
    }
    place_ = graph.playback()->position_seconds();
    has_failed_ = has_failed_ || graph.has_lost_device();
    loudspeaker_ = graph.leave_loudspeaker();
    // A file that does not say how long it is shows its end only here.
    const double start = arguments_.section.start;
    if (start > 0.0 && end == StageEnd::finished && is_silent) {
        return fail(fmt::format("{}: ends before {} s", file.string(), start));
    }
    return end;
}

// The formation may have changed since the last file: its present cast dances on.
engine::LiveGraphConfig SongPlayer::config_for(const Path& file) const {
    engine::LiveGraphConfig config = sound_;
    config.models = models_;
    config.cast = formations_.cast();
    config.is_device_named = !arguments_.settings.output.empty();
    if (engine::is_pipe(file)) {
        config.models.corrections = nullptr;
    }
    return config;
}

}  // namespace raks::apps
