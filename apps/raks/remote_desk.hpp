#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/link_follower.hpp"
#include "engine/control/request_inbox.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/midi/midi_input.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/remote/link_code.hpp"
#include "engine/remote/link_session.hpp"
#include "engine/remote/osc_input.hpp"
#include "engine/remote/remote_message.hpp"
#include "engine/remote/remote_server.hpp"
#include "render/overlay/overlay.hpp"

namespace raks::apps {

/// Where other programs and phones come in, of `play` and `live`. Threads: main.
class RemoteDesk {
 public:
    /// Opens what is asked for, which may be nothing. Errors: a port that cannot be opened, a token
    /// that cannot be kept.
    [[nodiscard]] static Expected<std::unique_ptr<RemoteDesk>> open(
        const RemoteArguments& arguments);

    /// What was opened, in lines that are said once: the link of the page with its token.
    [[nodiscard]] const std::vector<std::string>& opening_lines() const noexcept { return lines_; }
    /// The link as a phone's camera reads it, where a phone can reach the page and none has yet, in
    /// the first minute.
    [[nodiscard]] std::optional<render::OverlayCode> code_for_phones();
    /// Whether anybody can ask for something.
    [[nodiscard]] bool is_open() const noexcept { return osc_ || midi_ || link_ || server_; }
    /// The MIDI controller; null: none is listened to.
    [[nodiscard]] engine::MidiInput* midi() const noexcept { return midi_.get(); }
    /// Carries out what came since the last call. Returns lines about what could not be.
    [[nodiscard]] std::vector<std::string> carry_out(const engine::ActionDispatcher& actions);
    /// Makes the beats those of Link's session, where it is followed and somebody is in it.
    /// `music`: as it is known. Returns a line when others have come or gone.
    [[nodiscard]] std::optional<std::string> follow_link(engine::LiveGraph& graph,
                                                         const MusicState& music);
    /// The session as it stands: "--link   2 others, 120.0 BPM"; empty: it is not followed.
    [[nodiscard]] const std::string& link_words() const noexcept { return link_words_; }
    /// Whether pages are to be told the state again: 20 times a second; false where nobody can ask.
    [[nodiscard]] bool wants_state(HostTime now);
    /// Tells them; the session is added to who is told of the music.
    void publish(engine::RemoteState state);
    /// Tells them what can be chosen.
    void publish(const engine::RemoteChoices& choices);

 private:
    RemoteDesk() = default;
    [[nodiscard]] Expected<void> open_server(const RemoteArguments& arguments);
    void carry_out_midi(const engine::ActionDispatcher& actions, std::vector<std::string>& lines);

    engine::RequestInbox inbox_;  // before those who fill it
    std::unique_ptr<engine::OscInput> osc_;
    std::unique_ptr<engine::MidiInput> midi_;
    std::unique_ptr<engine::LinkSession> link_;
    engine::LinkFollower link_follower_;
    std::optional<std::size_t> link_peers_;  // as said last
    std::string link_words_;
    std::string midi_fault_;  // of its last request; empty: it was carried out
    std::unique_ptr<engine::RemoteServer> server_;
    std::vector<std::string> lines_;
    engine::LinkCode phone_code_;
    HostTime opened_ = HostClock::now();
    HostTime next_state_{};
};

/// What is heard now, for pages: source, tempo, beats to come, level, and who else is told.
[[nodiscard]] engine::RemoteState heard_state(engine::LiveGraph& graph,
                                              const MusicState& music,
                                              const engine::Outputs& outputs,
                                              const DanceList& dances);

}  // namespace raks::apps
