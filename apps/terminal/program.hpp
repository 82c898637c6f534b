#pragma once

#include <functional>

#include "apps/terminal/exit_code.hpp"

/// What the `main` of each program does.
namespace raks::apps {

/// What the command line asked for.
struct ParsedCommand {
    std::function<ExitCode()> run;  ///< empty: nothing more to do
    int exit_code = kExitDone;      ///< when there is nothing to run
};

/// Parses and runs a command. Errors, out of memory and faults of ours become one line on stderr.
/// Standard output is flushed: a full disk behind it is a failure of the command. Returns the
/// process' exit code.
[[nodiscard]] int run_program(const std::function<ParsedCommand()>& parse);

}  // namespace raks::apps
