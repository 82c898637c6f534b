#include "engine/live/stage_state.hpp"

#include <algorithm>

namespace raks::engine {

void StageState::copy_used(const StageState& from) noexcept RAKS_NONBLOCKING {
    std::copy_n(from.tracks.begin(), from.dancers, tracks.begin());
    dancers = from.dancers;
    places = from.places;
    music = from.music;
    dancer = from.dancer;
    published_at_ns = from.published_at_ns;
    recent = from.recent;
}

}  // namespace raks::engine
