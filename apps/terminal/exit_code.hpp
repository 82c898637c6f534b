#pragma once

#include <filesystem>
#include <utility>

#include "base/expected.hpp"

/// What the programs end with.
namespace raks::apps {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;
// Stopped by a signal: 128 + its number (130 SIGINT, 143 SIGTERM); what was finished is kept.

using Path = std::filesystem::path;
/// Of a command: the process' exit code; an Error becomes "raks: MESSAGE" and kExitFailed.
using ExitCode = Expected<int>;

/// kExitDone, or the fault.
[[nodiscard]] inline ExitCode exit_code_of(Expected<void> done) {
    return done ? ExitCode(kExitDone) : fail(std::move(done.error()));
}

}  // namespace raks::apps
