// What the commands that run in real time share of their sound.
#pragma once

#include <string>

#include "engine/live/live_graph.hpp"
#include "engine/setup/settings.hpp"

namespace raks::apps {

/// What the settings say of a live graph's sound: buffer, offsets, pose lead. The offsets kept for
/// devices are read; where they cannot be, one line says why and none count.
[[nodiscard]] engine::LiveGraphConfig sound_config(const engine::Settings& settings);

/// The level meter of a terminal: "[#####     ] -18.2 dBFS".
[[nodiscard]] std::string level_meter(float dbfs);

}  // namespace raks::apps
