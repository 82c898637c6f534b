#include "apps/raks/live_sound.hpp"

#include <cmath>
#include <utility>

#include "apps/terminal/say.hpp"
#include "engine/setup/device_offsets.hpp"
#include "render/overlay/text_format.hpp"

#include <fmt/format.h>

namespace raks::apps {

engine::LiveGraphConfig sound_config(const engine::Settings& settings) {
    engine::LiveGraphConfig config;
    config.buffer_seconds = settings.buffer_ms * 1e-3;
    config.latency_offset = nanos_from_seconds(settings.latency_offset_ms * 1e-3);
    config.pose_lead = nanos_from_seconds(settings.pose_lead_ms * 1e-3);
    if (auto offsets = engine::DeviceOffsets::load()) {
        config.offsets = std::move(*offsets);
    } else {
        complain(offsets.error().message + "; no device's offset is used");
    }
    return config;
}

// 20 characters from -60 to 0 dBFS.
std::string level_meter(float dbfs) {
    constexpr int kWidth = 20;
    const auto bars = static_cast<std::size_t>(std::lround(render::meter_fraction(dbfs) * kWidth));
    return fmt::format("[{:<{}}] {:6.1f} dBFS", std::string(bars, '#'), kWidth, dbfs);
}

}  // namespace raks::apps
