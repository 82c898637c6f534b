#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "audio/io/decode_protocol.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// A running raks-decode that has no file yet, or one. For audio/io alone.
/// Threads: one at a time; take() any. Real-time: no.
class DecoderProcess {
 public:
    /// The one that was started ahead, else a new one. Errors: it is not installed, or cannot be
    /// started.
    [[nodiscard]] static Expected<std::unique_ptr<DecoderProcess>> take();
    /// Kills it and waits for its end.
    ~DecoderProcess();
    DecoderProcess(const DecoderProcess&) = delete;             ///< one owner
    DecoderProcess& operator=(const DecoderProcess&) = delete;  ///< likewise

    /// Where it is spoken to.
    [[nodiscard]] int socket() const noexcept { return socket_; }
    /// What both see.
    [[nodiscard]] const DecodeMemory& memory() const noexcept { return *memory_; }
    /// Ends it, if it runs, and says how it ended: "killed by SIGSEGV" or "exit code 1".
    std::string end();

 private:
    DecoderProcess() = default;
    [[nodiscard]] static Expected<std::unique_ptr<DecoderProcess>> start();
    [[nodiscard]] bool is_alive() const;

    pid_t pid_ = -1;
    int socket_ = -1;
    int lifeline_ = -1;
    DecodeMemory* memory_ = nullptr;
    friend struct SpareDecoder;
};

}  // namespace raks::audio
