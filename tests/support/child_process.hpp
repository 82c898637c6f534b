#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace raks::test {

/// A program that runs beside the test, its output in a file. Killed and reaped at the end.
class ChildProcess {
 public:
    /// Starts `arguments[0]` (found in PATH) with stdout and stderr going to `log`.
    ChildProcess(const std::vector<std::string>& arguments, const std::string& log);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Sends a signal that ends it, and waits for the end.
    void end(int signal_number);
    /// Sends a signal that does not end it: SIGSTOP, SIGCONT.
    void send(int signal_number) const;
    [[nodiscard]] bool is_running() const noexcept { return pid_ > 0; }

 private:
    pid_t pid_ = -1;
};

/// Runs a program to its end, silently; its exit code (127: not found; 128 + signal).
int exit_code_of(const std::vector<std::string>& arguments);

}  // namespace raks::test
