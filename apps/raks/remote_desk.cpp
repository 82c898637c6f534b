#include "apps/raks/remote_desk.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/remote/listen_place.hpp"
#include "engine/remote/remote_guard.hpp"
#include "engine/setup/user_folders.hpp"

namespace raks::apps {
namespace {

constexpr Nanos kStatesApart = std::chrono::milliseconds(50);
constexpr Nanos kCodeShownFor = std::chrono::minutes(1);
constexpr int kBeatsAhead = 4;
constexpr float kKnownBar = 0.35F;  // as in the overlay

Expected<std::string> token_of(const RemoteArguments& arguments) {
    return arguments.keeps_token
               ? engine::kept_remote_token(engine::xdg_folder("XDG_STATE_HOME", ".local/state"))
               : engine::new_remote_token();
}

// The beats that are heard next; none while the music stands.
std::vector<engine::RemoteBeat> beats_after(HostTime now,
                                            engine::LiveGraph& graph,
                                            const BeatGrid& grid) {
    std::vector<engine::RemoteBeat> beats;
    double beat = std::ceil(grid.beats_at(graph.moment_at(now)).count()) - 1.0;
    for (int i = 0; i < kBeatsAhead + 2 && beats.size() < kBeatsAhead; ++i, beat += 1.0) {
        const HostTime heard_at = graph.heard_at(grid.time_of(Beats(beat)));
        if (heard_at > now) {
            const auto position = std::lround(grid.bar_position(Beats(beat)));
            const bool is_known = grid.bar_confidence > kKnownBar;
            beats.push_back({heard_at, is_known ? static_cast<int>(position) + 1 : 0});
        }
    }
    return beats;
}

}  // namespace

Expected<std::unique_ptr<RemoteDesk>> RemoteDesk::open(const RemoteArguments& arguments) {
    std::unique_ptr<RemoteDesk> desk(new RemoteDesk);
    if (!arguments.osc_in.empty()) {
        auto osc = engine::OscInput::open(arguments.osc_in, desk->inbox_);
        if (!osc) {
            return fail(osc.error());
        }
        desk->osc_ = std::move(*osc);
        desk->lines_.push_back("OSC is heard at " + desk->osc_->place() + ": /raks/do/ACTION");
    }
    if (arguments.has_server) {
        if (auto opened = desk->open_server(arguments); !opened) {
            return fail(opened.error());
        }
    }
    return desk;
}

Expected<void> RemoteDesk::open_server(const RemoteArguments& arguments) {
    const auto place =
        engine::parse_listen_place(arguments.address, engine::RemoteServer::kUsualPort);
    if (!place) {
        return fail("--remote-address: " + place.error().message);
    }
    const auto token = token_of(arguments);
    if (!token) {
        return fail("--remote-token: " + token.error().message);
    }
    auto server = engine::RemoteServer::open(*place, *token, inbox_);
    if (!server) {
        return fail(server.error());
    }
    server_ = std::move(*server);
    const std::string link = engine::remote_link(server_->place(), *token);
    lines_.push_back("remote control: " + link);
    if (!place->is_loopback()) {
        phone_code_ = engine::link_code(link);
    }
    return {};
}

std::vector<std::string> RemoteDesk::carry_out(const engine::ActionDispatcher& actions) {
    std::vector<std::string> lines;
    if (auto fault = inbox_.carry_out(actions)) {
        lines.push_back(std::move(*fault));
    }
    if (osc_) {
        if (auto trouble = osc_->take_trouble()) {
            lines.push_back("--osc-in: " + *trouble + " (more like it are passed over in silence)");
        }
    }
    return lines;
}

// Whoever is there has no more use for it, and it opens the door.
std::optional<render::OverlayCode> RemoteDesk::code_for_phones() {
    if (server_ && (server_->pages() > 0 || HostClock::now() > opened_ + kCodeShownFor)) {
        phone_code_ = {};
    }
    if (phone_code_.side == 0) {
        return std::nullopt;
    }
    return render::OverlayCode{phone_code_.side, phone_code_.modules, "remote control"};
}

bool RemoteDesk::wants_state(HostTime now) {
    if (!server_ || now < next_state_) {
        return false;
    }
    next_state_ = std::max(next_state_ + kStatesApart, now);
    return true;
}

void RemoteDesk::publish(const engine::RemoteChoices& choices) {
    if (server_) {
        server_->publish(choices);
    }
}

engine::RemoteState heard_state(engine::LiveGraph& graph,
                                const MusicState& music,
                                const engine::Outputs& outputs,
                                const DanceList& dances) {
    engine::RemoteState state;
    const BeatGrid& grid = music.grid;
    const engine::Playback* const playback = graph.playback();
    state.now = HostClock::now();
    state.source = graph.device().name;
    state.bpm = grid.tempo.bpm();
    state.confidence = grid.confidence;
    state.is_held = music.is_tempo_held;
    state.is_locked = grid.confidence >= BeatGrid::kDanceable || music.is_tempo_held;
    state.is_silent = music.is_silent;
    state.beats_per_bar = grid.beats_per_bar;
    state.is_paused = playback != nullptr && playback->is_paused();
    state.level_dbfs = graph.analysis().level_dbfs(state.now);
    state.genre = music.genre == DanceId::none ? "" : dances.name_of(music.genre);
    if (grid.bar_confidence > kKnownBar) {
        const Beats heard = grid.beats_at(graph.moment_at(state.now));
        state.count = static_cast<int>(grid.bar_position(heard)) + 1;
    }
    if (state.is_locked && !state.is_paused) {
        state.beats = beats_after(state.now, graph, grid);
    }
    for (engine::OutputStatus& target : outputs.status()) {
        state.targets.push_back(
            {std::move(target.name), target.sent, target.dropped, std::move(target.trouble)});
    }
    return state;
}

}  // namespace raks::apps
