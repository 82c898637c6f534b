#pragma once

#include "base/time.hpp"

namespace raks::engine {

/// Turns at even distances in time; late ones are left out, never made up for.
class PacedTurns {
 public:
    explicit PacedTurns(double per_second) noexcept  ///< > 0
        : span_(nanos_from_seconds(1.0 / per_second)) {}

    /// Whether one is due; the next one is a span later.
    [[nodiscard]] bool take(HostTime now) noexcept {
        if (now < next_) {
            return false;
        }
        next_ = next_ + span_ > now ? next_ + span_ : now + span_;
        return true;
    }
    /// When the next one is.
    [[nodiscard]] HostTime next() const noexcept { return next_; }

 private:
    Nanos span_;
    HostTime next_{};
};

}  // namespace raks::engine
