// Size by tempo: how large a figure is danced at another tempo.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/beats.hpp"

namespace raks::motion {

/// How a figure gets smaller as the music gets faster: at another tempo its movements are scaled by
/// (learnt / tempo)^exponent. 0: the learnt size at any tempo, as for figures captured at one
/// tempo; 1: hands and feet keep their speed.
struct SizeByTempo {
    double body = 0.0;  ///< steps, hips, trunk and head; exponent, [0, 2]
    double arms = 0.0;  ///< the same for arms; 0 where hands have to meet
};

/// The factor at a tempo, limited to [0.6, 1.15]. Threads: any. Real-time: yes.
[[nodiscard]] inline double size_at(double exponent, Bpm learnt, Bpm tempo) noexcept {
    constexpr double kSmallest = 0.6;
    constexpr double kLargest = 1.15;
    return std::clamp(std::pow(learnt.bpm() / tempo.bpm(), exponent), kSmallest, kLargest);
}

}  // namespace raks::motion
