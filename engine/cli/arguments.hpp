#pragma once

#include <functional>

#include "engine/cli/commands.hpp"

namespace raks::cli {

/// What the command line asks for: a command to run, or (after help, version and wrong usage, which
/// have been printed) only an exit code.
struct ParsedCommand {
    std::function<ExitCode()> run;  ///< empty: nothing to run
    int exit_code = kExitDone;
};

/// Reads the command line over the settings files. Wrong usage is one line on stderr and
/// kExitUsage.
[[nodiscard]] ParsedCommand parse_arguments(int argc, char** argv);

}  // namespace raks::cli
