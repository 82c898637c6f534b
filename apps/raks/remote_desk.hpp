#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/request_inbox.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/remote/link_code.hpp"
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
    [[nodiscard]] bool is_open() const noexcept { return osc_ || server_; }
    /// Carries out what came since the last call. Returns lines about what could not be.
    [[nodiscard]] std::vector<std::string> carry_out(const engine::ActionDispatcher& actions);
    /// Whether pages are to be told the state again: 20 times a second; false where nobody can ask.
    [[nodiscard]] bool wants_state(HostTime now);
    /// Tells them.
    void publish(const engine::RemoteState& state) { server_->publish(state); }
    /// Tells them what can be chosen.
    void publish(const engine::RemoteChoices& choices);

 private:
    RemoteDesk() = default;
    [[nodiscard]] Expected<void> open_server(const RemoteArguments& arguments);

    engine::RequestInbox inbox_;  // before those who fill it
    std::unique_ptr<engine::OscInput> osc_;
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
