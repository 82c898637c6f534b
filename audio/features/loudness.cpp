#include "audio/features/loudness.hpp"

#include <ebur128.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace raks::audio {
namespace {
constexpr float kLowestLufs = -120.0F;  // what silence, -inf LUFS, is reported as
}

// libebur128's handle, freed with the object; the rate is kept for reset().
struct LoudnessMeter::State {
    ebur128_state* meter = nullptr;
    int rate = 0;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (meter != nullptr) {
            ebur128_destroy(&meter);
        }
    }
};

LoudnessMeter::LoudnessMeter() : state_(std::make_unique<State>()) {}
LoudnessMeter::~LoudnessMeter() = default;
LoudnessMeter::LoudnessMeter(LoudnessMeter&&) noexcept = default;
LoudnessMeter& LoudnessMeter::operator=(LoudnessMeter&&) noexcept = default;

Expected<void> LoudnessMeter::prepare(SampleRate rate) {
    state_ = std::make_unique<State>();
    state_->rate = rate.hertz();
    // Mode M alone keeps a window of 400 ms and does not allocate while it runs.
    state_->meter = ebur128_init(1, static_cast<unsigned long>(rate.hertz()), EBUR128_MODE_M);
    if (state_->meter == nullptr) {
        return fail("loudness: libebur128 refuses " + std::to_string(rate.hertz()) + " Hz");
    }
    return {};
}

void LoudnessMeter::add(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    // libebur128 filters into a ring that it has; it keeps no blocks in the mode of momentary
    // loudness.
    RAKS_TRUSTED(ebur128_add_frames_float(state_->meter, mono.data(), mono.size()));
}

float LoudnessMeter::momentary() noexcept RAKS_NONBLOCKING {
    double lufs = 0.0;
    // Digital silence is -inf LUFS, which is not finite.
    // A sum over that ring.
    const int result = RAKS_TRUSTED(ebur128_loudness_momentary(state_->meter, &lufs));
    if (result != EBUR128_SUCCESS || !std::isfinite(lufs)) {
        return kLowestLufs;
    }
    return std::max(kLowestLufs, static_cast<float>(lufs));
}

void LoudnessMeter::reset() noexcept RAKS_NONBLOCKING {
    const std::array<float, 256> silence{};
    // Half a second: longer than the window of 400 ms.
    for (int left = state_->rate / 2; left > 0; left -= static_cast<int>(silence.size())) {
        add(silence);
    }
}

}  // namespace raks::audio
