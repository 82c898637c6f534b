#include "engine/cli/arguments.hpp"
#include "engine/cli/commands.hpp"
#include "engine/cli/signals.hpp"

#include <cstdio>
#include <exception>
#include <string>

namespace {

int report(const std::string& message, int code) {
    std::fprintf(stderr, "raks: %s\n", message.c_str());
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const auto command = raks::cli::parse_arguments(argc, argv);
        if (!command.run) {
            return command.exit_code;
        }
        raks::cli::catch_signals();
        const raks::cli::ExitCode code = command.run();
        if (!code) {
            return report(code.error().message,
                          raks::cli::exit_code_after_signals(raks::cli::kExitFailed));
        }
        return raks::cli::exit_code_after_signals(*code);
    } catch (const std::bad_alloc&) {
        return report("out of memory", raks::cli::kExitFailed);
    } catch (const std::exception& error) {
        return report(std::string("internal error: ") + error.what(), raks::cli::kExitFailed);
    }
}
