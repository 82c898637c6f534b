#include "tests/support/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace raks::test {
namespace {

pid_t start(const std::vector<std::string>& arguments, const std::string& log) {
    std::vector<char*> argv;
    argv.reserve(arguments.size() + 1);
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    const pid_t pid = fork();
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);  // a test that is killed leaves no server behind
        const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    return pid;
}

int wait_for_end(pid_t pid) {
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::string& log)
    : pid_(start(arguments, log)) {}

ChildProcess::~ChildProcess() { end(SIGTERM); }

void ChildProcess::end(int signal_number) {
    if (pid_ > 0) {
        kill(pid_, signal_number);
        wait_for_end(pid_);
        pid_ = -1;
    }
}

void ChildProcess::send(int signal_number) const { kill(pid_, signal_number); }

int exit_code_of(const std::vector<std::string>& arguments) {
    return wait_for_end(start(arguments, "/dev/null"));
}

}  // namespace raks::test
