#pragma once

#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/action_table.hpp"

namespace raks::engine {

/// Requests of other programs on their way to the main thread, which carries them out. What finds
/// it full is refused and counted: nobody waits for room.
///
/// Threads: any, but carry_out(): main. Real-time: no (locks).
class RequestInbox {
 public:
    static constexpr std::size_t kRoom = 64;  ///< requests that wait

    /// Leaves a request whose end nobody waits for. False: there is no room.
    [[nodiscard]] bool post(ActionRequest request);
    /// Leaves a request and waits until it is carried out. Nothing: it was not within `patience`
    /// and will be. Errors: why it was refused; there is no room.
    [[nodiscard]] std::optional<Expected<void>> ask(ActionRequest request, Nanos patience);

    /// Carries out what waits, in the order in which it came. Returns a line about the first
    /// request that was refused and that nobody waits for, unless it is the line of the call
    /// before.
    [[nodiscard]] std::optional<std::string> carry_out(const ActionDispatcher& actions);

    /// Requests that found no room.
    [[nodiscard]] std::size_t refused() const;

 private:
    struct Waiting {
        ActionRequest request;
        std::shared_ptr<std::promise<Expected<void>>> answer;  // null: nobody waits for it
    };
    [[nodiscard]] bool leave(Waiting waiting);

    mutable std::mutex mutex_;
    std::deque<Waiting> waiting_;
    std::size_t refused_ = 0;
    std::string last_fault_;  // of the main thread
};

}  // namespace raks::engine
