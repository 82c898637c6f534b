#pragma once

#include <optional>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/osc_packet.hpp"
#include "engine/outputs/output.hpp"
#include "engine/outputs/output_target.hpp"
#include "engine/outputs/udp_peer.hpp"

namespace raks::engine {

/// Whose addresses are sent.
enum class OscPreset { raks, plain, resolume };

/// What a person writes behind --osc.
struct OscTarget {
    HostPort place;
    OscPreset preset = OscPreset::raks;
    std::string prefix;   ///< of all addresses: empty, or "/" and more
    double rate = 0.0;    ///< of phases and levels, a second; 0: they are not sent
    OutputTiming timing;  ///< of beats and events
};
/// Errors: what is wrong with it.
[[nodiscard]] Expected<OscTarget> read_osc_target(const std::string& target);

/// What all presets have: the peer, and who counts.
class OscOutput : public Output {
 public:
    /// Looks the host up meanwhile.
    explicit OscOutput(const OscTarget& target)
        : Output(target.timing), prefix_(target.prefix), peer_(target.place) {}
    void turn(const OutputTurn& turn) override { peer_.turn(turn.now); }  ///< sends nothing
    std::optional<std::string> take_trouble() override { return peer_.take_trouble(); }

 protected:
    /// A message of its own, at once.
    template <typename... Arguments>
    void send(const char* address, Arguments... arguments) {
        OscPacket packet;
        packet.add(prefix_ + address, arguments...);
        count(peer_.send(packet.finish()));
    }
    /// A bundle that has messages.
    void send(OscPacket& bundle) {
        if (bundle.messages() > 0) {
            count(peer_.send(bundle.finish()));
        }
    }
    /// As it stands before all addresses.
    [[nodiscard]] const std::string& prefix() const noexcept { return prefix_; }

 private:
    std::string prefix_;
    UdpPeer peer_;
};

}  // namespace raks::engine
