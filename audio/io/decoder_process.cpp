#include "audio/io/decoder_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "audio/io/decoder_fork_server.hpp"
#include "audio/io/decoder_spawn.hpp"

namespace raks::audio {
namespace {

// The ends that a child gets, and ours.
struct Links {
    Descriptor socket, child_socket, lifeline, child_lifeline, memory;

    [[nodiscard]] bool make();
};

bool make_memory(Descriptor& memory) {
    memory.number = ::memfd_create("raks-decode", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    // Sealed: a child that shortened it would make us die at the next read.
    return memory.number >= 0 && ::ftruncate(memory.number, sizeof(DecodeMemory)) == 0 &&
           ::fcntl(memory.number, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0;
}

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
    return make_memory(memory);
}

tl::unexpected<Error> no_room() {
    return fail("raks-decode cannot be started: " + std::generic_category().message(errno));
}

}  // namespace

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::start(
    const std::function<bool()>& is_stop_requested) {
    Links links;
    if (!links.make()) {
        return no_room();
    }
    std::unique_ptr<DecoderProcess> process(new DecoderProcess);
    if (!process->map(links.memory.number)) {
        return no_room();
    }
    const auto pid = DecoderForkServer::get().start_decoder(
        {links.child_socket.number, links.memory.number, links.child_lifeline.number},
        is_stop_requested);
    if (!pid) {
        return fail(pid.error());
    }
    process->pid_ = *pid;
    process->socket_ = links.socket.release();
    process->lifeline_ = links.lifeline.release();
    return process;
}

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::over(Descriptor& socket) {
    std::unique_ptr<DecoderProcess> process(new DecoderProcess);
    Descriptor memory;
    if (!make_memory(memory) || !process->map(memory.number)) {
        return no_room();
    }
    process->socket_ = socket.release();
    return process;
}

bool DecoderProcess::map(int memory) {
    void* const place =
        ::mmap(nullptr, sizeof(DecodeMemory), PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    memory_ = place == MAP_FAILED ? nullptr : static_cast<DecodeMemory*>(place);
    return memory_ != nullptr;
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

std::string DecoderProcess::end() {
    return pid_ < 0 ? std::string() : end_child(std::exchange(pid_, -1));
}

}  // namespace raks::audio
