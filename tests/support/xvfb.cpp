#include "tests/support/xvfb.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace raks::test {
namespace {

struct Child {
    pid_t pid = -1;
    int output = -1;  // where to read what it writes on `child_fd`
};

/// Starts a program whose descriptor `child_fd` is a pipe to here.
Child start(const std::vector<std::string>& command, int child_fd, const char* stderr_to) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], child_fd);
    if (stderr_to != nullptr) {
        posix_spawn_file_actions_addopen(&actions, 2, stderr_to, O_WRONLY, 0);
    }
    std::vector<char*> arguments;
    std::vector<std::string> copies = command;
    for (std::string& copy : copies) {
        arguments.push_back(copy.data());
    }
    arguments.push_back(nullptr);
    Child child{.output = ends[0]};
    const int error =
        posix_spawnp(&child.pid, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0) {
        close(ends[0]);
        throw std::runtime_error(command.front() +
                                 " does not start: run scripts/setup.sh to install it");
    }
    return child;
}

std::string read_all(int descriptor, char until) {
    std::string text;
    std::array<char, 4096> chunk{};
    for (;;) {
        const ssize_t got = read(descriptor, chunk.data(), until != '\0' ? 1 : chunk.size());
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return text;
        }
        text.append(chunk.data(), static_cast<std::size_t>(got));
        if (until != '\0' && text.back() == until) {
            return text;
        }
    }
}

int wait_for(pid_t pid) {
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Xvfb::Xvfb(int width, int height) {
    constexpr int kDisplayDescriptor = 7;
    const Child child = start({"Xvfb",
                               "-displayfd",
                               std::to_string(kDisplayDescriptor),
                               "-screen",
                               "0",
                               std::to_string(width) + "x" + std::to_string(height) + "x24",
                               "-nolisten",
                               "tcp"},
                              kDisplayDescriptor,
                              "/dev/null");
    pid_ = child.pid;
    std::string number = read_all(child.output, '\n');  // it says so once it takes clients
    close(child.output);
    if (number.empty()) {
        wait_for(pid_);
        throw std::runtime_error("Xvfb ended before it was ready");
    }
    number.pop_back();
    display_ = ":" + number;
    setenv("DISPLAY", display_.c_str(), 1);   // NOLINT(concurrency-mt-unsafe): one thread yet
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe)
}

Xvfb::~Xvfb() {
    kill(pid_, SIGTERM);
    wait_for(pid_);
}

std::string run_program(const std::vector<std::string>& command) {
    const Child child = start(command, STDOUT_FILENO, nullptr);
    std::string output = read_all(child.output, '\0');
    close(child.output);
    const int code = wait_for(child.pid);
    if (code != 0) {
        throw std::runtime_error(command.front() + " ended with " + std::to_string(code));
    }
    return output;
}

}  // namespace raks::test
