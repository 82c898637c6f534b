#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// When a block passed the device.
struct BlockTime {
    std::int64_t first_frame = 0;  ///< frames that this stream moved before this block
    HostTime entered{};            ///< CLOCK_MONOTONIC when the callback was entered
    bool is_xrun = false;          ///< the device lost or repeated audio before this block
};

/// What runs on the device's audio thread, with flush-to-zero set. Real-time: must be.
class StreamCallback {
 public:
    virtual ~StreamCallback() = default;
    /// A block from an input stream, interleaved; any number of frames from 1 up.
    virtual void on_input(std::span<const float> /*interleaved*/,
                          int /*channels*/,
                          const BlockTime& /*time*/) noexcept {}
    /// A block for an output stream, interleaved, to be filled whole (it comes zeroed).
    virtual void on_output(std::span<float> /*interleaved*/,
                           int /*channels*/,
                           const BlockTime& /*time*/) noexcept {}
};

struct StreamConfig {
    int channels = 2;              ///< wanted, 1..8; the device may have fewer: see channels()
    int rate_hz = 0;               ///< 0: the device's default; else the nearest that it takes
    double latency_seconds = 0.0;  ///< wanted; 0: the device's low default, 50 ms on PulseAudio
};

/// One running direction of one device. Any block size (PortAudio is left to choose), the
/// device's own rate, and a way out when the device dies.
///
/// A dead device (e.g. a killed JACK server): callbacks stop, and stopping or closing the stream
/// hangs for ever. So: ask is_alive() now and then; when false, call abandon() and drop the
/// object; the process can still exit, by end_process().
/// Threads: one control thread; callbacks(), is_alive() from any. Real-time: no.
class DeviceStream {
 public:
    /// Opens and starts: silence, until connect().
    /// Errors: the device cannot be opened so; one line names it and says what it can do.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_input(
        const AudioDevice& device, const StreamConfig& config);
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_output(
        const AudioDevice& device, const StreamConfig& config);
    /// Stops and closes; one that is dead, abandoned or does not stop within a second is leaked.
    /// Whichever it is, what it called is called no more.
    ~DeviceStream();
    DeviceStream(const DeviceStream&) = delete;
    DeviceStream& operator=(const DeviceStream&) = delete;

    /// From now on every block reaches `callback`, which must outlive the stream or abandon().
    void connect(StreamCallback& callback) noexcept;

    [[nodiscard]] SampleRate rate() const noexcept;
    [[nodiscard]] int channels() const noexcept;
    /// What PortAudio reports, clamped to 0..2 s (unset values were seen): a hint. On JACK it is
    /// what clicks through a loop of ports take, to 0.01 ms at periods of 64, 256 and 1024 frames
    /// (`raks bench latency`), so it is the default; the converters behind the server are unseen.
    [[nodiscard]] Nanos reported_latency() const noexcept;

    /// Callbacks so far.
    [[nodiscard]] std::uint64_t callbacks() const noexcept;
    /// Frames of the newest block; 0 before the first.
    [[nodiscard]] int block_frames() const noexcept;
    /// Scheduling class of the thread that calls back: "SCHED_FIFO", "SCHED_RR", "SCHED_OTHER";
    /// "unknown" before the first block and once the stream is dead.
    [[nodiscard]] std::string scheduling() const;
    /// Blocks flagged as xrun so far.
    [[nodiscard]] std::uint64_t xruns() const noexcept;
    /// False when no callback came for 1.5 s (JACK) or 3 s (others) before `now`, or PortAudio
    /// calls it inactive.
    [[nodiscard]] bool is_alive(HostTime now) const noexcept;
    /// Leaves the stream to itself for ever: it is never stopped, closed or freed, and PortAudio
    /// never terminated, in this process. What it called is called no more.
    void abandon() noexcept;

 private:
    struct Impl;
    explicit DeviceStream(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Ends the process with this code, once everything that is to be written is written. Where a
/// stream was left to itself its threads still run: then no destructor of a library may pull what
/// they use from under them.
[[noreturn]] void end_process(int exit_code) noexcept;

}  // namespace raks::audio
