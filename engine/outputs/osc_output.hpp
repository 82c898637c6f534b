#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// Beats, events and what changes in the music, as OSC over UDP (docs/reference/files.md):
/// `HOST:PORT[,preset=raks|plain|resolume][,prefix=/raks][,rate=HZ]` and options of the timing.
/// Errors: the target.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_osc(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_osc(const std::string& target);

}  // namespace raks::engine
