#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "audio/io/device_stream.hpp"
#include "engine/cli/arguments.hpp"
#include "engine/cli/commands.hpp"
#include "engine/cli/say.hpp"
#include "engine/cli/signals.hpp"

namespace {

using namespace raks::cli;

int report(const std::string& message) {
    say(message);
    return exit_code_after_signals(kExitFailed);
}

/// Brings out what was printed; a full disk behind stdout is a failure of the command.
int end_with(int code) {
    const bool was_printed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (code == kExitDone && !was_printed && errno != EPIPE) {
        return report("standard output cannot be written: " +
                      std::generic_category().message(errno));
    }
    return exit_code_after_signals(code);
}

int run(int argc, char** argv) {
    try {
        const auto command = parse_arguments(argc, argv);
        if (!command.run) {
            return end_with(command.exit_code);
        }
        catch_signals();
        const ExitCode code = command.run();
        return code ? end_with(*code) : report(code.error().message);
    } catch (const std::bad_alloc&) {
        return report("out of memory");
    } catch (const std::exception& error) {
        return report(std::string("internal error: ") + error.what());
    }
}

}  // namespace

int main(int argc, char** argv) { raks::audio::end_process(run(argc, argv)); }
