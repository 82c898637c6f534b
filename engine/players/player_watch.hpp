#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/players/player_list.hpp"

namespace raks::engine {

/// Listens on the session bus for players of music (MPRIS), on a thread of its own that sleeps
/// until one of them says something. It asks each once what it plays, waits for nobody, and calls
/// nothing that would change anything. Where players send more than a person could have meant, it
/// leaves the bus for ten seconds.
///
/// A bus that is not there is looked for again every ten seconds.
/// Threads: main, for all methods.
class PlayerWatch {
 public:
    /// Whether this program was built with it (RAKS_NOW_PLAYING).
    [[nodiscard]] static bool is_built() noexcept;
    /// Starts the thread; null where the program was built without it.
    [[nodiscard]] static std::unique_ptr<PlayerWatch> open();
    ~PlayerWatch();                                       ///< joins the thread
    PlayerWatch(const PlayerWatch&) = delete;             ///< the thread refers to it
    PlayerWatch& operator=(const PlayerWatch&) = delete;  ///< likewise

    /// What has happened since the last call, in order.
    [[nodiscard]] std::vector<PlayerEvent> take_events();
    /// Lines for the person since the last call: why nobody is heard.
    [[nodiscard]] std::vector<std::string> take_lines();

 private:
    struct Impl;
    explicit PlayerWatch(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::engine
