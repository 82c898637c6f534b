// Phrases: where in a phrase of eight bars the music is.
#pragma once

#include <cstdint>

#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::motion {

/// Counts the music's bars in phrases of eight. A phrase begins where counting does, and anew where
/// the music enters or everything comes in. Threads: one. Real-time: yes.
class Phrases {
 public:
    static constexpr int kBars = 8;  ///< of one phrase

    /// The first phrase begins at the bar line nearest to this moment.
    void begin(const BeatGrid& grid, StreamTime time) noexcept RAKS_NONBLOCKING;
    /// One hop.
    void advance(const MusicState& music) noexcept RAKS_NONBLOCKING;

    /// Bars since the phrase began, [0, kBars).
    [[nodiscard]] double bar() const noexcept { return bar_; }
    /// Phrases begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

 private:
    Beats origin_{};  // of the first phrase
    double bar_ = 0.0;
    std::uint64_t number_ = 0;
};

}  // namespace raks::motion
