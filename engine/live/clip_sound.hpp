// Clip sound: a file on the loudspeaker, in step with a clip that is shown to it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "audio/io/device_stream.hpp"
#include "audio/io/stream_callback.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"
#include "engine/live/file_sound.hpp"

namespace raks::engine {

/// How a clip and its sound come together.
struct SoundStep {
    bool seeks = false;         ///< the sound goes to where the clip is
    double clip_seconds = 0.0;  ///< that the clip moves on by, or back
};
/// What brings a clip that stands at `clip` and a sound that is heard at `heard` together, both in
/// seconds of the file: of a small distance the clip goes a share with each picture, over a large
/// one the sound jumps. Pure.
[[nodiscard]] SoundStep sound_step(double clip, double heard) noexcept;

/// Plays the music of a clip on the default loudspeaker. Threads: on_output from the device, the
/// rest from one other. Real-time: no, but for on_output.
class ClipSound final : public audio::StreamCallback {
 public:
    /// Silent at first. May take 2 s. Errors: the file cannot be decoded; no loudspeaker.
    [[nodiscard]] static Expected<std::unique_ptr<ClipSound>> open(
        const std::filesystem::path& file);

    /// Called with each picture. `clip`: where the clip is, seconds. `sounds`: it moves forward at
    /// its own rate; else the sound rests. Returns seconds that the clip is to move on by, or back,
    /// to be where the sound is heard.
    [[nodiscard]] double follow(double clip, bool sounds);
    /// The loudspeaker is gone; nothing is heard any more.
    [[nodiscard]] bool is_lost() const noexcept { return is_lost_; }

    /// *audio* Real-time: yes.
    void on_output(std::span<float> interleaved,
                   int channels,
                   const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override;

 private:
    explicit ClipSound(std::unique_ptr<audio::FilePlayer> player) : sound_(std::move(player)) {}

    FileSound sound_;
    HostTime sought_{};  // last
    bool is_lost_ = false;
    std::unique_ptr<audio::DeviceStream> stream_;  // calls; goes first
};

}  // namespace raks::engine
