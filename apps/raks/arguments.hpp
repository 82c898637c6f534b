#pragma once

#include "apps/terminal/program.hpp"

namespace raks::apps {

/// Parses the command line over the settings files. A wrong command line or setting is one line on
/// stderr and kExitUsage.
[[nodiscard]] ParsedCommand parse_arguments(int argc, char** argv);

}  // namespace raks::apps
