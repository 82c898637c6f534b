#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "audio/io/devices.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// When a block passed the device, and where in the stream it lies.
struct BlockTime {
    std::int64_t first_frame = 0;  ///< frames of this stream before the block
    HostTime entered{};            ///< CLOCK_MONOTONIC when the callback was entered
    bool is_xrun = false;          ///< the device lost or repeated audio before this block
};

/// Code that runs on the device's audio thread, with flush-to-zero set.
/// Real-time: must be (no allocation, locks or system calls).
class StreamCallback {
 public:
    /// Destroyed by its owner, after the stream or abandon(): see connect().
    virtual ~StreamCallback() = default;
    /// A block from an input stream, interleaved; any number of frames from 1 up.
    virtual void on_input(std::span<const float> /*interleaved*/,
                          int /*channels*/,
                          const BlockTime& /*time*/) noexcept {}
    /// A block for an output stream, interleaved, to be filled completely (it is zeroed before).
    virtual void on_output(std::span<float> /*interleaved*/,
                           int /*channels*/,
                           const BlockTime& /*time*/) noexcept {}
};

/// Wishes for a stream; the device decides, see rate() and channels().
struct StreamConfig {
    int channels = 2;              ///< wanted, 1..8; the device may have fewer
    int rate_hz = 0;               ///< wanted; 0, and where it is refused: the device's default
    double latency_seconds = 0.0;  ///< wanted; 0: the device's low default, 50 ms on PulseAudio
};

/// One running direction of one device, with any block size (PortAudio chooses it) and at the
/// device's own rate. It survives the device's death.
///
/// When a device is dead (e.g. a killed JACK server), callbacks stop, and stopping or closing its
/// stream never returns. Therefore: poll is_alive(); when it is false, call abandon() and destroy
/// the object. The process can still exit, by end_process().
/// Threads: one control thread; callbacks(), is_alive() from any. Real-time: no.
class DeviceStream {
 public:
    /// Opens and starts recording; blocks are dropped until connect().
    /// Errors: the device cannot be opened in this way; one line names it and says what it offers.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_input(
        const AudioDevice& device, const StreamConfig& config);
    /// Opens and starts playing; silence until connect(). Errors: as open_input.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_output(
        const AudioDevice& device, const StreamConfig& config);
    /// Stops and closes. A stream that is dead, abandoned or does not stop within a second is
    /// leaked instead. In either case its callback is not called any more.
    ~DeviceStream();
    /// Not copyable: the device's thread holds its address.
    DeviceStream(const DeviceStream&) = delete;
    /// As above.
    DeviceStream& operator=(const DeviceStream&) = delete;

    /// From here on every block reaches `callback`, which must live until the stream is destroyed
    /// or abandoned.
    void connect(StreamCallback& callback) noexcept;

    /// The rate that the device runs at.
    [[nodiscard]] SampleRate rate() const noexcept;
    /// Channels of each block.
    [[nodiscard]] int channels() const noexcept;
    /// Latency as PortAudio reports it, clamped to 0..2 s as it may be unset: a hint. On JACK it
    /// agrees with the measured delay of clicks through a loop of ports to 0.01 ms at periods of
    /// 64, 256 and 1024 frames (`raks bench latency`), so it is the default; the converters behind
    /// the server are not included.
    [[nodiscard]] Nanos reported_latency() const noexcept;

    /// Number of callbacks since the start.
    [[nodiscard]] std::uint64_t callbacks() const noexcept;
    /// Frames of the newest block; 0 before the first.
    [[nodiscard]] int block_frames() const noexcept;
    /// Scheduling class of the thread that calls back: "SCHED_FIFO", "SCHED_RR", "SCHED_OTHER";
    /// "unknown" before the first block and once the stream is dead.
    [[nodiscard]] std::string scheduling() const;
    /// Number of blocks flagged as xrun since the start.
    [[nodiscard]] std::uint64_t xruns() const noexcept;
    /// False when no callback came for 1.5 s (JACK) or 3 s (others) before `now`, none within 2 s
    /// of the start, or when PortAudio reports the stream as inactive.
    [[nodiscard]] bool is_alive(HostTime now) const noexcept;
    /// Gives a dead stream up: it is never stopped, closed or freed, and PortAudio is never
    /// terminated in this process. Its callback is not called any more.
    void abandon() noexcept;

 private:
    struct Impl;
    explicit DeviceStream(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Ends the process with this code; call it when all output is written. After a stream was
/// abandoned its threads still run, so then it skips the destructors of libraries, which would free
/// what these threads use.
[[noreturn]] void end_process(int exit_code) noexcept;

}  // namespace raks::audio
