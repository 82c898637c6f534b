// Energy range: how often the music has given less than now.
#pragma once

#include <array>

#include "base/realtime.hpp"

namespace raks::motion {

/// The energies of the last minutes of music as a distribution. Music keeps to a part of [0, 1]; a
/// dance that shall use all that it has goes by how often the music has given less. Before much is
/// heard all energies are held equally likely. Threads: one. Real-time: yes.
class EnergyRange {
 public:
    /// One hop of music that sounds: energy, [0, 1].
    void hear(float energy) noexcept RAKS_NONBLOCKING;
    /// Share of the music that has given less than this, [0, 1]. It grows with `energy`.
    [[nodiscard]] double share_below(double energy) const noexcept RAKS_NONBLOCKING;
    /// As before any music.
    void reset() noexcept { *this = EnergyRange(); }

 private:
    static constexpr std::size_t kBins = 32;
    std::array<float, kBins> seconds_{};  // by energy; old ones fade
    float sum_ = 0.0F;
};

}  // namespace raks::motion
