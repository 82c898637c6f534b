#pragma once

#include <filesystem>
#include <utility>

#include "base/expected.hpp"

/// What the programs return to the system.
namespace raks::apps {

inline constexpr int kExitDone = 0;    ///< everything asked for is done
inline constexpr int kExitFailed = 1;  ///< a fault while running
inline constexpr int kExitUsage = 2;   ///< a wrong command line
// Stopped by a signal: 128 + its number (130 SIGINT, 143 SIGTERM); what was finished is kept.

/// Short for the arguments of commands.
using Path = std::filesystem::path;
/// Result of a command: the process' exit code; an Error becomes "raks: MESSAGE" and kExitFailed.
using ExitCode = Expected<int>;

/// kExitDone, or the error of `done`.
[[nodiscard]] inline ExitCode exit_code_of(Expected<void> done) {
    return done ? ExitCode(kExitDone) : fail(std::move(done.error()));
}

}  // namespace raks::apps
