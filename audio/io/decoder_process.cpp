#include "audio/io/decoder_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>

#include "audio/io/audio_file.hpp"
#include "base/program_parts.hpp"

namespace raks::audio {
namespace {

constexpr int kFirstFree = 10;  // above the descriptors that the child gets

// A descriptor that is closed at the end of its scope.
struct Descriptor {
    int number = -1;
    Descriptor() = default;
    explicit Descriptor(int given) : number(given) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number >= 0) {
            ::close(number);
        }
    }
    [[nodiscard]] int release() noexcept { return std::exchange(number, -1); }
};

// The same open file under a number that the child's own do not overwrite.
void move_up(Descriptor& descriptor) {
    const int above = ::fcntl(descriptor.number, F_DUPFD_CLOEXEC, kFirstFree);
    ::close(std::exchange(descriptor.number, above));
}

tl::unexpected<Error> cannot_start(int error_number) {
    return fail("raks-decode cannot be started: " + std::generic_category().message(error_number));
}

// The ends that a child gets, and ours.
struct Links {
    Descriptor socket, child_socket, lifeline, child_lifeline, memory;

    [[nodiscard]] bool make();
};

bool Links::make() {
    std::array<int, 2> pair{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0) {
        return false;
    }
    socket.number = pair[0];
    child_socket.number = pair[1];
    if (::pipe2(pair.data(), O_CLOEXEC) != 0) {
        return false;
    }
    child_lifeline.number = pair[0];
    lifeline.number = pair[1];
    memory.number = ::memfd_create("raks-decode", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    // Sealed: a child that shortened it would make us die at the next read.
    const bool is_made =
        memory.number >= 0 && ::ftruncate(memory.number, sizeof(DecodeMemory)) == 0 &&
        ::fcntl(memory.number, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0;
    for (Descriptor* each : {&child_socket, &child_lifeline, &memory}) {
        move_up(*each);
    }
    return is_made && child_socket.number >= 0 && child_lifeline.number >= 0 && memory.number >= 0;
}

// Signals as a fresh program has them, and a process group of its own: what the terminal sends to
// raks (Ctrl+C) is for raks alone.
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

// Nothing but its three descriptors; what libraries print is lost.
void set_descriptors(posix_spawn_file_actions_t& actions, const Links& links) {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
#ifndef RAKS_DECODES_UNCONFINED
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#endif
    posix_spawn_file_actions_adddup2(&actions, links.child_socket.number, kDecodeSocket);
    posix_spawn_file_actions_adddup2(&actions, links.memory.number, kDecodeMemory);
    posix_spawn_file_actions_adddup2(&actions, links.child_lifeline.number, kDecodeLifeline);
    posix_spawn_file_actions_addclosefrom_np(&actions, kDecodeLifeline + 1);
}

int spawn(std::string program, const Links& links, pid_t& pid) {
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t actions;
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
    set_attributes(attributes);
    set_descriptors(actions, links);
    std::string unconfined = "--no-sandbox";
    std::array<char*, 3> arguments{program.data(), nullptr, nullptr};
#ifdef RAKS_DECODES_UNCONFINED
    arguments[1] = unconfined.data();
#endif
    const int error =
        posix_spawn(&pid, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return error;
}

}  // namespace

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::start() {
    const auto program = find_program_part("raks-decode", "libexec/raks", "RAKS_DECODER");
    if (!program) {
        return fail(program.error());
    }
    Links links;
    if (!links.make()) {
        return cannot_start(errno);
    }
    std::unique_ptr<DecoderProcess> process(new DecoderProcess);
    void* const memory = ::mmap(
        nullptr, sizeof(DecodeMemory), PROT_READ | PROT_WRITE, MAP_SHARED, links.memory.number, 0);
    if (memory == MAP_FAILED) {
        return cannot_start(errno);
    }
    process->memory_ = static_cast<DecodeMemory*>(memory);
    if (const int error = spawn(program->string(), links, process->pid_); error != 0) {
        process->pid_ = -1;
        return cannot_start(error);
    }
    process->socket_ = links.socket.release();
    process->lifeline_ = links.lifeline.release();
    return process;
}

DecoderProcess::~DecoderProcess() {
    end();
    for (const int descriptor : {socket_, lifeline_}) {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
    }
    if (memory_ != nullptr) {
        ::munmap(memory_, sizeof(DecodeMemory));
    }
}

bool DecoderProcess::is_alive() const {
    pollfd look{socket_, POLLIN, 0};
    return ::poll(&look, 1, 0) == 0;  // it says nothing before it is asked
}

std::string DecoderProcess::end() {
    if (pid_ < 0) {
        return {};
    }
    int status = 0;
    pid_t ended = 0;
    ::kill(pid_, SIGKILL);  // one that is dead stays as it died
    do {
        ended = ::waitpid(pid_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    pid_ = -1;
    if (ended > 0 && WIFSIGNALED(status)) {
        const char* const name = ::sigabbrev_np(WTERMSIG(status));
        return name == nullptr ? "killed by a signal" : std::string("killed by SIG") + name;
    }
    return "exit code " + std::to_string(WEXITSTATUS(status));
}

/// The one that waits for its file.
struct SpareDecoder {
    std::mutex mutex;
    bool is_wanted = false;
    std::unique_ptr<DecoderProcess> process;

    // A start that fails is tried, and said, by whoever needs it.
    void renew() {
        if (is_wanted && !process) {
            process = DecoderProcess::start().value_or(nullptr);
        }
    }

    static SpareDecoder& get() {
        static SpareDecoder spare;
        return spare;
    }
};

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::take() {
    SpareDecoder& spare = SpareDecoder::get();
    const std::lock_guard lock(spare.mutex);
    std::unique_ptr<DecoderProcess> taken = std::exchange(spare.process, nullptr);
    spare.renew();
    if (taken && taken->is_alive()) {
        return taken;
    }
    return start();
}

void keep_spare_decoder() {
    SpareDecoder& spare = SpareDecoder::get();
    const std::lock_guard lock(spare.mutex);
    spare.is_wanted = true;
    spare.renew();
}

}  // namespace raks::audio
