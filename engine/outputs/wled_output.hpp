#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// Sound for the lights of WLED: packets of "Sound Sync" version 2 over UDP, 50 a second
/// (docs/reference/files.md): `HOST[:11988]`, or `multicast` for 239.0.0.1, and options of the
/// timing. Errors: the target.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_wled(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_wled(const std::string& target);

}  // namespace raks::engine
