#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "audio/form/accent_detector.hpp"
#include "audio/form/energy_meter.hpp"
#include "audio/form/hop_sound.hpp"
#include "audio/form/pause_detector.hpp"
#include "audio/form/section_tracker.hpp"
#include "audio/form/spectrum_meter.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the music of a stream is doing: spectrum, energy, part, event and accent of each
/// MusicState, from the past alone. Nothing depends on how loud the whole input is, down to -58
/// dBFS. Threads: one. Real-time: yes; about 3 us a hop.
class FormTracker {
 public:
    /// One hop; sets the five fields. `state`: its hop, level and grid are read. `mel`:
    /// OnsetDetector::mel_magnitudes() of the hop.
    void advance(std::span<const float, HopListener::kMelBands> mel,
                 MusicState& state) noexcept RAKS_NONBLOCKING;
    /// One hop inside a gap of the audio: energy and part stay.
    void advance_lost(MusicState& state) const noexcept RAKS_NONBLOCKING;
    /// See MusicAnalyzer::announce_pause().
    void announce_pause() noexcept RAKS_NONBLOCKING { pauses_.announce(); }
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;
    /// What was heard of the newest hop.
    [[nodiscard]] const HopSound& sound() const noexcept { return sound_; }

 private:
    static constexpr std::size_t kWaiting = 4;

    void queue(const MusicEvent& event) noexcept;
    void set_part(MusicState& state) const noexcept;

    HopListener listener_;
    PauseDetector pauses_;
    EnergyMeter energy_meter_;
    SpectrumMeter spectrum_meter_;
    SectionTracker sections_;
    AccentDetector accents_;
    HopSound sound_;
    MusicEnergy energy_{0.0F, 0.5F, 0.5F};
    std::array<MusicEvent, kWaiting> events_{};  // one is told at a hop
    std::size_t event_count_ = 0;
};

}  // namespace raks::audio
