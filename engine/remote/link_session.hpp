#pragma once

#include <cstddef>
#include <memory>

#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// The session of Ableton Link on this network, which a show follows and never changes.
/// Threads: main.
class LinkSession {
 public:
    /// Joins it. Errors: Raks was built without it; the network refuses.
    [[nodiscard]] static Expected<std::unique_ptr<LinkSession>> open();
    virtual ~LinkSession() = default;  ///< leaves it; its tempo stays

    /// What a session has at a moment.
    struct Moment {
        std::size_t peers = 0;  ///< other programs; 0: nobody leads
        double bpm = 120.0;     ///< 20 to 999
        double beat = 0.0;      ///< in a bar of so many beats as were asked for, 0 on its first
    };
    /// At a time, in bars of so many of its beats (> 0).
    [[nodiscard]] virtual Moment at(HostTime time, double beats_per_bar) = 0;

 protected:
    LinkSession() = default;
};

}  // namespace raks::engine
