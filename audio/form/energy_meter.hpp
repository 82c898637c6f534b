#pragma once

#include <array>
#include <cstddef>

#include "audio/form/energy_scale.hpp"
#include "audio/form/hop_sound.hpp"
#include "audio/form/running_range.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// How much the music gives, against what it gave in the last two minutes: MusicState::energy of a
/// stream. Threads: one. Real-time: yes.
class EnergyMeter {
 public:
    /// The next hop. `is_stopped`: nothing sounds, see PauseDetector; the range stands still then.
    MusicEnergy advance(const HopSound& sound, bool is_stopped) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept { *this = EnergyMeter(); }

 private:
    static constexpr std::size_t kRemembered = 600;  // values: two minutes, each 0.2 s
    static constexpr std::size_t kKept = 300;        // values of 0.1 s: half a minute

    void follow(const HopSound& sound) noexcept;
    [[nodiscard]] float measure() noexcept;
    void average(float now) noexcept;

    bool has_begun_ = false;
    long hops_ = 0;         // that sounded
    EnergyParts first_{};   // the parts after one low-pass
    EnergyParts second_{};  // and after two
    std::array<RunningRange<kRemembered>, kEnergyParts> ranges_;
    std::array<EnergyRange, kEnergyParts> known_{};  // of ranges_, as last looked up
    float gate_ = 0.0F;                              // 0 in a stop, 1 while music sounds

    std::array<float, kKept> kept_{};  // energies, ring
    std::size_t kept_count_ = 0;
    float sum_ = 0.0F;  // of `now` since the last one that was kept
    int summed_ = 0;
    MusicEnergy energy_;
};

}  // namespace raks::audio
