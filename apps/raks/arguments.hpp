#pragma once

#include "apps/terminal/program.hpp"

namespace raks::apps {

/// Reads the command line over the settings files. Wrong usage is one line on stderr and
/// kExitUsage.
[[nodiscard]] ParsedCommand parse_arguments(int argc, char** argv);

}  // namespace raks::apps
