#pragma once

#include <sys/types.h>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace raks::test {

/// How a child process ended.
struct ProcessResult {
    int exit_code = -1;      ///< as a shell says it: 128 + signal when one killed it
    bool timed_out = false;  ///< it was killed by us
    std::string out;
    std::string err;
    double cpu_seconds = 0.0;  ///< its own and its children's
    long most_kilobytes = 0;   ///< of memory, of itself or one of its children
};

/// A real program, run with captured output.
struct ProcessPlan {
    std::vector<std::string> command;                              ///< program and arguments
    std::vector<std::pair<std::string, std::string>> environment;  ///< over the test's own
    std::vector<std::string> unset;                                ///< names to remove
    std::string folder;                       ///< to start in; empty: the test's own
    std::optional<int> terminal_columns;      ///< stderr is a terminal so wide
    std::optional<long> file_size_limit;      ///< RLIMIT_FSIZE in bytes: a full disk
    std::optional<long> address_space_limit;  ///< RLIMIT_AS in bytes
    std::chrono::seconds timeout{60};
};

/// A child that runs beside the test; killed by the destructor if still there.
class CapturedProcess {
 public:
    explicit CapturedProcess(const ProcessPlan& plan);
    ~CapturedProcess();
    CapturedProcess(const CapturedProcess&) = delete;
    CapturedProcess& operator=(const CapturedProcess&) = delete;

    void send(int signal) const;
    /// Waits for the end, at most until the plan's timeout.
    ProcessResult wait();
    /// Reads output until `text` appears in stdout or stderr; false when the child ended or the
    /// plan's timeout passed first.
    bool wait_for_output(const std::string& text);
    /// The same for any condition on what was read so far.
    bool wait_until(const std::function<bool(const ProcessResult&)>& is_enough);
    /// What was read so far.
    [[nodiscard]] const ProcessResult& output() const noexcept { return result_; }
    [[nodiscard]] pid_t pid() const { return pid_; }

 private:
    bool read_some(std::chrono::milliseconds wait);
    bool reap(bool block);

    pid_t pid_ = -1;
    int out_ = -1;
    int err_ = -1;
    bool has_ended_ = false;
    std::chrono::steady_clock::time_point deadline_;
    ProcessResult result_;
};

/// The processes that this one started and that still run.
std::vector<pid_t> children_of(pid_t pid);

/// Runs to the end.
ProcessResult run_process(const ProcessPlan& plan);

}  // namespace raks::test
