#include "base/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace raks {
namespace {

constexpr int kFirstFree = 10;  // above the descriptors that the child gets

void set_attributes(posix_spawnattr_t& attributes) {
    sigset_t all;
    sigset_t none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
}

// What a program of ours needs to be loaded and, in builds for tests, to be watched.
constexpr std::array kNeededVariables = {"LD_LIBRARY_PATH",
                                         "ASAN_OPTIONS",
                                         "LSAN_OPTIONS",
                                         "RTSAN_OPTIONS",
                                         "TSAN_OPTIONS",
                                         "UBSAN_OPTIONS"};

// "NAME=value" of each of them that is set.
std::vector<std::string> needed_environment() {
    std::vector<std::string> needed;
    for (const char* const name : kNeededVariables) {
        const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): never set
        if (value != nullptr) {
            needed.push_back(std::string(name) + "=" + value);
        }
    }
    return needed;
}

// As exec wants them: pointers, with a null at the end.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    return pointers;
}

// Copies under numbers that the child's own do not overwrite; closed with this.
class HighCopies {
 public:
    explicit HighCopies(std::span<const int> descriptors) {
        for (const int descriptor : descriptors) {
            copies_.push_back(::fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstFree));
            error_ = copies_.back() < 0 ? errno : error_;
        }
    }
    ~HighCopies() {
        for (const int copy : copies_) {
            if (copy >= 0) {
                ::close(copy);
            }
        }
    }
    HighCopies(const HighCopies&) = delete;
    HighCopies& operator=(const HighCopies&) = delete;

    [[nodiscard]] int error() const noexcept { return error_; }
    [[nodiscard]] const std::vector<int>& numbers() const noexcept { return copies_; }

 private:
    std::vector<int> copies_;
    int error_ = 0;
};

// Nothing but what it is given; what libraries print is lost.
void set_descriptors(posix_spawn_file_actions_t& actions,
                     const std::vector<int>& given,
                     bool is_heard) {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (!is_heard) {
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    }
    int number = kFirstGiven;
    for (const int descriptor : given) {
        posix_spawn_file_actions_adddup2(&actions, descriptor, number++);
    }
    posix_spawn_file_actions_addclosefrom_np(&actions, number);
}

}  // namespace

Expected<pid_t> spawn_child(const ChildStart& start) {
    std::vector<std::string> words{start.program.string()};
    words.insert(words.end(), start.arguments.begin(), start.arguments.end());
    std::vector<std::string> needed = needed_environment();
    const std::vector<char*> arguments = pointers_to(words);
    const std::vector<char*> variables = pointers_to(needed);
    const HighCopies copies(start.descriptors);
    pid_t pid = -1;
    int error = copies.error();
    if (error == 0) {
        posix_spawnattr_t attributes;
        posix_spawn_file_actions_t actions;
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_init(&actions);
        set_attributes(attributes);
        set_descriptors(actions, copies.numbers(), start.is_heard);
        error = posix_spawn(&pid,
                            words.front().c_str(),
                            &actions,
                            &attributes,
                            arguments.data(),
                            start.has_our_environment ? environ : variables.data());
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    if (error != 0) {
        return fail(start.program.filename().string() +
                    " cannot be started: " + std::generic_category().message(error));
    }
    return pid;
}

std::string end_child_group(pid_t pid) {
    ::kill(-pid, SIGKILL);  // as long as nobody has waited for the child, the group is its own
    return end_child(pid);
}

std::string end_child(pid_t pid) {
    int status = 0;
    pid_t ended = 0;
    ::kill(pid, SIGKILL);  // one that is dead stays as it died
    do {
        ended = ::waitpid(pid, &status, 0);
    } while (ended < 0 && errno == EINTR);
    if (ended > 0 && WIFSIGNALED(status)) {
        const char* const name = ::sigabbrev_np(WTERMSIG(status));
        return name == nullptr ? "killed by a signal" : std::string("killed by SIG") + name;
    }
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace raks
