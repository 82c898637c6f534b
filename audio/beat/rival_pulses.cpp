#include "audio/beat/rival_pulses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raks::audio {
namespace {

// Distance of a phase to a place in the beat, in hops.
double hops_from(double phase, double place, double period_hops) noexcept {
    const double apart = phase - place;
    return (apart - std::round(apart)) * period_hops;
}

float log_ratio(const EvidenceLikelihood& evidence, float on_beat, float on_part, float part) {
    return std::log(1.0F + (evidence.beat / evidence.other - 1.0F) * on_beat +
                    (part / evidence.other - 1.0F) * on_part);
}

}  // namespace

PulseFits fit_pulses(double position,
                     double period_hops,
                     const EvidenceLikelihood& evidence) noexcept RAKS_NONBLOCKING {
    PulseFits fits{};
    for (std::size_t i = 0; i < fits.size(); ++i) {
        const RivalPulse pulse = i == 0 ? RivalPulse() : kRivalPulses[i - 1];
        const double at = pulse.rate * position + pulse.offset;
        const double phase = at - std::floor(at);
        const double hops = period_hops / pulse.rate;
        const float on_beat = event_bump(hops_from(phase, 0.0, hops));
        const float on_half = event_bump(hops_from(phase, 0.5, hops));
        const float on_third = std::max(event_bump(hops_from(phase, 1.0 / 3.0, hops)),
                                        event_bump(hops_from(phase, 2.0 / 3.0, hops)));
        fits[i].in_two = log_ratio(evidence, on_beat, on_half, evidence.half);
        fits[i].in_three = log_ratio(evidence, on_beat, on_third, evidence.third);
    }
    return fits;
}

void PulseMargins::add(const PulseFits& fits, float keep) noexcept RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        sums_[i].in_two = keep * sums_[i].in_two + fits[i].in_two;
        sums_[i].in_three = keep * sums_[i].in_three + fits[i].in_three;
    }
}

float PulseMargins::margin(std::size_t rival) const noexcept {
    return sums_[0].best() - sums_[1 + rival].best();
}

float PulseMargins::over_none() const noexcept { return sums_[0].best(); }

}  // namespace raks::audio
