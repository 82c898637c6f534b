#pragma once

#include <functional>

#include "apps/terminal/exit_code.hpp"

/// What the `main` of every program does.
namespace raks::apps {

/// What the command line asked for.
struct ParsedCommand {
    std::function<ExitCode()> run;  ///< empty: nothing more to do
    int exit_code = kExitDone;      ///< when there is nothing to run
};

/// Parses the command line and runs the command. Errors, lack of memory and exceptions become one
/// line on stderr. Standard output is flushed; when that fails, as on a full disk, the command has
/// failed. Returns the process' exit code. Threads: main.
[[nodiscard]] int run_program(const std::function<ParsedCommand()>& parse);

}  // namespace raks::apps
