#pragma once

#include <memory>

#include "engine/outputs/osc_target.hpp"

namespace raks::engine {

/// The addresses of other programs: OscPreset::plain (sound-to-light-osc, BPM2OSC) and
/// OscPreset::resolume.
[[nodiscard]] std::unique_ptr<Output> open_foreign_osc(const OscTarget& target);

}  // namespace raks::engine
