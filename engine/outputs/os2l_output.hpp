#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// Beats, and buttons for what the music does, to a light program by OS2L over TCP
/// (docs/reference/files.md): `HOST[:9996]` and options of the timing. Errors: the target.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_os2l(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_os2l(const std::string& target);

}  // namespace raks::engine
