#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace raks::test {

/// A program that runs beside the test.
struct Program {
    pid_t pid = -1;
    int output = -1;  ///< descriptor to read what it writes on the descriptor asked for
};

/// Starts a program found on PATH, without a shell; `child_fd` of it is a pipe to here, its errors
/// go to `errors_to` (null: where this process's go). Throws std::runtime_error when it cannot be
/// started.
Program start_program(const std::vector<std::string>& command,
                      int child_fd,
                      const char* errors_to = nullptr);

/// What comes through the descriptor until it is closed.
std::string read_all(int descriptor);
/// What comes through the descriptor until the end of a line, which is left out.
std::string read_line(int descriptor);

/// Waits for the end; the exit code, or 128 + the signal.
int wait_for(pid_t pid);

/// Runs a program found on PATH without a shell, waits for it and returns what it wrote on stdout.
/// Throws std::runtime_error when it cannot be started or its exit code is not 0.
std::string run_program(const std::vector<std::string>& command);

}  // namespace raks::test
