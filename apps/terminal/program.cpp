#include "apps/terminal/program.hpp"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "apps/terminal/say.hpp"
#include "apps/terminal/signals.hpp"

namespace raks::apps {
namespace {

// An error after a signal still ends with the signal's code: the signal was the cause.
int report(const std::string& message) {
    say(message);
    return exit_code_after_signals(kExitFailed);
}

// Flushes what was printed. A write that fails (a full disk behind stdout) makes the command fail;
// EPIPE does not, as the reader has seen enough.
int end_with(int code) {
    const bool was_printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (code == kExitDone && !was_printed && errno != EPIPE) {
        return report("standard output cannot be written: " +
                      std::generic_category().message(errno));
    }
    return exit_code_after_signals(code);
}

}  // namespace

// The outermost frame: no exception leaves the program as a crash.
int run_program(const std::function<ParsedCommand()>& parse) {
    try {
        const ParsedCommand command = parse();
        if (!command.run) {
            return end_with(command.exit_code);
        }
        const ExitCode code = command.run();
        return code ? end_with(*code) : report(code.error().message);
    } catch (const std::bad_alloc&) {
        return report("out of memory");
    } catch (const std::exception& error) {
        return report(std::string("internal error: ") + error.what());
    }
}

}  // namespace raks::apps
