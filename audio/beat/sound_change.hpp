#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/realtime.hpp"

namespace raks::audio {

/// Whether the sound has become another's, as where one song cuts into the next: how loud pairs of
/// bands are over the last 0.7 s, against how that lay over the seconds before (mean and variance
/// of each). Players who pause or come in are no other song: some bands have to get louder and some
/// softer.
///
/// Threads: one. Real-time: yes.
class SoundChange {
 public:
    static constexpr std::size_t kBands = 18;
    /// Hops of 10 ms that tell a change; about as old is what it tells.
    static constexpr std::size_t kWindow = 70;

    /// The loudness of one more hop, see NetworkInput. True once for each change; none is told
    /// within 2 s of the start or of another.
    bool add(std::span<const float, kBands> loudness) noexcept RAKS_NONBLOCKING;

    void reset() noexcept RAKS_NONBLOCKING { *this = SoundChange(); }

 private:
    using Sums = std::array<double, kBands>;
    static constexpr std::size_t kKept = 2 * kWindow;

    void slide(std::span<const float, kBands> loudness) noexcept;
    void learn() noexcept;
    [[nodiscard]] bool is_another() const noexcept;

    std::array<std::array<float, kBands>, kKept> ring_{};  // the last hops
    std::size_t next_ = 0;                                 // in it
    int hops_ = 0;                                         // heard, at most kKept
    Sums newest_{};                                        // over the last window
    Sums before_{};                                        // over the window before that
    // Of means over a window, since the last change.
    Sums mean_{};
    Sums variance_{};
    int learnt_ = 0;  // hops, at most as many as they remember
};

}  // namespace raks::audio
