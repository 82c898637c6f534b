#include "audio/beat/network/rival_list.hpp"

#include <cmath>

namespace raks::audio {

RivalPulse pulse_at(std::size_t number) noexcept {
    return number == 0 ? RivalPulse() : kRivalPulses[number - 1];
}

std::size_t place_at(std::size_t pulse, long beat) noexcept {
    const RivalPulse seen = pulse_at(pulse);
    const double offset = seen.rate * static_cast<double>(beat) + seen.offset;
    for (std::size_t number = 0; number <= kRivalPulses.size(); ++number) {
        const RivalPulse other = pulse_at(number);
        const double apart = offset - other.offset;
        const bool is_there = std::abs(apart - std::round(apart)) < 1e-6;
        if (is_there && std::abs(other.rate - seen.rate) < 1e-9) {
            return number;
        }
    }
    return pulse;
}

}  // namespace raks::audio
