#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/players/known_song.hpp"
#include "engine/players/player_watch.hpp"
#include "engine/remote/remote_message.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::apps {

/// What players on this desktop say of the music that an input hears, handed on to the graph and to
/// the outputs. With a monitor it is asked for unless a person says otherwise. Threads: main.
class PlayerDesk {
 public:
    /// `asked`: --now-playing or --no-now-playing; none: neither. Errors: it is asked for, and this
    /// program was built without it.
    [[nodiscard]] static Expected<PlayerDesk> open(std::optional<bool> asked);

    /// Whether what this graph hears is told by players.
    [[nodiscard]] bool listens(const engine::LiveGraph& graph) const;
    /// Once a picture, or every 20 ms: hands on what has happened. `models`: the graph's. Returns
    /// lines for the person.
    [[nodiscard]] std::vector<std::string> look(engine::LiveGraph& graph,
                                                const engine::AnalyzerModels& models,
                                                engine::Outputs& outputs);
    /// Another graph begins: what is known is handed to it with the next look().
    void begin_anew() noexcept { is_told_ = false; }
    /// This graph ends.
    void leave(engine::LiveGraph& graph) noexcept;

    /// "Title (Artist)"; empty: nothing is known.
    [[nodiscard]] std::string title() const;
    /// Whether it is known, and stands.
    [[nodiscard]] bool is_paused() const noexcept {
        return !now_.player.empty() && now_.status != engine::PlayStatus::playing;
    }
    /// The same for pages.
    [[nodiscard]] engine::RemoteSong song() const;

 private:
    void follow_file(engine::LiveGraph& graph, engine::PlayerEvent::Kind kind);

    explicit PlayerDesk(std::optional<bool> asked) : asked_(asked) {}

    std::optional<bool> asked_;
    std::unique_ptr<engine::PlayerWatch> watch_;  // null: not needed yet
    std::unique_ptr<engine::KnownSong> known_;    // likewise
    std::string file_;                            // that it listens for; empty: none
    engine::NowPlaying now_;
    bool is_told_ = false;  // the graph knows of now_
};

}  // namespace raks::apps
