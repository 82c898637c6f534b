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
    LoudnessMeter();
    ~LoudnessMeter();
    LoudnessMeter(LoudnessMeter&&) noexcept;
    LoudnessMeter& operator=(LoudnessMeter&&) noexcept;

    /// Errors: libebur128 refuses the rate.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    void add(std::span<const float> mono) noexcept RAKS_NONBLOCKING;
    /// LUFS of the last 400 ms, >= -120.
    [[nodiscard]] float momentary() noexcept RAKS_NONBLOCKING;
    /// Forgets what was heard: 400 ms of silence (libebur128 has no reset that does not allocate).
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace raks::audio
