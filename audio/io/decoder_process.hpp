#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "audio/io/decode_protocol.hpp"
#include "base/descriptor.hpp"
#include "base/expected.hpp"
#include "base/talking_child.hpp"

namespace raks::audio {

/// A running raks-decode that has no file yet, or one. For audio/io alone.
/// Threads: one at a time; start() any. Real-time: no.
class DecoderProcess {
 public:
    /// A new one. `is_stop_requested` is asked every 50 ms while it is waited for. Errors: those of
    /// DecoderForkServer::start_decoder; no descriptors or memory are left.
    [[nodiscard]] static Expected<std::unique_ptr<DecoderProcess>> start(
        const std::function<bool()>& is_stop_requested);
    /// One that somebody else runs, who speaks over this socket: for tests of what a decoder may
    /// say. Errors: no memory is left.
    [[nodiscard]] static Expected<std::unique_ptr<DecoderProcess>> over(Descriptor& socket);
    /// Kills it and waits for its end.
    ~DecoderProcess();
    DecoderProcess(const DecoderProcess&) = delete;             ///< one owner
    DecoderProcess& operator=(const DecoderProcess&) = delete;  ///< likewise

    /// Where it is spoken to.
    [[nodiscard]] int socket() const noexcept { return child_->socket(); }
    /// What both see.
    [[nodiscard]] const DecodeMemory& memory() const noexcept { return *memory_; }
    /// Ends it, if it runs, and says how it ended: "killed by SIGSEGV" or "exit code 1".
    std::string end() { return child_->end(); }

 private:
    DecoderProcess() = default;
    [[nodiscard]] bool map(int memory);

    std::optional<TalkingChild> child_;
    Descriptor lifeline_;
    DecodeMemory* memory_ = nullptr;
};

}  // namespace raks::audio
