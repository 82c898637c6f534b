#pragma once

#include <array>
#include <cstddef>

#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Tells when music stops, goes on and is over, by the level alone. A stop is a pause longer than
/// the song has made a habit of: in music that has none it is known 80 ms after the sound was cut,
/// after a quarter of a second where it was damped and hiss or a room goes on, and where it faded,
/// when nearly a beat has passed 30 dB under the loudest; in staccato music, whose gaps between
/// notes it has learnt, later. Threads: one. Real-time: yes.
class PauseDetector {
 public:
    /// The next hop: its level in dBFS, and how many hops a beat has. Returns what happened: stop,
    /// entry, end or none; the event's time is that of the first hop that was quiet, or sounded.
    MusicEvent advance(HopIndex hop, float level, int beat) noexcept RAKS_NONBLOCKING;
    /// A stop is known to come: within the next second 20 ms of quiet are one.
    void announce() noexcept RAKS_NONBLOCKING { announced_hops_ = kAnnouncedFor; }
    /// Whether nothing sounds; also before the first sound.
    [[nodiscard]] bool is_stopped() const noexcept { return is_stopped_; }
    /// Whether this hop is quiet: a stop, or a gap that may become one.
    [[nodiscard]] bool is_quiet() const noexcept { return is_stopped_ || quiet_hops_ > 0; }
    /// Forgets the stream.
    void reset() noexcept { *this = PauseDetector(); }

 private:
    static constexpr std::size_t kGaps = 16;
    static constexpr int kAnnouncedFor = 100;  // hops

    // A pause within the music.
    struct Gap {
        HopIndex ended = 0;
        int hops = 0;
    };

    void follow_level(float level) noexcept;
    MusicEvent listen(HopIndex hop, float level, int beat) noexcept;
    MusicEvent wait(HopIndex hop, float level) noexcept;
    void remember(HopIndex hop) noexcept;
    [[nodiscard]] int hops_to_stop(HopIndex hop, int beat) const noexcept;
    [[nodiscard]] float quiet_level() const noexcept;
    [[nodiscard]] bool is_below(float level) noexcept;

    float loud_ = -200.0F;     // dBFS, falls slowly; -200: nothing was heard
    float resting_ = -120.0F;  // dBFS, smoothed, of the present stop
    bool is_stopped_ = true;
    bool has_ended_ = true;    // the present stop was told as the end, or there was no music yet
    int quiet_hops_ = 0;       // in a row
    bool is_cut_ = false;      // the present quiet began within 30 ms
    float deepest_ = 0.0F;     // dBFS, of the present quiet
    bool is_damped_ = false;   // it began within 100 ms
    float playing_ = -120.0F;  // dBFS, of the sound, smoothed
    std::array<float, 10> before_{};  // levels of the last hops that sounded, the newest last
    int loud_hops_ = 0;               // in a row, of a stop
    int heard_hops_ = 0;              // that sounded since the last long stop; saturates
    int announced_hops_ = 0;          // for which a stop is known to come
    std::array<Gap, kGaps> gaps_{};   // ring
    std::size_t gap_count_ = 0;
};

}  // namespace raks::audio
