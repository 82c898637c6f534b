#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Whether what is said with some confidence is right as often as it says.
/// Every function is pure. Threads: any. Real-time: no.
namespace raks::audio {

/// What was said with some confidence, and whether it was right.
struct Claim {
    float confidence = 0.0F;  ///< [0, 1]
    bool is_right = false;
};

/// How often claims of about the same confidence are right. What knows what it knows has as many
/// right ones as it says.
struct ReliabilityBin {
    std::size_t claims = 0;
    std::size_t right = 0;
};
inline constexpr std::size_t kReliabilityBins = 10;  ///< of confidence 0 to .1, .1 to .2, ...
/// One bin after the other, kReliabilityBins of them.
using ReliabilityCurve = std::vector<ReliabilityBin>;

/// The bin of a confidence; 1 belongs to the last one.
[[nodiscard]] std::size_t reliability_bin(float confidence) noexcept;
/// Sorts claims into bins.
[[nodiscard]] ReliabilityCurve reliability_of(std::span<const Claim> claims);

}  // namespace raks::audio
