#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks {

/// Commands that wait for their time, in the order in which they were given. `Command` has a
/// `StreamTime time`.
/// Threads: one. Real-time: yes.
template <typename Command, std::size_t kRoom>
class TimedCommands {
    static_assert(std::is_trivially_copyable_v<Command>);

 public:
    /// False: kRoom wait already, and this one is dropped.
    bool push(const Command& command) noexcept RAKS_NONBLOCKING {
        if (count_ == kRoom) {
            return false;
        }
        waiting_[count_++] = command;
        return true;
    }

    /// Takes out every command whose time is `now` or has passed, and calls run(command), which
    /// gives no new ones.
    template <typename Run>
    void run_due(StreamTime now, Run&& run) noexcept {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (waiting_[i].time <= now) {
                run(waiting_[i]);
            } else {
                waiting_[kept++] = waiting_[i];
            }
        }
        count_ = kept;
    }

    void clear() noexcept RAKS_NONBLOCKING { count_ = 0; }

 private:
    std::array<Command, kRoom> waiting_{};
    std::size_t count_ = 0;
};

}  // namespace raks
