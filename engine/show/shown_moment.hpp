#pragma once

#include "base/music_state.hpp"
#include "engine/show/dancer_bodies.hpp"
#include "motion/dancer.hpp"

namespace raks::engine {

/// One moment of the dance, as a picture is to show it.
struct ShownMoment {
    const MusicState& music;             ///< the state that the overlay describes
    const motion::DancerStatus& dancer;  ///< of the first dancer
    DancedMoment danced;                 ///< what is seen
};

}  // namespace raks::engine
