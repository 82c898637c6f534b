#include "audio/io/decoder_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

#include "audio/io/decoder_fork_server.hpp"
#include "audio/io/decoder_part.hpp"

namespace raks::audio {
namespace {

bool make_memory(Descriptor& memory) {
    memory.number = ::memfd_create("raks-decode", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    // Sealed: a child that shortened it would make us die at the next read.
    return memory.number >= 0 && ::ftruncate(memory.number, sizeof(DecodeMemory)) == 0 &&
           ::fcntl(memory.number, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0;
}

}  // namespace

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::start(
    const std::function<bool()>& is_stop_requested) {
    TalkEnds sockets;
    TalkEnds lifeline;
    Descriptor memory;
    std::unique_ptr<DecoderProcess> process(new DecoderProcess);
    if (!sockets.make_sockets(SOCK_SEQPACKET) || !lifeline.make_lifeline() ||
        !make_memory(memory) || !process->map(memory.number)) {
        return no_decoder(errno);
    }
    const auto pid = DecoderForkServer::get().start_decoder(
        {sockets.childs.number, memory.number, lifeline.childs.number}, is_stop_requested);
    if (!pid) {
        return fail(pid.error());
    }
    process->child_.emplace(TalkingChild::adopt(*pid, sockets.ours));
    process->lifeline_.number = lifeline.ours.release();
    return process;
}

Expected<std::unique_ptr<DecoderProcess>> DecoderProcess::over(Descriptor& socket) {
    std::unique_ptr<DecoderProcess> process(new DecoderProcess);
    Descriptor memory;
    if (!make_memory(memory) || !process->map(memory.number)) {
        return no_decoder(errno);
    }
    process->child_.emplace(TalkingChild::adopt(-1, socket));
    return process;
}

bool DecoderProcess::map(int memory) {
    void* const place =
        ::mmap(nullptr, sizeof(DecodeMemory), PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    memory_ = place == MAP_FAILED ? nullptr : static_cast<DecodeMemory*>(place);
    return memory_ != nullptr;
}

DecoderProcess::~DecoderProcess() {
    child_.reset();
    if (memory_ != nullptr) {
        ::munmap(memory_, sizeof(DecodeMemory));
    }
}

}  // namespace raks::audio
