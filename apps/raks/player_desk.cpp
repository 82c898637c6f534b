#include "apps/raks/player_desk.hpp"

#include <utility>

#include "apps/terminal/say.hpp"
#include "engine/setup/told_genre.hpp"

namespace raks::apps {
namespace {

using PlayerKind = engine::PlayerEvent::Kind;

// What a player says counts as what a file says of itself.
audio::ToldSong told_song(const engine::AnalyzerModels& models, const audio::AudioTags& tags) {
    const engine::AnalyzerModels told = engine::told(models, tags, {});
    return {told.genre_prior, told.told_bpm};
}

engine::SongNews news_of(PlayerKind kind, const audio::ToldSong& song) {
    switch (kind) {
        case PlayerKind::begins:
            return {engine::SongNews::Kind::begins, song};
        case PlayerKind::told:
            return {engine::SongNews::Kind::told, song};
        case PlayerKind::jump:
            return {engine::SongNews::Kind::jump, {}};
        case PlayerKind::stop:
            break;
    }
    return {engine::SongNews::Kind::pause, {}};
}

}  // namespace

Expected<PlayerDesk> PlayerDesk::open(std::optional<bool> asked) {
    if (asked.value_or(false) && !engine::PlayerWatch::is_built()) {
        return fail("--now-playing: this raks was built without it (RAKS_NOW_PLAYING, libsystemd)");
    }
    return PlayerDesk(asked);
}

bool PlayerDesk::listens(const engine::LiveGraph& graph) const {
    return graph.is_input() && engine::PlayerWatch::is_built() &&
           asked_.value_or(graph.device().is_monitor);
}

std::vector<std::string> PlayerDesk::look(engine::LiveGraph& graph,
                                          const engine::AnalyzerModels& models,
                                          engine::Outputs& outputs) {
    if (!listens(graph)) {
        watch_.reset();
        leave(graph);
        known_.reset();
        if (std::exchange(now_, {}) != engine::NowPlaying{}) {
            outputs.name_song({});
        }
        return {};
    }
    if (!watch_) {
        watch_ = engine::PlayerWatch::open();
        known_ = std::make_unique<engine::KnownSong>(models);
    }
    std::vector<engine::PlayerEvent> events = watch_->take_events();
    if (!std::exchange(is_told_, true)) {
        graph.analysis().set_tap(engine::AnalysisStage::Listener::known_song, &known_->tap());
        file_.clear();
        if (events.empty() && !now_.player.empty()) {
            events.push_back({PlayerKind::told, now_});
        }
    }
    for (engine::PlayerEvent& event : events) {
        now_ = std::move(event.now);
        // A full queue: the next news counts again.
        static_cast<void>(graph.tell(news_of(event.kind, told_song(models, now_.tags))));
        follow_file(graph, event.kind);
        outputs.name_song({now_.tags.title, now_.tags.artist});
    }
    if (const auto heard = known_->take()) {
        graph.follow_song(heard->plan, heard->shift);
        say_detail(now_.tags.title + (heard->plan ? ": its file is known ahead, and followed"
                                                  : ": its file is not heard any more"));
    }
    std::vector<std::string> lines = watch_->take_lines();
    if (!asked_) {
        // Nobody asked for it: most computers without a bus of the session need none.
        for (const std::string& line : std::exchange(lines, {})) {
            say_detail(line);
        }
    }
    return lines;
}

// A song that begins, or goes on elsewhere, is sought anew; what is said more of it is not.
void PlayerDesk::follow_file(engine::LiveGraph& graph, PlayerKind kind) {
    const bool plays = now_.status == engine::PlayStatus::playing;
    const std::string file = plays ? now_.file : std::string();
    if (kind == PlayerKind::told && file == file_) {
        return;
    }
    // Its plan ends at once; the sound of another song would be danced to by it.
    graph.follow_song(nullptr, {});
    known_->listen(file, kind == PlayerKind::begins);
    file_ = file;
}

void PlayerDesk::leave(engine::LiveGraph& graph) noexcept {
    if (known_ && graph.is_input()) {
        graph.analysis().set_tap(engine::AnalysisStage::Listener::known_song, nullptr);
    }
}

std::string PlayerDesk::title() const { return audio::title_line(now_.tags, {}); }

engine::RemoteSong PlayerDesk::song() const {
    return {
        now_.player, now_.tags.title, now_.tags.artist, now_.status == engine::PlayStatus::playing};
}

}  // namespace raks::apps
