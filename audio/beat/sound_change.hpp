#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// Detects that the sound has become another's, as where one song is cut to the next: the loudness
/// of pairs of bands over the last 0.7 s, compared with its mean and variance over the seconds
/// before. Players who pause or come in make no other song: some bands must become louder and some
/// softer.
///
/// Threads: one. Real-time: yes.
class SoundChange {
 public:
    static constexpr std::size_t kBands = 18;  ///< pairs of mel bands
    /// Length of the compared window in hops of 10 ms; a change is reported about that late.
    static constexpr std::size_t kWindow = 70;

    /// Takes the next hop's loudness of the pairs of bands, see NetworkInput. True once for each
    /// change; none is reported within 2 s of the start or of another change.
    bool add(std::span<const float, kBands> loudness) noexcept RAKS_NONBLOCKING;

    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING { *this = SoundChange(); }

 private:
    using Sums = std::array<double, kBands>;
    static constexpr std::size_t kKept = 2 * kWindow;

    void slide(std::span<const float, kBands> loudness) noexcept;
    void learn() noexcept;
    [[nodiscard]] bool is_another() const noexcept;

    std::array<std::array<float, kBands>, kKept> ring_{};  // loudness of the last hops
    std::size_t next_ = 0;                                 // place in ring_
    int hops_ = 0;                                         // hops in ring_, at most kKept
    Sums newest_{};                                        // sum over the last window
    Sums before_{};                                        // sum over the window before that
    // Of windows' mean loudness, since the last change.
    Sums mean_{};
    Sums variance_{};
    int learnt_ = 0;  // hops in mean_ and variance_, at most as many as they remember
};

}  // namespace raks::audio
