#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/features/onset.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// MusicState::spectrum of a stream: mel bands taken together, each against the loudest that it was
/// of late. Threads: one. Real-time: yes.
class SpectrumMeter {
 public:
    static constexpr std::size_t kMelBands = OnsetDetector::kMelBands;  ///< numbers a hop

    /// The next hop. `mel`: OnsetDetector::mel_magnitudes(). `level_dbfs`: of its samples.
    MusicSpectrum advance(float level_dbfs,
                          std::span<const float, kMelBands> mel) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept { *this = SpectrumMeter(); }

 private:
    static constexpr float kFloor = -60.0F;  // dB of a band: softer sounds never fill it

    static constexpr std::array<float, MusicSpectrum::kBands> floors() {
        std::array<float, MusicSpectrum::kBands> all{};
        for (float& one : all) {
            one = kFloor;
        }
        return all;
    }

    std::array<float, MusicSpectrum::kBands> loudest_ = floors();  // dB, of late
};

}  // namespace raks::audio
