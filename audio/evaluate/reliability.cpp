#include "audio/evaluate/reliability.hpp"

#include <algorithm>

namespace raks::audio {

std::size_t reliability_bin(float confidence) noexcept {
    constexpr float kBins = kReliabilityBins;
    return static_cast<std::size_t>(std::clamp(kBins * confidence, 0.0F, kBins - 1.0F));
}

ReliabilityCurve reliability_of(std::span<const Claim> claims) {
    ReliabilityCurve curve(kReliabilityBins);
    for (const Claim& claim : claims) {
        ReliabilityBin& bin = curve[reliability_bin(claim.confidence)];
        ++bin.claims;
        bin.right += claim.is_right ? 1 : 0;
    }
    return curve;
}

}  // namespace raks::audio
