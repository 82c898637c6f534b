#include "audio/io/device_stream.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "audio/io/counted_blocks.hpp"
#include "audio/io/jack_stream.hpp"
#include "audio/io/portaudio_session.hpp"
#include "audio/io/portaudio_stream.hpp"
#include "audio/io/pulse_stream.hpp"

#include <fmt/format.h>

namespace raks::audio {

DeviceStream::DeviceStream(std::shared_ptr<CountedBlocks> blocks, SampleRate rate)
    : blocks_(std::move(blocks)), rate_(rate) {}

DeviceStream::~DeviceStream() = default;

namespace {

Expected<std::unique_ptr<DeviceStream>> open_by_kind(DeviceStream::Direction direction,
                                                     const AudioDevice& device,
                                                     const StreamConfig& config) {
    switch (device.system) {
        case AudioSystemKind::jack:
            return open_jack_stream(direction, device, config);
        case AudioSystemKind::pulse:
            return open_pulse_stream(direction, device, config);
        default:
            return open_portaudio_stream(direction, device, config);
    }
}

}  // namespace

Expected<std::unique_ptr<DeviceStream>> DeviceStream::open(Direction direction,
                                                           const AudioDevice& device,
                                                           const StreamConfig& config) {
    const bool is_input = direction == Direction::input;
    const bool has_channels = (is_input ? device.input_channels : device.output_channels) > 0;
    auto stream = has_channels ? open_by_kind(direction, device, config)
                               : fail("it has no channels of this kind");
    if (!stream) {
        return fail(fmt::format("device {} cannot be opened as {}: {}",
                                described(device),
                                is_input ? "input" : "output",
                                stream.error().message));
    }
    return stream;
}

Expected<std::unique_ptr<DeviceStream>> DeviceStream::open_input(const AudioDevice& device,
                                                                 const StreamConfig& config) {
    return open(Direction::input, device, config);
}

Expected<std::unique_ptr<DeviceStream>> DeviceStream::open_output(const AudioDevice& device,
                                                                  const StreamConfig& config) {
    return open(Direction::output, device, config);
}

void DeviceStream::connect(StreamCallback& callback) noexcept { blocks_->gate().open(callback); }
void DeviceStream::disconnect() noexcept { blocks_->gate().close(); }
int DeviceStream::channels() const noexcept { return blocks_->channels(); }
std::uint64_t DeviceStream::callbacks() const noexcept { return blocks_->callbacks(); }
int DeviceStream::block_frames() const noexcept { return blocks_->block_frames(); }
std::uint64_t DeviceStream::xruns() const noexcept { return blocks_->xruns(); }

std::string DeviceStream::scheduling() const {
    const auto now = std::chrono::time_point_cast<Nanos>(HostClock::now());
    return is_alive(now) ? blocks_->scheduling() : "unknown";
}

// Without leaked streams an ordinary exit runs all destructors; with them only open files are
// flushed.
void end_process(int exit_code) noexcept {
    if (is_portaudio_leaked()) {
        std::fflush(nullptr);
        std::_Exit(exit_code);
    }
    std::exit(exit_code);  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace raks::audio
