#pragma once

#include <memory>

#include "audio/io/device_stream.hpp"
#include "audio/io/devices.hpp"
#include "base/expected.hpp"
#include "engine/trials/block_clock.hpp"
#include "engine/trials/click_train.hpp"

namespace raks::engine {

/// Plays a train of clicks on a device and tells when each should have been heard, as the device
/// reports it. Threads: main, but its callback.
class ClickPlayer {
 public:
    /// Opens the device and begins to play. Errors: it cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<ClickPlayer>> start(
        const audio::AudioDevice& output, const ClickTrain& train);
    ~ClickPlayer();  ///< closes the device
    /// Not copied: the stream calls into it.
    ClickPlayer(const ClickPlayer&) = delete;
    ClickPlayer& operator=(const ClickPlayer&) = delete;  ///< likewise

    /// Share of the train that was handed over so far, [0, 1].
    [[nodiscard]] double progress() const noexcept;
    /// False once the device is gone.
    [[nodiscard]] bool is_alive() const noexcept { return stream_->is_alive(HostClock::now()); }
    /// When the frames so far should have been heard. Errors: nothing was played.
    [[nodiscard]] Expected<BlockClock> clock() const;

 private:
    class Tape;
    ClickPlayer();

    std::unique_ptr<Tape> tape_;  // before the stream, which calls it
    std::unique_ptr<audio::DeviceStream> stream_;
};

}  // namespace raks::engine
