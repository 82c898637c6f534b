// The only source that includes Ableton Link, which is under the GPL, version 2 or later.
#include "engine/remote/link_session.hpp"

#include <ableton/Link.hpp>

#include <chrono>
#include <exception>
#include <string>

namespace raks::engine {
namespace {

constexpr double kFirstTempo = 120.0;  // of a session that nobody has begun yet

class JoinedSession final : public LinkSession {
 public:
    JoinedSession() : link_(kFirstTempo) { link_.enable(true); }

    // Link's clock runs apart from ours by a little: both are read again each time.
    Moment at(HostTime time, double beats_per_bar) override {
        const auto since = std::chrono::round<std::chrono::microseconds>(time - host_now());
        const auto there = link_.clock().micros() + since;
        const auto state = link_.captureAppSessionState();
        return {link_.numPeers(), state.tempo(), state.phaseAtTime(there, beats_per_bar)};
    }

 private:
    ableton::Link link_;
};

}  // namespace

Expected<std::unique_ptr<LinkSession>> LinkSession::open() {
    try {
        return std::make_unique<JoinedSession>();
    } catch (const std::exception& error) {
        return fail(std::string("--link: ") + error.what());
    }
}

}  // namespace raks::engine
