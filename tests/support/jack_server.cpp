#include "tests/support/jack_server.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace raks::test {
namespace {

constexpr const char* kSharedMemory = "/dev/shm";

/// What a killed server leaves behind.
void remove_shared_memory(const std::string& part) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(kSharedMemory, ignored)) {
        if (entry.path().filename().string().find(part) != std::string::npos) {
            std::filesystem::remove(entry.path(), ignored);
        }
    }
}

/// While one lives, no other test starts a server: two that start at once disturb each other in
/// JACK's registry, and neither answers.
class OneStartAtATime {
 public:
    OneStartAtATime()
        : file_(open((std::filesystem::temp_directory_path() / "raks-test-jack-start").c_str(),
                     O_CREAT | O_RDWR | O_CLOEXEC,
                     0666)) {
        flock(file_, LOCK_EX);
    }
    ~OneStartAtATime() { close(file_); }
    OneStartAtATime(const OneStartAtATime&) = delete;
    OneStartAtATime& operator=(const OneStartAtATime&) = delete;

 private:
    int file_;
};

/// For sure: pgrep says 1 when it finds none.
bool is_no_server_running() { return exit_code_of({"pgrep", "-x", "jackd|jackdbus"}) == 1; }

}  // namespace

JackServer::JackServer(int rate, int period, int priority) : priority_(priority) {
    static int count = 0;
    name_ = "raks-test-" + std::to_string(getpid()) + "-" + std::to_string(++count);
    setenv("JACK_DEFAULT_SERVER", name_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    setenv("JACK_NO_START_SERVER", "1", 1);           // NOLINT(concurrency-mt-unsafe)
    for (const char* scheduling : {"SCHED_FIFO", "normal"}) {
        scheduling_ = scheduling;
        if (start(rate, period)) {
            return;
        }
    }
    // JACK has places for eight servers, and one that was killed keeps its own: start afresh.
    if (is_no_server_running()) {
        remove_shared_memory("jack-shm-registry");
        if (start(rate, period)) {
            return;
        }
    }
    process_.reset();
    problem_ = "jackd -d dummy does not start (is the package jackd2 installed?)";
}

JackServer::~JackServer() {
    if (was_killed_ && start(48'000, 256)) {
        process_->end(SIGTERM);  // a server of the same name takes the place over and gives it back
        remove_shared_memory(name_ + "_");
    }
}

bool JackServer::start(int rate, int period) {
    const OneStartAtATime alone;
    std::vector<std::string> command{"jackd", "-n", name_};
    if (scheduling_ == "SCHED_FIFO") {
        command.insert(command.end(), {"-R", "-P" + std::to_string(priority_)});
    } else {
        command.emplace_back("--no-realtime");
    }
    command.insert(command.end(),
                   {"-d", "dummy", "-r", std::to_string(rate), "-p", std::to_string(period)});
    process_ = std::make_unique<ChildProcess>(command, "/dev/null");
    return exit_code_of({"jack_wait", "-s", name_, "-w", "-t", "5"}) == 0 &&
           exit_code_of({"jack_lsp", "-s", name_}) == 0;
}

bool JackServer::connect(const std::string& from, const std::string& to) const {
    return exit_code_of({"jack_connect", "-s", name_, from, to}) == 0;
}

bool JackServer::disconnect(const std::string& from, const std::string& to) const {
    return exit_code_of({"jack_disconnect", "-s", name_, from, to}) == 0;
}

bool JackServer::restart(int rate, int period) {
    was_killed_ = false;
    return start(rate, period);
}

void JackServer::kill() {
    if (process_) {
        process_->end(SIGKILL);
        was_killed_ = true;
    }
}

}  // namespace raks::test
