#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "base/expected.hpp"

namespace CLI {
/// Of CLI11, whose header is large.
class App;
}  // namespace CLI

/// What the `main` of every program does: exit codes, the command line, signals.
namespace raks::apps {

// What the programs return to the system.
inline constexpr int kExitDone = 0;    ///< everything asked for is done
inline constexpr int kExitFailed = 1;  ///< a fault while running
inline constexpr int kExitUsage = 2;   ///< a wrong command line
inline constexpr int kExitPartly = 3;  ///< done, but some of the inputs were skipped
// Stopped by a signal: 128 + its number (130 SIGINT, 143 SIGTERM); what was finished is kept.

/// Short for the arguments of commands.
using Path = std::filesystem::path;
/// Result of a command: the process' exit code; an Error becomes "raks: MESSAGE" and kExitFailed.
using ExitCode = Expected<int>;

/// kExitDone, or the error of `done`.
[[nodiscard]] inline ExitCode exit_code_of(Expected<void> done) {
    return done ? ExitCode(kExitDone) : fail(std::move(done.error()));
}

/// What the command line asked for.
struct ParsedCommand {
    std::function<ExitCode()> run;  ///< empty: nothing more to do
    int exit_code = kExitDone;      ///< when there is nothing to run
};

/// Parses the command line and runs the command. Errors, lack of memory and exceptions become one
/// line on stderr. Standard output is flushed; when that fails, as on a full disk, the command has
/// failed. Returns the process' exit code.
///
/// While the command runs SIGINT, SIGTERM and SIGHUP (the terminal was closed) are noted instead of
/// ending the process, SIGXFSZ (a file grew over its limit) and SIGPIPE become errors of the write.
/// A command looks at stop_signal() and ends by itself; where it has not within 0.7 s, or at a
/// second signal, the process ends and what is half-written is removed (base/pending_file.hpp). A
/// fault of a library, or its exit() of the whole program, is said in one line. Threads: main,
/// once.
[[nodiscard]] int run_program(const std::function<ParsedCommand()>& parse);

/// While one lives, these signals end the process at once, with the exit code that they always
/// have: for long work of which nothing is kept, such as loading. (Without one they are noted, and
/// work that is under way is finished first.) Threads: main. Nests.
class EndAtOnceOnSignals {
 public:
    EndAtOnceOnSignals() noexcept;  ///< a signal that was noted before ends the process here
    ~EndAtOnceOnSignals();          ///< as before
    /// Not copied: it counts.
    EndAtOnceOnSignals(const EndAtOnceOnSignals&) = delete;
    EndAtOnceOnSignals& operator=(const EndAtOnceOnSignals&) = delete;  ///< likewise
};

/// The signal that asked the program to stop, if any came.
/// Threads: any. Real-time: yes.
[[nodiscard]] std::optional<int> stop_signal() noexcept;

/// 128 + the signal's number when one came, else `code`.
[[nodiscard]] int exit_code_after_signals(int code) noexcept;

/// Parses the command line into what the options of `app` are bound to. Help and version go to
/// stdout, a wrong command line is one line on stderr. Returns the exit code to end with; nothing:
/// go on.
[[nodiscard]] std::optional<int> read_usage(CLI::App& app, int argc, char** argv);

}  // namespace raks::apps
