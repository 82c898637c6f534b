#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"
#include "engine/outputs/output.hpp"

namespace raks::engine {

/// Beats and events as lines of JSON for scripts and status bars (docs/reference/files.md),
/// each written when it is heard. `target`: a new file, a pipe with a name, or `-` for standard
/// output; options of its timing may follow. A reader that stops reading loses lines, nothing else.
/// Errors: a plain file that is there already; one that cannot be opened.
[[nodiscard]] Expected<std::unique_ptr<Output>> open_lines(const std::string& target);
/// See OutputKind::check.
[[nodiscard]] Expected<void> check_lines(const std::string& target);

}  // namespace raks::engine
