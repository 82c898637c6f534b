#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "base/expected.hpp"
#include "engine/cli/commands.hpp"
#include "engine/cli/say.hpp"

/// What the programs that train have in common.
namespace raks::cli {

/// The command as it is kept in what it makes: without folders.
[[nodiscard]] inline std::string kept_command(std::string command, int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        command += ' ' + std::filesystem::path(argv[i]).filename().string();
    }
    return command;
}

/// kExitDone; kExitFailed with the fault on stderr.
[[nodiscard]] inline int exit_status(const Expected<void>& done) {
    if (!done) {
        say(done.error().message);
    }
    return done ? kExitDone : kExitFailed;
}

/// kExitFailed, and what nothing else caught on stderr: no memory, or a fault of ours.
[[nodiscard]] inline int exit_status(const std::exception& error) {
    const bool is_no_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    say(is_no_memory ? "out of memory" : std::string("internal error: ") + error.what());
    return kExitFailed;
}

}  // namespace raks::cli
