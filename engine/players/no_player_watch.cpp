// In place of player_watch.cpp and player_message.cpp where the program is built without them.
#include "engine/players/player_watch.hpp"

#include <utility>

namespace raks::engine {

struct PlayerWatch::Impl {};

bool PlayerWatch::is_built() noexcept { return false; }

std::unique_ptr<PlayerWatch> PlayerWatch::open() { return nullptr; }

PlayerWatch::PlayerWatch(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PlayerWatch::~PlayerWatch() = default;
std::vector<PlayerEvent> PlayerWatch::take_events() { return {}; }
std::vector<std::string> PlayerWatch::take_lines() { return {}; }

}  // namespace raks::engine
