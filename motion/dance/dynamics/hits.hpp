// Hits: the trunk answers strong accents of the music.
#pragma once

#include <array>

#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// A short, sharp movement of trunk and head after each strong accent: low ones are taken in the
/// waist, middle ones in the chest, high ones with shoulders and head. Each rises within 0.07 s and
/// dies away within half a second. Threads: one. Real-time: yes.
class Hits {
 public:
    /// One hop. `size`: of the answers, 1 as usual.
    void advance(const MusicState& music, float size) noexcept RAKS_NONBLOCKING;
    /// The pose with what is left of the answers at that moment.
    void apply(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING;
    /// Forgets all accents.
    void reset() noexcept { *this = Hits(); }

 private:
    struct Hit {
        StreamTime since{};
        float size = 0.0F;  // 0: none
        MusicAccent::Band band = MusicAccent::Band::middle;
    };
    std::array<Hit, 3> hits_{};  // a ring: the last ones
    std::size_t next_ = 0;
};

}  // namespace raks::motion
