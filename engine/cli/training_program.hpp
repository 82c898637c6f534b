#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "base/expected.hpp"

/// What the programs that train have in common.
namespace raks::cli {

/// The command as it is kept in what it makes: without folders.
[[nodiscard]] inline std::string kept_command(std::string command, int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        command += ' ' + std::filesystem::path(argv[i]).filename().string();
    }
    return command;
}

/// 0; 1 with the fault on stderr.
[[nodiscard]] inline int exit_status(const Expected<void>& done) {
    if (!done) {
        std::fprintf(stderr, "raks: %s\n", done.error().message.c_str());
    }
    return done ? 0 : 1;
}

}  // namespace raks::cli
