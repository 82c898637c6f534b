#include "tests/support/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>

namespace raks::test {

Program start_program(const std::vector<std::string>& command,
                      int child_fd,
                      const char* errors_to) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], child_fd);
    if (errors_to != nullptr) {
        posix_spawn_file_actions_addopen(&actions, 2, errors_to, O_WRONLY, 0);
    }
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    std::vector<std::string> copies = command;
    for (std::string& copy : copies) {
        arguments.push_back(copy.data());
    }
    arguments.push_back(nullptr);
    Program child{.output = ends[0]};
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

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 65536> chunk{};
    for (;;) {
        const ssize_t got = read(descriptor, chunk.data(), chunk.size());
        if (got > 0) {
            text.append(chunk.data(), static_cast<std::size_t>(got));
        } else if (got == 0 || errno != EINTR) {
            return text;
        }
    }
}

std::string read_line(int descriptor) {
    std::string text;
    for (;;) {
        char c = '\0';
        const ssize_t got = read(descriptor, &c, 1);
        if (got > 0 && c != '\n') {
            text.push_back(c);
        } else if (got >= 0 || errno != EINTR) {
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

std::string run_program(const std::vector<std::string>& command) {
    const Program child = start_program(command, STDOUT_FILENO);
    std::string output = read_all(child.output);
    close(child.output);
    const int code = wait_for(child.pid);
    if (code != 0) {
        throw std::runtime_error(command.front() + " ended with " + std::to_string(code));
    }
    return output;
}

}  // namespace raks::test
