#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "audio/form/hop_sound.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// The rhythm section and the whole band over a stretch of music.
struct StretchSound {
    float low = 0.0F;         ///< dB, of the mean power of the low band
    float level = 0.0F;       ///< dBFS, of the mean power of all
    float top = 0.0F;         ///< dB, of the mean power above 6 kHz
    float low_onsets = 0.0F;  ///< mean novelty of the low band
    float onsets = 0.0F;      ///< mean novelty of all bands
    float brightness = 0.0F;  ///< dB, mean
};

/// Sums over all hops up to one, from which any stretch follows.
struct SoundSums {
    std::array<double, 6> sums{};  ///< by the fields of StretchSound, levels as powers

    /// The sums with one hop more.
    [[nodiscard]] SoundSums plus(const HopSound& sound) const noexcept {
        const auto power = [](float decibels) {
            return std::pow(10.0, 0.1 * static_cast<double>(decibels));
        };
        return {{sums[0] + power(sound.bands[0]),
                 sums[1] + power(sound.level),
                 sums[2] + power(sound.top),
                 sums[3] + static_cast<double>(sound.novelty[0]),
                 sums[4] + static_cast<double>(sound.total_novelty()),
                 sums[5] + static_cast<double>(sound.brightness())}};
    }
    /// Means of the `count` hops from `before` on; there must be one.
    [[nodiscard]] StretchSound since(const SoundSums& before, std::size_t count) const noexcept {
        const auto mean = [&](std::size_t i) {
            return (sums[i] - before.sums[i]) / static_cast<double>(count);
        };
        const auto decibels = [](double power) {
            return static_cast<float>(10.0 * std::log10(std::max(power, 1e-12)));
        };
        return {decibels(mean(0)),
                decibels(mean(1)),
                decibels(mean(2)),
                static_cast<float>(mean(3)),
                static_cast<float>(mean(4)),
                static_cast<float>(mean(5))};
    }
};

/// Means over any stretch of the last ten seconds of music. Threads: one. Real-time: yes.
class HopSums {
 public:
    static constexpr std::size_t kKept = 1024;  ///< hops

    /// The next hop.
    void add(const HopSound& sound) noexcept RAKS_NONBLOCKING {
        const SoundSums next = sums_[count_ % kKept].plus(sound);
        ++count_;
        sums_[count_ % kKept] = next;
    }
    /// Means from `from` hops ago up to `to` hops ago: mean(100, 0) is the last second. `from` >
    /// `to` and <= size().
    [[nodiscard]] StretchSound mean(std::size_t from, std::size_t to) const noexcept {
        return sums_[(count_ - to) % kKept].since(sums_[(count_ - from) % kKept], from - to);
    }
    /// Hops that mean() may reach back.
    [[nodiscard]] std::size_t size() const noexcept { return std::min(count_, kKept - 1); }

 private:
    std::array<SoundSums, kKept> sums_{};  // ring: of all hops before
    std::size_t count_ = 0;
};

}  // namespace raks::audio
