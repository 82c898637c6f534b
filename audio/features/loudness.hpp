#pragma once

#include <memory>
#include <span>

#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Momentary loudness (400 ms, EBU R 128) of a mono stream by libebur128.
/// Threads: one. Real-time: add, momentary and reset yes, prepare no.
class LoudnessMeter {
 public:
    /// Call prepare() before anything else.
    LoudnessMeter();
    /// Frees libebur128's state.
    ~LoudnessMeter();
    /// Movable, not copyable.
    LoudnessMeter(LoudnessMeter&&) noexcept;
    /// As above.
    LoudnessMeter& operator=(LoudnessMeter&&) noexcept;

    /// Sets up the meter for this rate and forgets what was added. Errors: libebur128 refuses the
    /// rate.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// Adds samples in [-1, 1].
    void add(std::span<const float> mono) noexcept RAKS_NONBLOCKING;
    /// LUFS of the last 400 ms, >= -120.
    [[nodiscard]] float momentary() noexcept RAKS_NONBLOCKING;
    /// Forgets what was added, by adding 500 ms of silence: libebur128 has no reset that does not
    /// allocate.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
