#pragma once

#include <array>
#include <cstddef>

#include "audio/form/hop_sound.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Where music ends, should it end now: at its last chord or beat, however long that rings and
/// whatever crackles in its decay; in a fade-out, whose beats go on as they were, where it can
/// no longer be heard. Threads: one. Real-time: yes.
class LastChord {
 public:
    /// The next hop. `peak`: AccentDetector::weight() where it is the greatest of its surroundings,
    /// else 0.
    void advance(HopIndex hop, const HopSound& sound, float peak) noexcept RAKS_NONBLOCKING;
    /// The end as far as it is known; 0: there was no onset.
    [[nodiscard]] HopIndex hop() const noexcept;
    /// Forgets the stream.
    void reset() noexcept { *this = LastChord(); }

 private:
    static constexpr std::size_t kSeconds = 24;

    [[nodiscard]] float usual_strength() const noexcept;

    std::array<float, kSeconds> strongest_{};  // onset by second, ring
    std::size_t hops_ = 0;
    HopIndex chord_ = 0;    // the last onset as strong as those of the song
    bool goes_on_ = false;  // onsets that are nearly as strong came soon after it
    float loud_ = -200.0F;  // dBFS, falls slowly
    HopIndex heard_ = 0;    // the last hop that is heard
};

}  // namespace raks::audio
