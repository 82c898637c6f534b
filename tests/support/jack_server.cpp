#include "tests/support/jack_server.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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

/// A file of that name among the temporary ones, open; -1 where that cannot be.
int open_lock(const std::string& name) {
    return open((std::filesystem::temp_directory_path() / name).c_str(),
                O_CREAT | O_RDWR | O_CLOEXEC,
                0666);
}

/// While one lives, no other test starts a server: two that start at once disturb each other in
/// JACK's registry, and neither answers.
class OneStartAtATime {
 public:
    OneStartAtATime() : file_(open_lock("raks-test-jack-start")) { flock(file_, LOCK_EX); }
    ~OneStartAtATime() { close(file_); }
    OneStartAtATime(const OneStartAtATime&) = delete;
    OneStartAtATime& operator=(const OneStartAtATime&) = delete;

 private:
    int file_;
};

/// For sure: pgrep says 1 when it finds none.
bool is_no_server_running() { return exit_code_of({"pgrep", "-x", "jackd|jackdbus"}) == 1; }

/// The first line that the server said: an error comes before its greeting.
std::string first_line_of(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

}  // namespace

// JACK's registry has places for eight servers, and one that was killed keeps its own until a
// server of its name starts. So all tests share six names.
ServerName::ServerName() {
    constexpr int kNames = 6;
    for (int i = 0;; i = (i + 1) % kNames) {
        name_ = "raks-test-" + std::to_string(i);
        lock_ = open_lock(name_);
        if (lock_ < 0 || flock(lock_, LOCK_EX | (i + 1 < kNames ? LOCK_NB : 0)) == 0) {
            return;
        }
        close(lock_);
    }
}

ServerName::~ServerName() { close(lock_); }

JackServer::JackServer(int rate, int period, int priority) : priority_(priority) {
    setenv("JACK_DEFAULT_SERVER", name().c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    setenv("JACK_NO_START_SERVER", "1", 1);            // NOLINT(concurrency-mt-unsafe)
    for (const char* scheduling : {"SCHED_FIFO", "normal"}) {
        scheduling_ = scheduling;
        if (start(rate, period)) {
            return;
        }
    }
    // Servers of other names were killed until no place was left: start afresh.
    process_.reset();
    if (is_no_server_running()) {
        remove_shared_memory("jack-shm-registry");
        if (start(rate, period)) {
            return;
        }
    }
    process_.reset();
    problem_ =
        "jackd -d dummy does not start (is the package jackd2 installed?): " + first_line_of(log());
}

JackServer::~JackServer() {
    process_.reset();
    remove_shared_memory(name() + "_");
}

std::string JackServer::log() const {
    return (std::filesystem::temp_directory_path() / (name() + ".log")).string();
}

bool JackServer::start(int rate, int period) {
    const OneStartAtATime alone;
    std::vector<std::string> command{"jackd", "-n", name()};
    if (scheduling_ == "SCHED_FIFO") {
        command.insert(command.end(), {"-R", "-P" + std::to_string(priority_)});
    } else {
        command.emplace_back("--no-realtime");
    }
    command.insert(command.end(),
                   {"-d", "dummy", "-r", std::to_string(rate), "-p", std::to_string(period)});
    process_ = std::make_unique<ChildProcess>(command, log());
    return exit_code_of({"jack_wait", "-s", name(), "-w", "-t", "15"}) == 0 &&
           exit_code_of({"jack_lsp", "-s", name()}) == 0;
}

bool JackServer::connect(const std::string& from, const std::string& to) const {
    return exit_code_of({"jack_connect", "-s", name(), from, to}) == 0;
}

bool JackServer::disconnect(const std::string& from, const std::string& to) const {
    return exit_code_of({"jack_disconnect", "-s", name(), from, to}) == 0;
}

bool JackServer::restart(int rate, int period) { return start(rate, period); }

void JackServer::kill() {
    if (process_) {
        process_->end(SIGKILL);
    }
}

}  // namespace raks::test
