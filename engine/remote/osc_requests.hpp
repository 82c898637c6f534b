#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "engine/control/action_table.hpp"

namespace raks::engine {

/// What a packet of OSC asks for.
struct OscRequests {
    std::vector<ActionRequest> requests;  ///< in the order of the packet
    std::size_t faults = 0;               ///< messages that were passed over
    std::string fault;                    ///< the first of them, in one line; empty: none
};

/// Largest packet that is read, in bytes.
inline constexpr std::size_t kLongestOscPacket = 8'192;
/// Bundles in bundles that are read.
inline constexpr int kDeepestOscBundle = 4;

/// Reads a packet: `/raks/do/NAME` with one number or text, or without any. A number for an action
/// that takes none is a button: 0 does nothing, every other asks for it. Time tags are passed over:
/// all comes now. Whatever the bytes are, what cannot be read is counted. Threads: any. Real-time:
/// no.
[[nodiscard]] OscRequests read_osc_requests(std::span<const char> packet, HostTime now);

}  // namespace raks::engine
