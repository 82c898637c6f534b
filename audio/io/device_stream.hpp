#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "audio/io/devices.hpp"
#include "audio/io/stream_callback.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "base/thread_priority.hpp"
#include "base/time.hpp"

namespace raks::audio {

class CountedBlocks;  // audio/io/counted_blocks.hpp

/// Wishes for a stream; the device decides, see rate() and channels().
struct StreamConfig {
    int channels = 2;              ///< wanted, 1..8; the device may have fewer
    int rate_hz = 0;               ///< wanted; 0, and where it is refused: the device's default
    double latency_seconds = 0.0;  ///< wanted; 0: the device's own
    /// The buffer of a PulseAudio output may grow when it runs dry.
    bool may_grow = true;
    /// The person named the device: the server must not move the stream to another one.
    bool stays = false;
};

/// Something that happened to a device or its server.
struct DeviceEvent {
    /// What happened.
    enum class Kind {
        devices_changed,  ///< other devices, or another default, than before
        moved,            ///< the server plays this stream on `id` now
        buffer_grown,     ///< after running dry; `milliseconds` long now
        source_gone,      ///< the JACK client that the stream was connected to has left
        source_back,      ///< it is there again, and connected
    };
    Kind kind = Kind::devices_changed;  ///< what happened
    std::string id = {};                ///< of the device (AudioDevice::id)
    int milliseconds = 0;               ///< of the buffer
};

/// One running direction of one device, with any block size and at the device's own rate. It
/// survives the device's death: poll is_alive(); when it is false, abandon() and destroy the
/// object, on a thread that may wait for a second.
///
/// There are three kinds behind it: JACK's own clients, PulseAudio's streams (PipeWire serves both)
/// and PortAudio for ALSA, OSS and what else it knows. The first two can be opened again in the
/// same process once their server is back. PortAudio may not return from closing a dead stream: it
/// is leaked then, and the process must leave by end_process().
/// Threads: one control thread; callbacks(), is_alive() from any. Real-time: no.
class DeviceStream {
 public:
    /// Which way the samples go.
    enum class Direction { input, output };

    /// Opens and starts; blocks are dropped (an output is silent) until connect(). Takes at most
    /// 2 s with JACK and PulseAudio.
    /// Errors: the device cannot be opened in this way; the server does not answer. One line.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open(Direction direction,
                                                                      const AudioDevice& device,
                                                                      const StreamConfig& config);
    /// open() for recording.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_input(
        const AudioDevice& device, const StreamConfig& config);
    /// open() for playing.
    [[nodiscard]] static Expected<std::unique_ptr<DeviceStream>> open_output(
        const AudioDevice& device, const StreamConfig& config);
    /// Stops and closes. A stream that does not stop within a second is leaked instead. In either
    /// case its callback is not called any more.
    virtual ~DeviceStream();
    /// Not copyable: the device's thread holds its address.
    DeviceStream(const DeviceStream&) = delete;
    /// As above.
    DeviceStream& operator=(const DeviceStream&) = delete;

    /// From here on every block reaches `callback`, which must live until disconnect(), or until
    /// the stream is destroyed or abandoned.
    void connect(StreamCallback& callback) noexcept;
    /// From its return on the callback is not called; waits for a call that is on its way.
    void disconnect() noexcept;

    /// The rate that the device runs at.
    [[nodiscard]] SampleRate rate() const noexcept { return rate_; }
    /// Channels of each block.
    [[nodiscard]] int channels() const noexcept;
    /// Time from BlockTime::entered until the block's sound is heard, as the device reports it now;
    /// -2 to 2 s, smoothed. It dates an output's first sample, and the end of an input's last one.
    /// A microphone's sound was heard before it came in: negative. A monitor records what its
    /// loudspeaker may not have played yet: positive. JACK counts what its ports are
    /// connected to; PulseAudio the whole way to the converter. Threads: any. Real-time: yes.
    [[nodiscard]] virtual Nanos heard_after() const noexcept RAKS_NONBLOCKING = 0;

    /// The part of heard_after() that comes behind the sound server: others who record there have
    /// the sound already, and it is not heard yet. 0 to 2 s; 0 where there is no server. Threads:
    /// any. Real-time: yes.
    [[nodiscard]] virtual Nanos behind_server() const noexcept RAKS_NONBLOCKING { return Nanos(0); }

    /// Number of callbacks since the start.
    [[nodiscard]] std::uint64_t callbacks() const noexcept;
    /// Frames of the newest block; 0 before the first.
    [[nodiscard]] int block_frames() const noexcept;
    /// Scheduling class of the thread that calls back: "SCHED_FIFO", "SCHED_RR", "SCHED_OTHER";
    /// "unknown" before the first block and once the stream is dead.
    [[nodiscard]] std::string scheduling() const;
    /// The real-time priority of the thread that calls back, where a server gave it one and Raks'
    /// other threads must stay below it (JACK): 0 for an ordinary one; kAnyPriority where Raks
    /// chooses it itself.
    [[nodiscard]] virtual int callback_priority() const { return kAnyPriority; }
    /// Number of blocks that the device lost since the start, as far as it tells.
    [[nodiscard]] std::uint64_t xruns() const noexcept;
    /// False when the server is gone or has closed the stream; with PortAudio when no callback came
    /// for 1.5 s (JACK) or 3 s (others) before `now`, or none within 2 s of the start.
    [[nodiscard]] virtual bool is_alive(HostTime now) const noexcept = 0;
    /// Gives a dead stream up: its callback is not called any more.
    virtual void abandon() noexcept { disconnect(); }
    /// The next thing that happened, oldest first; nothing when there is no more.
    [[nodiscard]] virtual std::optional<DeviceEvent> poll() { return std::nullopt; }
    /// The name that the server knows this stream's ports by; empty where there are none.
    [[nodiscard]] virtual std::string client_name() const { return {}; }

 protected:
    /// `blocks`: where the derived class takes them to; shared, as a thread that cannot be
    /// stopped may use it longer than the stream lives.
    DeviceStream(std::shared_ptr<CountedBlocks> blocks, SampleRate rate);
    /// The blocks, for the derived class.
    [[nodiscard]] CountedBlocks& blocks() const noexcept { return *blocks_; }

 private:
    std::shared_ptr<CountedBlocks> blocks_;
    SampleRate rate_;
};

/// Ends the process with this code; call it when all output is written. After a PortAudio stream
/// was abandoned its threads still run, so then it skips the destructors of libraries, which would
/// free what these threads use.
[[noreturn]] void end_process(int exit_code) noexcept;

}  // namespace raks::audio
