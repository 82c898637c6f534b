// File sound: the samples of a file on their way into the blocks of a device.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/io/file_player.hpp"
#include "audio/resample/resampler.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Seconds of a loudspeaker's buffer where nobody wishes another: the latency of what is played
/// does not matter, as the pictures wait for it; holes do.
inline constexpr double kPlayBuffer = 0.040;

/// Pulls a decoded file and fills a device's blocks with it, resampled to the device's rate; with
/// volume, pause, seek and an end.
///
/// Stream time counts the file's samples as they are given out; a seek does not turn it back.
/// Threads: what is marked *audio* from the callback, the rest from main.
class FileSound {
 public:
    /// Frames that are pulled at a time, at most.
    static constexpr std::size_t kPullFrames = 256;

    /// Who hears the file's own samples before they are resampled.
    class Ear {
     public:
        virtual ~Ear() = default;  ///< owned elsewhere
        /// *audio* What was pulled, stereo, but for what is beyond the end. Real-time: yes.
        virtual void on_pulled(const audio::PulledAudio& pulled,
                               std::span<const float> stereo) noexcept RAKS_NONBLOCKING = 0;
    };
    /// What a block was filled with.
    struct Filled {
        StreamTime first{};      ///< of its first frame
        bool has_sound = false;  ///< of the file; else it is silent
        bool is_still = false;   ///< in a pause, or held back: nothing was pulled
    };

    /// `player` plays one file.
    explicit FileSound(std::unique_ptr<audio::FilePlayer> player);

    /// Sets the rate of what will call; before the first callback, and again when the device
    /// changes while no callback runs. `until`: stream time that was given out so far. Errors: the
    /// resampler refuses the rate.
    [[nodiscard]] Expected<void> prepare(SampleRate device_rate, StreamTime until);
    /// What comes next fades in. While no callback runs.
    void fade_in() noexcept { gain_ = 0.0F; }
    /// Stream time of the next frame. While no callback runs.
    [[nodiscard]] StreamTime given_until() const noexcept {
        return device_rate_.time_of(frames_out_);
    }

    /// *audio* Fills one block, completely. `ear`: may be null. Real-time: yes (no allocation).
    Filled fill(std::span<float> interleaved, int channels, Ear* ear) noexcept RAKS_NONBLOCKING;

    /// The decoder, for its messages and counters.
    [[nodiscard]] audio::FilePlayer& player() noexcept { return *player_; }
    /// Of the file.
    [[nodiscard]] SampleRate file_rate() const noexcept { return file_rate_; }

    void set_volume(float volume) noexcept;  ///< [0, 2], clamped; the gain follows smoothly
    /// Fades out and stops, or goes on; stream time stands still in a pause.
    void set_paused(bool is_paused) noexcept;
    /// Holds the first sample back, in silence, until it is let go. Before the first callback.
    void hold_back() noexcept { is_held_back_.store(true, std::memory_order_relaxed); }
    /// Lets what is held back sound.
    void let_go() noexcept { is_held_back_.store(false, std::memory_order_relaxed); }
    /// What set_paused() was told last.
    [[nodiscard]] bool is_paused() const noexcept;
    /// Where the file plays, in seconds: a moment ahead of the loudspeaker. After a seek it is the
    /// new place at once, also in a pause.
    [[nodiscard]] double position_seconds() const noexcept;
    /// Goes to another place of the file (clamped to >= 0); behind its end, playing is finished. In
    /// a pipe it does nothing.
    void seek(double seconds);
    /// True when all of the file has been given to the device, until a seek goes back. Threads:
    /// any.
    [[nodiscard]] bool is_finished() const noexcept;
    /// Plays no further than this place (seconds in the file), to the sample.
    void set_end(double seconds) noexcept;

 private:
    std::size_t pull(std::span<float> stereo, Ear* ear) noexcept;
    std::size_t refill(Ear* ear) noexcept;

    std::unique_ptr<audio::FilePlayer> player_;
    SampleRate file_rate_;
    SampleRate device_rate_;
    audio::Resampler resampler_;

    // Owned by the audio thread.
    std::vector<float> pulled_;    // stereo at the file's rate
    std::size_t pending_at_ = 0;   // frames of pulled_ that the resampler has taken
    std::size_t pending_ = 0;      // and those that it has not
    std::vector<float> stereo_;    // stereo at the device's rate
    std::int64_t frames_out_ = 0;  // at the device's rate, of the file's sound
    float gain_ = 1.0F;            // follows volume_ smoothly
    bool is_source_ended_ = false;

    std::atomic<float> volume_{1.0F};
    std::atomic<bool> is_paused_{false};
    std::atomic<bool> is_held_back_{false};  // relaxed: as a pause, it orders nothing
    std::atomic<bool> is_finished_{false};
    std::atomic<double> position_seconds_{0.0};
    std::atomic<double> end_seconds_{1e18};
};

}  // namespace raks::engine
