#include "tests/support/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace raks::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
    int read_end = -1;
    int write_end = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("pipe2 failed");
    }
    return {ends[0], ends[1]};
}

/// A terminal: the child's end to write, ours to read.
Pipe make_terminal(int columns) {
    const int ours = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    std::array<char, 64> name{};
    if (ours < 0 || grantpt(ours) != 0 || unlockpt(ours) != 0 ||
        ptsname_r(ours, name.data(), name.size()) != 0) {
        throw std::runtime_error("no terminal");
    }
    const int childs = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    size.ws_row = 24;
    if (childs < 0 || ioctl(ours, TIOCSWINSZ, &size) != 0) {
        throw std::runtime_error("no terminal");
    }
    return {ours, childs};
}

[[noreturn]] void become(const ProcessPlan& plan, const Pipe& out, const Pipe& err) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that is killed leaves nothing behind
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out.write_end, STDOUT_FILENO);
    dup2(err.write_end, STDERR_FILENO);
    for (const std::string& name : plan.unset) {
        unsetenv(name.c_str());
    }
    for (const auto& [name, value] : plan.environment) {
        setenv(name.c_str(), value.c_str(), 1);
    }
    if (!plan.folder.empty() && chdir(plan.folder.c_str()) != 0) {
        _exit(126);
    }
    if (plan.file_size_limit) {
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = static_cast<rlim_t>(*plan.file_size_limit);
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (plan.address_space_limit) {
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = static_cast<rlim_t>(*plan.address_space_limit);
        setrlimit(RLIMIT_AS, &limit);
    }
    std::vector<char*> arguments;
    for (const std::string& argument : plan.command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
}

}  // namespace

CapturedProcess::CapturedProcess(const ProcessPlan& plan) : deadline_(Clock::now() + plan.timeout) {
    const Pipe out = make_pipe();
    const Pipe err = plan.terminal_columns ? make_terminal(*plan.terminal_columns) : make_pipe();
    pid_ = fork();
    if (pid_ == 0) {
        become(plan, out, err);
    }
    close(out.write_end);
    close(err.write_end);
    out_ = out.read_end;
    err_ = err.read_end;
}

CapturedProcess::~CapturedProcess() {
    if (!has_ended_) {
        kill(pid_, SIGKILL);
        reap(true);
    }
    close(out_);
    close(err_);
}

void CapturedProcess::send(int signal) const {
    if (!has_ended_) {
        kill(pid_, signal);
    }
}

bool CapturedProcess::reap(bool block) {
    int status = 0;
    rusage used{};
    if (has_ended_ || wait4(pid_, &status, block ? 0 : WNOHANG, &used) != pid_) {
        return has_ended_;
    }
    has_ended_ = true;
    const auto seconds_of = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    result_.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    result_.most_kilobytes = used.ru_maxrss;
    result_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return true;
}

bool CapturedProcess::read_some(std::chrono::milliseconds wait) {
    std::array<pollfd, 2> polls = {{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    poll(polls.data(), polls.size(), static_cast<int>(wait.count()));
    bool is_open = false;
    for (std::size_t i = 0; i < polls.size(); ++i) {
        if ((polls[i].revents & (POLLIN | POLLHUP)) == 0) {
            is_open = true;
            continue;
        }
        std::array<char, 4096> chunk{};
        const ssize_t got = read(polls[i].fd, chunk.data(), chunk.size());
        if (got > 0) {
            (i == 0 ? result_.out : result_.err)
                .append(chunk.data(), static_cast<std::size_t>(got));
            is_open = true;
        }
    }
    return is_open;
}

ProcessResult CapturedProcess::wait() {
    while (read_some(std::chrono::milliseconds(50)) && !reap(false)) {
        if (Clock::now() > deadline_) {
            result_.timed_out = true;
            kill(pid_, SIGKILL);
            break;
        }
    }
    // A program may close its output before it ends.
    while (!reap(false)) {
        if (Clock::now() > deadline_ && !result_.timed_out) {
            result_.timed_out = true;
            kill(pid_, SIGKILL);
        }
        poll(nullptr, 0, 5);
    }
    while (read_some(std::chrono::milliseconds(0))) {
        // What was still in the pipes; grandchildren may hold them open, so stop when empty.
        std::array<pollfd, 2> polls = {{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
        if (poll(polls.data(), polls.size(), 0) <= 0) {
            break;
        }
    }
    return result_;
}

bool CapturedProcess::wait_until(const std::function<bool(const ProcessResult&)>& is_enough) {
    while (!is_enough(result_)) {
        if (!read_some(std::chrono::milliseconds(50)) || Clock::now() > deadline_) {
            return is_enough(result_);
        }
    }
    return true;
}

bool CapturedProcess::wait_for_output(const std::string& text) {
    return wait_until([&](const ProcessResult& so_far) {
        return so_far.out.find(text) != std::string::npos ||
               so_far.err.find(text) != std::string::npos;
    });
}

std::vector<pid_t> children_of(pid_t pid) {
    namespace fs = std::filesystem;
    std::vector<pid_t> found;
    std::error_code ended;
    for (const auto& task :
         fs::directory_iterator("/proc/" + std::to_string(pid) + "/task", ended)) {
        std::ifstream list(task.path() / "children");
        for (pid_t child = 0; list >> child;) {
            found.push_back(child);
        }
    }
    return found;
}

ProcessResult run_process(const ProcessPlan& plan) {
    CapturedProcess child(plan);
    return child.wait();
}

}  // namespace raks::test
