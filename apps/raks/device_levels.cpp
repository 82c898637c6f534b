#include "apps/raks/device_levels.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <span>
#include <thread>

#include "audio/io/device_stream.hpp"
#include "audio/io/stream_callback.hpp"

namespace raks::apps {
namespace {

constexpr auto kListening = std::chrono::milliseconds(330);
constexpr float kLowest = -120.0F;

// The mean square of all that came in.
class LevelMeter final : public audio::StreamCallback {
 public:
    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& /*time*/) noexcept RAKS_NONBLOCKING override {
        double sum = 0.0;
        for (const float sample : interleaved) {
            sum += static_cast<double>(sample) * static_cast<double>(sample);
        }
        // One thread writes.
        sum_.store(sum_.load(std::memory_order_relaxed) + sum / std::max(channels, 1),
                   std::memory_order_relaxed);
        frames_.store(frames_.load(std::memory_order_relaxed) +
                          static_cast<double>(interleaved.size()) / std::max(channels, 1),
                      std::memory_order_relaxed);
    }
    [[nodiscard]] float dbfs() const noexcept {
        const double frames = frames_.load(std::memory_order_relaxed);
        const double mean = frames > 0.0 ? sum_.load(std::memory_order_relaxed) / frames : 0.0;
        return mean > 0.0 ? std::max(kLowest, static_cast<float>(10.0 * std::log10(mean)))
                          : kLowest;
    }

 private:
    std::atomic<double> sum_{0.0};
    std::atomic<double> frames_{0.0};
};

// Closed before its meter.
struct Listening {
    LevelMeter meter;
    std::unique_ptr<audio::DeviceStream> stream;
};

std::unique_ptr<Listening> listen(const audio::AudioDevice& device) {
    if (device.input_channels == 0 || device.system == audio::AudioSystemKind::portaudio) {
        return nullptr;
    }
    auto stream = audio::DeviceStream::open_input(device, {.stays = true});
    if (!stream) {
        return nullptr;
    }
    auto listening = std::make_unique<Listening>();
    listening->stream = std::move(*stream);
    listening->stream->connect(listening->meter);
    return listening;
}

}  // namespace

std::vector<std::optional<float>> device_levels(const std::vector<audio::AudioDevice>& devices) {
    std::vector<std::unique_ptr<Listening>> all;
    std::transform(devices.begin(), devices.end(), std::back_inserter(all), listen);
    std::this_thread::sleep_for(kListening);
    std::vector<std::optional<float>> levels;
    std::transform(all.begin(), all.end(), std::back_inserter(levels), [](const auto& one) {
        return one ? std::optional(one->meter.dbfs()) : std::nullopt;
    });
    return levels;
}

}  // namespace raks::apps
