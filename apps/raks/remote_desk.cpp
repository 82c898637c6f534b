#include "apps/raks/remote_desk.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/remote/listen_place.hpp"
#include "engine/remote/remote_guard.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

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
    if (!arguments.midi_in.empty()) {
        auto midi = engine::MidiInput::open(arguments.midi_in);
        if (!midi) {
            return fail(midi.error());
        }
        desk->midi_ = std::move(*midi);
    }
    if (arguments.follows_link) {
        auto link = engine::LinkSession::open();
        if (!link) {
            return fail(link.error());
        }
        desk->link_ = std::move(*link);
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
    if (midi_) {
        carry_out_midi(actions, lines);
    }
    if (osc_) {
        if (auto trouble = osc_->take_trouble()) {
            lines.push_back("--osc-in: " + *trouble + " (more like it are passed over in silence)");
        }
    }
    return lines;
}

// What one control asks for and cannot be done is said once in a row.
void RemoteDesk::carry_out_midi(const engine::ActionDispatcher& actions,
                                std::vector<std::string>& lines) {
    for (const engine::ActionRequest& request : midi_->take()) {
        const auto done = actions.dispatch(request);
        std::string fault = done ? std::string() : done.error().message;
        if (!fault.empty() && fault != midi_fault_) {
            lines.push_back(fault);
        }
        midi_fault_ = std::move(fault);
    }
    for (std::string& line : midi_->take_lines()) {
        lines.push_back(std::move(line));
    }
}

std::optional<std::string> RemoteDesk::follow_link(engine::LiveGraph& graph,
                                                   const MusicState& music) {
    if (!link_) {
        return std::nullopt;
    }
    const HostTime now = HostClock::now();
    const BeatGrid& grid = music.grid;
    const double bpm = link_->at(now, 1.0).bpm;
    const auto session = link_->at(now, engine::LinkFollower::session_bar(bpm, grid.beats_per_bar));
    // What is seen may be ahead of what is heard; commands are dated by what is seen.
    const auto heard_at = [&](HostTime seen) { return graph.heard_at(graph.moment_at(seen)); };
    const Nanos lead = heard_at(now) - now;
    const auto orders = link_follower_.follow({.now = now,
                                               .peers = session.peers,
                                               .bpm = session.bpm,
                                               .beat = session.beat,
                                               .grid = grid,
                                               .heard = grid.beats_at(graph.moment_at(now - lead)),
                                               .is_held = music.is_tempo_held});
    for (const engine::LinkFollower::Order& order : orders) {
        static_cast<void>(graph.command(order.kind, order.value, order.heard_at - lead));
    }
    link_words_ = fmt::format("--link   {} {}, {:.1f} BPM",
                              session.peers,
                              session.peers == 1 ? "other" : "others",
                              session.bpm);
    if (std::exchange(link_peers_, session.peers) == session.peers) {
        return std::nullopt;
    }
    return session.peers > 0 ? link_words_ : "--link: nobody else is there; the music leads";
}

void RemoteDesk::publish(engine::RemoteState state) {
    if (!link_words_.empty()) {
        state.targets.push_back({link_words_, 0, 0, {}});
    }
    server_->publish(state);
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
