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
        if (std::exchange(now_, {}) != engine::NowPlaying{}) {
            outputs.name_song({});
        }
        return {};
    }
    if (!watch_) {
        watch_ = engine::PlayerWatch::open();
    }
    std::vector<engine::PlayerEvent> events = watch_->take_events();
    if (events.empty() && !std::exchange(is_told_, true) && !now_.player.empty()) {
        events.push_back({PlayerKind::told, now_});
    }
    for (engine::PlayerEvent& event : events) {
        now_ = std::move(event.now);
        // A full queue: the next news counts again.
        static_cast<void>(graph.tell(news_of(event.kind, told_song(models, now_.tags))));
        outputs.name_song({now_.tags.title, now_.tags.artist});
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

std::string PlayerDesk::title() const { return audio::title_line(now_.tags, {}); }

engine::RemoteSong PlayerDesk::song() const {
    return {
        now_.player, now_.tags.title, now_.tags.artist, now_.status == engine::PlayStatus::playing};
}

}  // namespace raks::apps
